#include "exr_writer.h"
#include "../refusal.h"
#include <bit>
#include <cstdio>
#include <memory>

namespace nrd::dump
{
namespace
{
static_assert(std::endian::native == std::endian::little); // as the file

constexpr int32_t kFloat = 2; // pixel type

class Bytes
{
public:
    template <class T> Bytes& add(const T& value)
    {
        const char* const data = reinterpret_cast<const char*>(&value);
        m_bytes.insert(m_bytes.end(), data, data + sizeof(T));
        return *this;
    }
    Bytes& text(const std::string& value) // with its 0
    {
        m_bytes.insert(m_bytes.end(), value.c_str(), value.c_str() + value.size() + 1);
        return *this;
    }
    Bytes& attribute(const char* name, const char* type, const Bytes& value)
    {
        text(name).text(type).add(static_cast<int32_t>(value.m_bytes.size()));
        m_bytes.insert(m_bytes.end(), value.m_bytes.begin(), value.m_bytes.end());
        return *this;
    }
    const char* data() const { return m_bytes.data(); }
    size_t size() const { return m_bytes.size(); }

private:
    std::vector<char> m_bytes;
};

Bytes channelList(const Channels& channels)
{
    Bytes list;
    for (const auto& [name, values] : channels)
        list.text(name).add(kFloat).add(uint32_t{0}).add(int32_t{1}).add(int32_t{1}); // linear, not subsampled
    return list.add(char{0});
}

Bytes header(uint32_t width, uint32_t height, const Channels& channels)
{
    const int32_t right = static_cast<int32_t>(width) - 1, bottom = static_cast<int32_t>(height) - 1;
    const Bytes window = Bytes().add(int32_t{0}).add(int32_t{0}).add(right).add(bottom);
    Bytes result;
    result.add(uint32_t{20000630}).add(uint32_t{2}); // magic number, version
    result.attribute("channels", "chlist", channelList(channels));
    result.attribute("compression", "compression", Bytes().add(char{0}));
    result.attribute("dataWindow", "box2i", window);
    result.attribute("displayWindow", "box2i", window);
    result.attribute("lineOrder", "lineOrder", Bytes().add(char{0}));
    result.attribute("pixelAspectRatio", "float", Bytes().add(1.0f));
    result.attribute("screenWindowCenter", "v2f", Bytes().add(0.0f).add(0.0f));
    result.attribute("screenWindowWidth", "float", Bytes().add(1.0f));
    return result.add(char{0});
}
} // namespace

void writeExr(const std::filesystem::path& file, uint32_t width, uint32_t height, const Channels& channels)
{
    Bytes bytes = header(width, height, channels);
    const uint32_t lineSize = static_cast<uint32_t>(channels.size() * width * sizeof(float));
    const uint64_t firstLine = bytes.size() + uint64_t{height} * sizeof(uint64_t);
    for (uint64_t y = 0; y < height; y++) bytes.add(firstLine + y * (2 * sizeof(uint32_t) + lineSize));

    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.string().c_str(), "wb"), std::fclose);
    bool isGood = stream && std::fwrite(bytes.data(), bytes.size(), 1, stream.get()) == 1;
    for (uint32_t y = 0; isGood && y < height; y++)
    {
        const uint32_t lineHead[2] = {y, lineSize};
        isGood = std::fwrite(lineHead, sizeof(lineHead), 1, stream.get()) == 1;
        for (const auto& [name, values] : channels)
            isGood = isGood && std::fwrite(&values[size_t{y} * width], sizeof(float), width, stream.get()) == width;
    }
    if (!isGood || std::fflush(stream.get()) != 0)
        throw Refusal(Result::FAILURE, sentence("DumpInputs(): %s cannot be written", file.string().c_str()));
}
} // namespace nrd::dump
