// The sample's scenes: any bytes give a scene or a SceneError with a sentence.
#include "fuzz.h"
#include "gltf.h"
#include "gltf_builder.h"

#include <fstream>

namespace
{
std::string readBytes(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// The folder holds the buffer of the text form all along.
struct Seeds
{
    test::TemporaryFolder folder;
    std::string binary;
    std::string text;

    Seeds()
    {
        const test::GltfFile triangle = test::makeTriangle();
        triangle.writeBinary(folder / "seed.glb");
        triangle.writeText(folder / "seed.gltf");
        binary = readBytes(folder / "seed.glb");
        text = readBytes(folder / "seed.gltf");
    }
};
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    static const Seeds seeds;
    fuzz::ByteReader reader(bytes, size);
    while (!reader.isEmpty())
    {
        const bool isBinary = reader.flag();
        const std::filesystem::path file = seeds.folder / (isBinary ? "fuzzed.glb" : "fuzzed.gltf");
        std::ofstream(file, std::ios::binary) << fuzz::damaged(isBinary ? seeds.binary : seeds.text, reader);
        fuzz::countCall();
        try
        {
            const sample::Scene scene = sample::loadGltf(file);
        }
        catch (const sample::SceneError& error)
        {
            fuzz::require(*error.what() != 0, "a refused file is explained");
        }
    }
    return 0;
}
