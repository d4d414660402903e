#include "demo.h"

#include <algorithm>
#include <cstdio>

namespace sample
{
namespace
{
Image toImage(const Picture& picture)
{
    Image image(picture.width, picture.height);
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < picture.pixelCount(); ++i) image.rgba[i * 4 + c] = picture.planes[c][i];
    return image;
}

// With a white line between them.
Image sideBySide(const std::vector<Image>& images)
{
    constexpr int kLine = 4; // pixels
    const int width = images.front().width, height = images.front().height;
    const int count = static_cast<int>(images.size());
    Image out(count * width + (count - 1) * kLine, height);
    out.rgba.assign(out.rgba.size(), 1e6f);
    for (int k = 0; k < count; ++k)
        for (int y = 0; y < height; ++y)
            std::copy_n(images[size_t(k)].rgba.begin() + std::ptrdiff_t(y) * width * 4, width * 4,
                        out.rgba.begin() + (std::ptrdiff_t(y) * out.width + k * (width + kLine)) * 4);
    return out;
}
} // namespace

void writeDemoPictures(const std::filesystem::path& folder, const ComposedPictures& pictures)
{
    const std::vector<Image> images = {toImage(pictures.noisy), toImage(pictures.denoised),
                                       toImage(pictures.reference)};
    writePng(folder / "noisy.png", images[0]);
    writePng(folder / "denoised.png", images[1]);
    writePng(folder / "reference.png", images[2]);
    writePng(folder / "side-by-side.png", sideBySide(images));
    std::printf("side-by-side.png: noisy on the left, denoised in the middle, reference on the right\n");
}

void printErrorTable(const SequenceMeasurer& measurer)
{
    const SignalMeasures noisy = measurer.meanNoisy()[static_cast<size_t>(Signal::Composed)];
    const SignalMeasures denoised = measurer.meanDenoised()[static_cast<size_t>(Signal::Composed)];
    std::printf("\n%-10s %10s %10s\n", "composed", "noisy", "denoised");
    for (const MeasureInfo& measure : kMeasures)
    {
        const std::optional<double>&a = noisy.*measure.field, &b = denoised.*measure.field;
        if (a && b) std::printf("%-10s %10.*f %10.*f\n", measure.name, measure.decimals, *a, measure.decimals, *b);
    }
}
} // namespace sample
