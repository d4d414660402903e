#include "window/recorder.h"

#include "engine/transfer.h"
#include "exr.h"

#include <cstdio>
#include <utility>

namespace sample
{
namespace
{
ExrPicture readExrPicture(const engine::Device& device, engine::Image& image)
{
    constexpr const char* kNames[] = {"R", "G", "B", "A"};
    ExrPicture picture;
    picture.width = int(image.desc().width);
    picture.height = int(image.desc().height);
    std::vector<float> values;
    if (engine::texelByteSize(image.desc().format) % sizeof(float) != 0 ||
        image.desc().format == VK_FORMAT_R8G8B8A8_UNORM)
        for (std::byte b : engine::readBack(device, image)) values.push_back(float(std::to_integer<int>(b)) / 255.0f);
    else
        values = engine::readBackAs<float>(device, image);
    const size_t count = values.size() / (size_t(picture.width) * size_t(picture.height));
    for (size_t c = 0; c < count; ++c)
    {
        ExrChannel channel = {count == 1 ? "Y" : kNames[c], ExrType::Float, {}};
        for (size_t i = c; i < values.size(); i += count) channel.values.push_back(values[i]);
        picture.channels.push_back(std::move(channel));
    }
    return picture;
}
} // namespace

void Recorder::saveBuffer(Viewer& viewer, const std::filesystem::path& file)
{
    engine::Image* image = viewer.viewedImage();
    if (!image) throw FileError("cannot write " + file.string() + ": what is viewed is not there now");
    writeExr(file, readExrPicture(m_device, *image));
}

void Recorder::savePicture(Viewer& viewer, const std::filesystem::path& file)
{
    if (file.extension() == ".exr") return saveBuffer(viewer, file);
    if (file.extension() != ".png") throw FileError("'" + file.string() + "' does not end in .png or .exr");
    engine::Image& source = viewer.picture();
    Image picture(int(source.desc().width), int(source.desc().height));
    const std::vector<std::byte> bytes = engine::readBack(m_device, source);
    for (size_t i = 0; i < bytes.size(); ++i) picture.rgba[i] = float(std::to_integer<int>(bytes[i])) / 255.0f;
    writeEncodedPng(file, picture);
}

void Recorder::startCapture(Viewer& viewer, const std::filesystem::path& folder)
{
    stopCapture();
    const CaptureInfo info = viewer.renderer().captureInfo();
    m_capture.emplace(folder, info);
    m_captureWidth = info.width;
    m_captureHeight = info.height;
    m_captured = 0;
    viewer.state.isRestarted = true; // a capture begins without history
}

void Recorder::startTest(Viewer& viewer, const std::filesystem::path& folder)
{
    stopTest();
    const std::filesystem::path next = nextTest(folder);
    startCapture(viewer, next / "capture");
    m_testFolder = next;
    m_test = {};
    m_test.what = "recorded in the window";
    m_test.arguments = viewer.arguments();
}

void Recorder::stopTest()
{
    if (!isTesting()) return;
    stopCapture();
    const std::filesystem::path folder = std::exchange(m_testFolder, {});
    if (m_test.cameras.empty()) return;
    for (const std::string& text : {std::string("--frames"), std::to_string(m_test.cameras.size()),
                                    std::string("--reference-spp"), std::string("64")})
        m_test.arguments.push_back(text);
    writeTest(folder, m_test);
}

void Recorder::startSequence(const std::filesystem::path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw FileError("cannot create the folder " + folder.string());
    m_sequence = folder;
    m_sequenced = 0;
}

void Recorder::stopCapture()
{
    if (m_capture && m_captured > 0) m_capture->finish();
    m_capture.reset();
}

void Recorder::addFrame(Viewer& viewer)
{
    const CaptureInfo info = m_capture ? viewer.renderer().captureInfo() : CaptureInfo();
    if (m_capture && (info.width != m_captureWidth || info.height != m_captureHeight))
    {
        viewer.setMessage("the capture ended: its frames have one size");
        stopCapture();
    }
    if (m_capture)
    {
        m_capture->addFrame(viewer.renderer().captureFrame(), viewer.renderer().readFrame());
        ++m_captured;
    }
    if (isTesting())
    {
        CameraKey key = keyOf(viewer.renderer().frame().view.camera);
        key.frame = uint32_t(m_test.cameras.size());
        key.time = viewer.time();
        if (viewer.renderer().frame().isCut) key.approach = Approach::Cut;
        m_test.cameras.push_back(key);
    }
    if (m_sequence.empty()) return;
    char name[32];
    std::snprintf(name, sizeof(name), "frame_%05u.png", m_sequenced++);
    savePicture(viewer, m_sequence / name);
}
} // namespace sample
