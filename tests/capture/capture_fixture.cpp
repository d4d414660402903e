#include "capture_fixture.h"

#include <atomic>
#include <fstream>
#include <random>

namespace test
{
using sample::Channel;

TempFolder::TempFolder()
{
    static std::atomic<int> count = 0;
    std::random_device random;
    m_path = std::filesystem::temp_directory_path() /
             ("nrd-test-" + std::to_string(random()) + "-" + std::to_string(count++));
    std::filesystem::create_directories(m_path);
}

TempFolder::~TempFolder()
{
    std::error_code error;
    std::filesystem::remove_all(m_path, error);
}

sample::CaptureInfo makeInfo()
{
    sample::CaptureInfo info;
    info.name = "test \"quoted\"";
    info.width = kWidth;
    info.height = kHeight;
    info.light = sample::CaptureLight{};
    return info;
}

sample::Planes makePlanes(bool isReference, float seed)
{
    sample::Planes planes(kWidth, kHeight);
    for (size_t c = 0; c < sample::kChannelCount; c++)
    {
        const Channel channel = static_cast<Channel>(c);
        if (sample::channelInfo(channel).isReference != isReference) continue;
        std::vector<float>& plane = planes[channel];
        for (size_t i = 0; i < planes.pixelCount(); i++)
            plane.push_back(seed + static_cast<float>(c) + static_cast<float>(i) * 0.125f);
    }
    return planes;
}

void writeCapture(const std::filesystem::path& folder)
{
    sample::CaptureWriter writer(folder, makeInfo());
    for (int i = 0; i < 3; i++)
    {
        sample::CaptureFrame frame;
        frame.jitter = {0.25, -0.5};
        frame.viewToClip[0] = 1.0 + i;
        frame.worldToView[15] = 1.0 / 3.0;
        writer.addFrame(frame, makePlanes(false, static_cast<float>(i)));
    }
    writer.addReference(1, makePlanes(true));
    writer.addReference(2, makePlanes(true));
    writer.finish();
}

void editJson(const std::filesystem::path& folder, const std::function<void(nlohmann::json&)>& change)
{
    const std::filesystem::path file = folder / "capture.json";
    nlohmann::json json = nlohmann::json::parse(std::ifstream(file));
    change(json);
    std::ofstream(file) << json.dump();
}

std::string errorOf(const std::function<void()>& body)
{
    try
    {
        body();
    }
    catch (const sample::FileError& e)
    {
        return e.what();
    }
    return "";
}

std::string readingError(const std::filesystem::path& folder)
{
    const auto readAll = [&]
    {
        const sample::Capture capture = sample::Capture::open(folder);
        for (size_t i = 0; i < capture.info().frames.size(); i++)
        {
            (void)capture.readFrame(i);
            if (!capture.info().frames[i].reference.empty()) (void)capture.readReference(i);
        }
    };
    return errorOf(readAll);
}
} // namespace test
