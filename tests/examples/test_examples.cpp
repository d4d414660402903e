// Each example denoises the noisy wall; its last picture is compared with NrdIntegration's, bit by bit.
#include "../integration/gpu_fixture.h"
#include "examples/noisy_wall.h"
#include <cstdlib>
#include <filesystem>

namespace
{
using Texels = std::vector<float>;

std::string readText(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

Texels readPicture(const std::filesystem::path& path)
{
    const std::string bytes = readText(path);
    Texels result(bytes.size() / sizeof(float));
    std::memcpy(result.data(), bytes.data(), result.size() * sizeof(float));
    return result;
}

// The program under validation; its picture is its last argument.
Texels run(const std::string& command)
{
    const std::filesystem::path folder = NRD_WORK, picture = folder / "picture.raw", log = folder / "log.txt";
    std::filesystem::remove(picture);
    const std::string layers = "VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation "
                               "VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT ";
    const int status = std::system((layers + command + " " + picture.string() + " >" + log.string() + " 2>&1").c_str());
    const std::string text = readText(log);
    INFO(text);
    CHECK(status == 0);
    CHECK(text.find("Validation Error") == std::string::npos);
    CHECK(text.find("SYNC-HAZARD") == std::string::npos);
    return readPicture(picture);
}

Texels outputs(const std::deque<test::EngineImage>& images)
{
    Texels result;
    for (size_t i = 0; i < images.size(); i++)
    {
        if (example::isInput(example::kSlots[i])) continue;
        const Texels texels = images[i].texels<float>();
        result.insert(result.end(), texels.begin(), texels.end());
    }
    return result;
}

Texels denoiseWithIntegration()
{
    test::Gpu gpu;
    nrd::IntegrationCreationDesc desc;
    desc.native = gpu.native();
    desc.resourceWidth = example::kWidth;
    desc.resourceHeight = example::kHeight;
    nrd::NrdIntegration integration;
    test::require(integration.Create(desc, example::instanceDesc()), integration);
    std::deque<test::EngineImage> images;
    for (size_t i = 0; i < std::size(example::kSlots); i++)
        images.emplace_back(gpu, rhi::Format::RGBA32_SFLOAT, example::kWidth, example::kHeight);
    test::FrameRing frames(gpu, 1);
    for (uint32_t frame = 0; frame < example::kFrameNum; frame++)
    {
        rhi::CommandBuffer& commands = frames.begin();
        test::require(integration.NewFrame(), integration);
        test::require(integration.SetCommonSettings(example::settings(frame)), integration);
        nrd::NrdUserPool pool;
        for (size_t i = 0; i < images.size(); i++)
        {
            const nrd::ResourceType slot = example::kSlots[i];
            if (example::isInput(slot)) images[i].upload(commands, example::texels(slot, frame).data());
            pool[slot] = images[i].entry;
        }
        test::require(integration.Denoise(rhi::vulkanCommandBuffer(commands), &example::kIdentifier, 1, pool),
                      integration);
        for (size_t i = 0; i < images.size(); i++)
        {
            images[i].entry.state = pool[example::kSlots[i]].state;
            if (!example::isInput(example::kSlots[i])) images[i].download(commands);
        }
        frames.end();
        frames.wait();
    }
    gpu.finish();
    return outputs(images);
}

const Texels& expectedPicture()
{
    static const Texels picture = denoiseWithIntegration();
    return picture;
}

void requireExpected(const Texels& found)
{
    const Texels& expected = expectedPicture();
    REQUIRE(expected.size() == 2u * example::kWidth * example::kHeight * 4);
    REQUIRE(found.size() == expected.size());
    CHECK(std::memcmp(found.data(), expected.data(), found.size() * sizeof(float)) == 0);
    CHECK(found[0] != 0.0f);
}

// The shaders as an installation has them: the sources, and the list of permutations beside them.
std::string installedShaders()
{
    const std::filesystem::path folder = std::filesystem::path(NRD_WORK) / "shaders";
    std::filesystem::remove_all(folder);
    std::filesystem::copy(NRD_SHADERS, folder, std::filesystem::copy_options::recursive);
    std::filesystem::copy(NRD_MANIFEST, folder);
    return folder.string();
}
} // namespace

TEST_CASE("an application's own RHI gives NrdIntegration's picture", "[program]") { requireExpected(run(NRD_OWN_RHI)); }

TEST_CASE("the plug-in driven by events gives NrdIntegration's picture", "[program]")
{
    requireExpected(run(NRD_PLUGIN_EVENTS));
}

TEST_CASE("shaders compiled at run time are the library's, and so is their picture", "[program]")
{
    requireExpected(run(std::string(NRD_WHITE_BOX) + " " + installedShaders()));
}

TEST_CASE("a changed source is not taken for the library's", "[program]")
{
    const std::string folder = installedShaders();
    const std::filesystem::path file = std::filesystem::path(folder) / "common" / "clear.comp.glsl";
    const std::string text = readText(file);
    const size_t store = text.find("TEXEL(0)");
    REQUIRE(store != std::string::npos);
    std::ofstream(file) << std::string(text).replace(store, 8, "TEXEL(1)");
    const std::filesystem::path log = std::filesystem::path(NRD_WORK) / "log.txt";
    const std::string command = std::string(NRD_WHITE_BOX) + " " + folder + " " + NRD_WORK "/none.raw";
    CHECK(std::system((command + " >" + log.string() + " 2>&1").c_str()) != 0);
    CHECK_THAT(readText(log), containing("ClearFloat differs from the library's module"));
}
