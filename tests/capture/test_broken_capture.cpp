#include "capture_fixture.h"
#include "exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

using namespace sample;
using namespace test;
using Json = nlohmann::json;

namespace
{
std::string readBytes(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void writeBytes(const std::filesystem::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary) << bytes;
}

void editFrame(const std::filesystem::path& folder, const std::function<void(ExrPicture&)>& change)
{
    ExrPicture picture = readExr(folder / "frame_0001.exr");
    change(picture);
    writeExr(folder / "frame_0001.exr", picture);
}

struct BadValue
{
    const char* pointer; // in capture.json
    Json value;          // discarded: the key is removed
    const char* key;     // that the error names
};

const Json kRemoved = Json(Json::value_t::discarded);
} // namespace

TEST_CASE("every wrong value of capture.json is named", "[unit]")
{
    const BadValue rows[] = {
        {"/format", "other", "format"},
        {"/format", 7, "format"},
        {"/version", 2, "version"},
        {"/version", "1", "version"},
        {"/version", kRemoved, "version"},
        {"/name", 1, "name"},
        {"/resolution", {0, 5}, "resolution"},
        {"/resolution", {7.5, 5}, "resolution"},
        {"/resolution", {7, -5}, "resolution"},
        {"/resolution", {1000000000, 1000000000}, "resolution"},
        {"/resolution", {7, 5, 1}, "resolution"},
        {"/resolution", {"7", "5"}, "resolution"},
        {"/resolution", "7x5", "resolution"},
        {"/metersPerUnit", 0, "metersPerUnit"},
        {"/denoisingRange", -1, "denoisingRange"},
        {"/denoisingRange", nullptr, "denoisingRange"},
        {"/denoisingRange", 1e300, "denoisingRange"},
        {"/hitDistanceParameters", {3, 0.1, 20}, "hitDistanceParameters"},
        {"/hitDistanceParameters", {0, 0.1, 20, -25}, "hitDistanceParameters"},
        {"/checkerboard", "red", "checkerboard"},
        {"/checkerboard", true, "checkerboard"},
        {"/light", 5, "light"},
        {"/light/direction", {0, 0, 0}, "light.direction"},
        {"/light/direction", {0, 0}, "light.direction"},
        {"/light/tanAngularRadius", -0.1, "light.tanAngularRadius"},
        {"/light", {{"position", {0, 0, 0}}, {"radius", 0}}, "light.radius"},
        {"/light", kRemoved, "light"},
        {"/frames", kRemoved, "frames"},
        {"/frames", Json::array(), "frames"},
        {"/frames", Json::object(), "frames"},
        {"/frames/1", 3, "frames[1]"},
        {"/frames/1/frame", kRemoved, "frames[1].frame"},
        {"/frames/1/frame", 3, "frames[1].frame"},
        {"/frames/1/frame", "", "frames[1].frame"},
        {"/frames/1/frame", "../frame_0001.exr", "frames[1].frame"},
        {"/frames/1/reference", false, "frames[1].reference"},
        {"/frames/1/deltaTimeMs", -1, "frames[1].deltaTimeMs"},
        {"/frames/1/deltaTimeMs", kRemoved, "frames[1].deltaTimeMs"},
        {"/frames/1/jitter", {0.6, 0}, "frames[1].jitter"},
        {"/frames/1/cut", "no", "frames[1].cut"},
        {"/frames/0/cut", false, "frames[0].cut"},
        {"/frames/1/viewToClip", {1, 2, 3}, "frames[1].viewToClip"},
        {"/frames/1/worldToView/4", nullptr, "frames[1].worldToView"},
        {"/frames/1/light", true, "frames[1].light"},
    };
    TempFolder folder;
    writeCapture(folder.path());
    const std::string good = readBytes(folder.path() / "capture.json");
    for (const BadValue& row : rows)
    {
        INFO(row.pointer << " = " << (row.value.is_discarded() ? "removed" : row.value.dump()));
        writeBytes(folder.path() / "capture.json", good);
        const auto change = [&](Json& json)
        {
            const Json::json_pointer pointer(row.pointer);
            if (row.value.is_discarded())
                json[pointer.parent_pointer()].erase(pointer.back());
            else
                json[pointer] = row.value;
        };
        editJson(folder.path(), change);
        const std::string error = readingError(folder.path());
        CHECK_THAT(error, containing("capture.json: " + std::string(row.key)));
        CHECK(error.find('\n') == std::string::npos);
    }
}

TEST_CASE("text that is no JSON object ends in one sentence", "[unit]")
{
    TempFolder folder;
    writeCapture(folder.path());
    for (const std::string& text : {std::string(), std::string("{"), std::string("[1, 2]"), std::string("null"),
                                    std::string("\xff\xfe{}"), std::string(100000, '['), std::string("{\"a\":1e999}")})
    {
        writeBytes(folder.path() / "capture.json", text);
        CHECK_THAT(readingError(folder.path()), containing("capture.json"));
    }
}

