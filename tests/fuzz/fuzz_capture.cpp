// The capture reader: any bytes in one of a capture's files give pixels or a FileError with a sentence.
#include "capture_fixture.h"
#include "fuzz.h"

#include <array>
#include <fstream>

namespace
{
constexpr std::array<const char*, 3> kFiles = {"capture.json", "frame_0000.exr", "frame_0001.exr"};

std::string readBytes(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void writeBytes(const std::filesystem::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary) << bytes;
}

struct Seed
{
    test::TempFolder folder;
    std::array<std::string, kFiles.size()> files;

    Seed()
    {
        test::writeCapture(folder.path());
        for (size_t i = 0; i < kFiles.size(); i++) files[i] = readBytes(folder.path() / kFiles[i]);
    }
};
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    static const Seed seed;
    fuzz::ByteReader reader(bytes, size);
    while (!reader.isEmpty())
    {
        const size_t index = reader.below(kFiles.size());
        const std::filesystem::path file = seed.folder.path() / kFiles[index];
        writeBytes(file, fuzz::damaged(seed.files[index], reader));
        fuzz::countCall();
        try
        {
            const sample::Capture capture = sample::Capture::open(seed.folder.path());
            for (size_t i = 0; i < capture.info().frames.size(); i++) (void)capture.readFrame(i);
        }
        catch (const sample::FileError& error)
        {
            fuzz::require(*error.what() != 0, "a refused capture is explained");
        }
        writeBytes(file, seed.files[index]);
    }
    return 0;
}
