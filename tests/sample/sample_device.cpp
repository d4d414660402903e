#include "sample_device.h"

#include "denoise.h"

using namespace sample;

namespace test
{
engine::Device& sampleDevice()
{
    static engine::Device instance(
        []
        {
            engine::DeviceDesc desc = denoiserDeviceDesc();
            desc.validation = true;
            return desc;
        }());
    return instance;
}

Picture toPicture(const Image& image)
{
    Picture picture(image.width, image.height, 3);
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < picture.pixelCount(); ++i) picture.planes[c][i] = image.rgba[i * 4 + c];
    return picture;
}
} // namespace test