TEST_CASE("missing folders and files are named", "[unit]")
{
    TempFolder folder;
    CHECK_THAT(readingError(folder.path() / "none"), containing("none is not a folder"));
    CHECK_THAT(readingError(folder.path()), containing("capture.json does not exist"));
    writeCapture(folder.path());
    std::filesystem::remove(folder.path() / "reference_0002.exr");
    CHECK_THAT(readingError(folder.path()), containing("reference_0002.exr does not exist"));
    std::filesystem::remove(folder.path() / "frame_0001.exr");
    CHECK_THAT(readingError(folder.path()), containing("frame_0001.exr does not exist"));
    std::filesystem::create_directory(folder.path() / "frame_0001.exr");
    CHECK_THAT(readingError(folder.path()), containing("frame_0001.exr does not exist"));
}

TEST_CASE("a frame of another size, with half a layer or with other layers is named", "[unit]")
{
    TempFolder folder;
    const auto channelOf = [](ExrPicture& picture, const std::string& name)
    { return std::find_if(picture.channels.begin(), picture.channels.end(), [&](auto& c) { return c.name == name; }); };

    writeCapture(folder.path());
    editJson(folder.path(), [](Json& json) { json["resolution"] = {5, 7}; });
    CHECK_THAT(readingError(folder.path()),
               containing("frame_0000.exr has 7 x 5 pixels, but the capture states 5 x 7"));

    writeCapture(folder.path());
    editFrame(folder.path(), [&](ExrPicture& p) { p.channels.erase(channelOf(p, "diffuse.hitDist")); });
    CHECK_THAT(readingError(folder.path()),
               containing("frame_0001.exr has no channel diffuse.hitDist, though it has diffuse."));

    writeCapture(folder.path());
    editFrame(folder.path(), [&](ExrPicture& p) { p.channels.erase(channelOf(p, "viewZ")); });
    CHECK_THAT(readingError(folder.path()), containing("frame_0001.exr has no channel viewZ"));

    writeCapture(folder.path());
    editFrame(folder.path(), [&](ExrPicture& p) { p.channels.erase(channelOf(p, "roughness")); });
    CHECK_THAT(readingError(folder.path()),
               containing("frame_0001.exr has no channel roughness, though frame_0000.exr has it"));

    writeCapture(folder.path());
    editFrame(folder.path(),
              [&](ExrPicture& p) {
                  p.channels.push_back({"extra", ExrType::Half, p.channels[0].values});
              });
    CHECK(readingError(folder.path()).empty()); // channels the format does not know do no harm
}

TEST_CASE("a guide that is not finite is named with its pixel", "[unit]")
{
    TempFolder folder;
    for (const char* name : {"viewZ", "normal.Y", "roughness", "motion.Z"})
    {
        for (const float value : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()})
        {
            writeCapture(folder.path());
            const auto poison = [&](ExrPicture& picture)
            {
                for (ExrChannel& channel : picture.channels)
                    if (channel.name == name) channel.values[2 * kWidth + 4] = value;
            };
            editFrame(folder.path(), poison);
            CHECK(readingError(folder.path()) == (folder.path() / "frame_0001.exr").string() + ", channel " + name +
                                                     " is " + (std::isnan(value) ? "NaN" : "infinite") +
                                                     " at pixel (4, 2)");
        }
    }
}

TEST_CASE("a lossy frame is refused", "[unit]")
{
    TempFolder folder;
    writeCapture(folder.path());
    const ExrPicture picture = readExr(folder.path() / "frame_0001.exr");
    Imf::Header header(picture.width, picture.height);
    header.compression() = Imf::DWAA_COMPRESSION;
    Imf::FrameBuffer buffer;
    for (const ExrChannel& channel : picture.channels)
    {
        header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
        buffer.insert(channel.name, Imf::Slice::Make(Imf::FLOAT, channel.values.data(), header.dataWindow()));
    }
    {
        Imf::OutputFile output((folder.path() / "frame_0001.exr").c_str(), header);
        output.setFrameBuffer(buffer);
        output.writePixels(picture.height);
    }
    CHECK_THAT(readingError(folder.path()), containing("frame_0001.exr uses a lossy compression"));
}

TEST_CASE("a truncated frame is refused at every length", "[unit]")
{
    TempFolder folder;
    writeCapture(folder.path());
    const std::string bytes = readBytes(folder.path() / "frame_0001.exr");
    for (size_t length = 0; length < bytes.size(); length += length < 400 ? 1 : 97)
    {
        INFO("length " << length << " of " << bytes.size());
        writeBytes(folder.path() / "frame_0001.exr", bytes.substr(0, length));
        CHECK_THAT(readingError(folder.path()), containing("frame_0001.exr"));
    }
}

TEST_CASE("changed bytes in a frame end in an error or in a picture, never in a crash", "[unit]")
{
    TempFolder folder;
    writeCapture(folder.path());
    const std::string good = readBytes(folder.path() / "frame_0001.exr");
    std::mt19937 random(7);
    int refusedCount = 0;
    for (int i = 0; i < 1500; i++)
    {
        std::string bytes = good;
        // Headers are the larger half of such a small file; every second change goes to its first 300 bytes.
        const size_t limit = i % 2 ? bytes.size() : 300;
        for (int k = 0; k < 1 + i % 4; k++) bytes[random() % limit] = static_cast<char>(random());
        writeBytes(folder.path() / "frame_0001.exr", bytes);
        const std::string error = readingError(folder.path());
        refusedCount += !error.empty();
        if (!error.empty()) CHECK_THAT(error, containing("frame_0001.exr"));
        CHECK(error.find('\n') == std::string::npos);
    }
    CHECK(refusedCount > 300);
}
