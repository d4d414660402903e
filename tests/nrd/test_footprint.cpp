// What an instance takes: its dispatches, pools and bytes per pixel, and that a lobe it does not have costs nothing.
#include "fixture.h"
#include "spirv.h"
#include <algorithm>
#include <initializer_list>
#include <iomanip>
#include <sstream>

using namespace test;

namespace
{
constexpr uint32_t kWidth = 2560;
constexpr uint32_t kHeight = 1440;

// Both pools of NVIDIA NRD 4.17.4 at 2560 x 1440, as allocated by a plain Vulkan host, in MiB.
struct PeerRow
{
    Denoiser denoiser;
    double mebibytes;
};
constexpr PeerRow kPeer[] = {
    {Denoiser::REBLUR_DIFFUSE, 135.02},
    {Denoiser::REBLUR_DIFFUSE_OCCLUSION, 63.77},
    {Denoiser::REBLUR_DIFFUSE_SH, 195.02},
    {Denoiser::REBLUR_SPECULAR, 168.77},
    {Denoiser::REBLUR_SPECULAR_OCCLUSION, 78.77},
    {Denoiser::REBLUR_SPECULAR_SH, 228.77},
    {Denoiser::REBLUR_DIFFUSE_SPECULAR, 262.52},
    {Denoiser::REBLUR_DIFFUSE_SPECULAR_OCCLUSION, 105.02},
    {Denoiser::REBLUR_DIFFUSE_SPECULAR_SH, 412.52},
    {Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION, 127.52},
    {Denoiser::RELAX_DIFFUSE, 161.27},
    {Denoiser::RELAX_DIFFUSE_SH, 281.27},
    {Denoiser::RELAX_SPECULAR, 180.02},
    {Denoiser::RELAX_SPECULAR_SH, 300.02},
    {Denoiser::RELAX_DIFFUSE_SPECULAR, 300.02},
    {Denoiser::RELAX_DIFFUSE_SPECULAR_SH, 540.02},
    {Denoiser::SIGMA_SHADOW, 56.37},
    {Denoiser::SIGMA_SHADOW_TRANSLUCENCY, 90.12},
    {Denoiser::REFERENCE, 60.00},
};

bool hasWord(Denoiser denoiser, const char* word)
{
    return std::string(toString(denoiser)).find(word) != std::string::npos;
}

std::vector<Denoiser> supportedOf(std::initializer_list<const char*> families)
{
    const LibraryDesc& library = GetLibraryDesc();
    std::vector<Denoiser> result;
    for (uint32_t i = 0; i < library.supportedDenoisersNum; i++)
        for (const char* family : families)
            if (hasWord(library.supportedDenoisers[i], family)) result.push_back(library.supportedDenoisers[i]);
    return result;
}

CommonSettings commonOfSize()
{
    CommonSettings common = makeCommon();
    for (auto size : {&common.resourceSize, &common.resourceSizePrev, &common.rectSize, &common.rectSizePrev})
    {
        (*size)[0] = kWidth;
        (*size)[1] = kHeight;
    }
    return common;
}

// Nothing left out: split screen, anti-firefly, every optional input.
std::vector<DispatchDesc> requestEverything(Instance& instance, Denoiser denoiser)
{
    CommonSettings common = commonOfSize();
    common.splitScreen = 0.5f;
    common.isHistoryConfidenceAvailable = common.isDisocclusionThresholdMixAvailable = true;
    common.isSpecularMotionAvailable = true;
    ReblurSettings reblur;
    RelaxSettings relax;
    reblur.enableAntiFirefly = relax.enableAntiFirefly = true;
    const bool isRelax = hasWord(denoiser, "RELAX");
    REQUIRE((isRelax ? SetDenoiserSettings(instance, 0, relax) : SetDenoiserSettings(instance, 0, reblur)) ==
            Result::SUCCESS);
    return requestFrame(instance, common);
}

uint64_t byteSize(const TextureDesc* textures, uint32_t num)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < num; i++)
    {
        const uint32_t factor = std::max<uint32_t>(textures[i].downsampleFactor, 1);
        REQUIRE(texelByteSize(textures[i].format) > 0);
        sum += uint64_t(texelByteSize(textures[i].format)) * ((kWidth + factor - 1) / factor) *
               ((kHeight + factor - 1) / factor);
    }
    return sum;
}

double bytesPerPixel(uint64_t bytes) { return static_cast<double>(bytes) / (double(kWidth) * kHeight); }

void list(std::ostream& out, const char* pool, const TextureDesc* textures, uint32_t num)
{
    out << "  " << pool << ", " << bytesPerPixel(byteSize(textures, num)) << " bytes per pixel:";
    for (uint32_t i = 0; i < num; i++)
    {
        out << ' ' << toString(textures[i].format);
        if (textures[i].downsampleFactor > 1) out << "/" << textures[i].downsampleFactor;
    }
    out << '\n';
}

std::string describe(Denoiser denoiser, const InstanceDesc& desc, const std::vector<DispatchDesc>& dispatches)
{
    std::ostringstream out;
    out << std::fixed << std::setprecision(2) << toString(denoiser) << '\n';
    for (const DispatchDesc& dispatch : dispatches)
        out << "  " << dispatch.name << ": " << desc.pipelines[dispatch.pipelineIndex].texturesNum << " read, "
            << desc.pipelines[dispatch.pipelineIndex].storageTexturesNum << " written\n";
    list(out, "permanent", desc.permanentPool, desc.permanentPoolSize);
    list(out, "transient", desc.transientPool, desc.transientPoolSize);
    return out.str();
}

// A lobe's word is spelled one way by slots ("SPEC") and another by passes, shaders and bindings ("Specular").
void checkAbsent(const InstanceDesc& desc, const DispatchDesc& dispatch, const char* slotWord, const char* word)
{
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    const PipelineDesc& pipeline = desc.pipelines[dispatch.pipelineIndex];
    CHECK_FALSE(has(std::string(dispatch.name).substr(std::string(dispatch.name).find(" - ")), word));
    INFO(pipeline.shaderIdentifier);
    CHECK_FALSE(has(pipeline.shaderIdentifier, word));
    for (uint32_t i = 0; i < dispatch.resourcesNum; i++)
        CHECK_FALSE(has(toString(dispatch.resources[i].type), slotWord));
    const SPIRV& code = pipeline.computeShaderSPIRV;
    for (const ShaderBinding& binding : parseSpirv(code.words, code.byteSize).bindings)
    {
        INFO(binding.name);
        CHECK_FALSE(has(binding.name, word));
    }
}
} // namespace

TEST_CASE("no denoiser takes more memory than the peer's", "[unit]")
{
    REQUIRE(supportedOf({""}).size() == std::size(kPeer));
    for (Denoiser denoiser : supportedOf({""}))
    {
        const InstancePtr instance = makeInstance({denoiser});
        const InstanceDesc& desc = GetInstanceDesc(*instance);
        CommonSettings common = commonOfSize();
        requestFrame(*instance, common); // the first one clears
        WARN(describe(denoiser, desc, requestFrame(*instance, common)));
        const PeerRow* peer = std::find_if(std::begin(kPeer), std::end(kPeer),
                                           [&](const PeerRow& row) { return row.denoiser == denoiser; });
        REQUIRE(peer != std::end(kPeer));
        const double ours = bytesPerPixel(byteSize(desc.permanentPool, desc.permanentPoolSize) +
                                          byteSize(desc.transientPool, desc.transientPoolSize));
        INFO(toString(denoiser));
        CHECK(ours > 0.0);
        CHECK(ours <= peer->mebibytes * 1024.0 * 1024.0 / (double(kWidth) * kHeight));
    }
}

TEST_CASE("of a lobe that a denoiser does not have there is no dispatch, slot, shader or binding", "[unit]")
{
    for (Denoiser denoiser : supportedOf({"REBLUR", "RELAX"}))
    {
        const InstancePtr instance = makeInstance({denoiser});
        const InstanceDesc& desc = GetInstanceDesc(*instance);
        INFO(toString(denoiser));
        for (const DispatchDesc& dispatch : requestEverything(*instance, denoiser))
        {
            INFO(dispatch.name);
            if (!hasWord(denoiser, "SPECULAR")) checkAbsent(desc, dispatch, "SPEC", "Specular");
            if (!hasWord(denoiser, "DIFFUSE")) checkAbsent(desc, dispatch, "DIFF", "Diffuse");
        }
        const ResourceRequirement* requirements = nullptr;
        uint32_t num = 0;
        REQUIRE(GetRequiredResources(*instance, 0, requirements, num) == Result::SUCCESS);
        for (uint32_t i = 0; i < num; i++)
        {
            const std::string slot = toString(requirements[i].type);
            INFO(slot);
            if (!hasWord(denoiser, "SPECULAR")) CHECK(slot.find("SPEC") == std::string::npos);
            if (!hasWord(denoiser, "DIFFUSE")) CHECK(slot.find("DIFF") == std::string::npos);
        }
    }
}

TEST_CASE("a REBLUR of both lobes takes less than two of one, and one of one lobe less than of both", "[unit]")
{
    const auto bytesOf = [](const std::vector<Denoiser>& denoisers)
    {
        const InstancePtr instance = makeInstance(denoisers);
        const InstanceDesc& desc = GetInstanceDesc(*instance);
        return byteSize(desc.permanentPool, desc.permanentPoolSize) +
               byteSize(desc.transientPool, desc.transientPoolSize);
    };
    const uint64_t diffuse = bytesOf({Denoiser::REBLUR_DIFFUSE}), specular = bytesOf({Denoiser::REBLUR_SPECULAR});
    const uint64_t both = bytesOf({kReblurBoth});
    CHECK(diffuse < both);
    CHECK(specular < both);
    CHECK(diffuse + specular > both);
    // Two denoisers of one instance share what is transient.
    CHECK(bytesOf({Denoiser::REBLUR_DIFFUSE, Denoiser::REBLUR_SPECULAR}) < diffuse + specular);
}
