// SIGMA as the descriptor library sees it: what it takes with and without history, and for many lights.
#include "fixture.h"
#include "frame_state.h"
#include "validate.h"
#include <cstdio>

using namespace test;

namespace
{
constexpr Denoiser kBoth[] = {Denoiser::SIGMA_SHADOW, Denoiser::SIGMA_SHADOW_TRANSLUCENCY};

InstancePtr makeLights(Denoiser denoiser, uint32_t num, bool hasHistory)
{
    std::vector<DenoiserDesc> descs;
    for (uint32_t i = 0; i < num; i++) descs.push_back({i, denoiser, 1, hasHistory});
    InstanceCreationDesc desc;
    desc.denoisers = descs.data();
    desc.denoisersNum = num;
    Instance* instance = nullptr;
    REQUIRE(CreateInstance(desc, instance) == Result::SUCCESS);
    return InstancePtr(instance);
}

double bytesPerPixel(const TextureDesc* textures, uint32_t num)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < num; i++)
        sum += texelByteSize(textures[i].format) / (double(textures[i].downsampleFactor) * textures[i].downsampleFactor);
    return sum;
}

bool isRequired(const Instance& instance, ResourceType type)
{
    const ResourceRequirement* requirements = nullptr;
    uint32_t num = 0;
    REQUIRE(GetRequiredResources(instance, 0, requirements, num) == Result::SUCCESS);
    for (uint32_t i = 0; i < num; i++)
        if (requirements[i].type == type) return requirements[i].isRequired;
    return false;
}

void requireRefused(const SigmaSettings& bad, const std::string& text)
{
    const nrd::Error error = findError(bad);
    CHECK(error.result == Result::INVALID_ARGUMENT);
    CHECK(std::string(error.text.c_str()) == "SigmaSettings::" + text);
}
} // namespace

TEST_CASE("sixteen lights in one instance take the transient memory of one", "[unit]")
{
    for (Denoiser denoiser : kBoth)
    {
        const InstancePtr one = makeLights(denoiser, 1, true), sixteen = makeLights(denoiser, 16, true);
        const InstanceDesc &a = GetInstanceDesc(*one), &b = GetInstanceDesc(*sixteen);
        const double single = bytesPerPixel(a.transientPool, a.transientPoolSize);
        const double many = bytesPerPixel(b.transientPool, b.transientPoolSize);
        std::printf("FIGURE %s, transient bytes per pixel: 1 light %.3f, 16 lights %.3f; permanent: %.3f, %.3f\n",
                    toString(denoiser), single, many, bytesPerPixel(a.permanentPool, a.permanentPoolSize),
                    bytesPerPixel(b.permanentPool, b.permanentPoolSize));
        CHECK(many == single);
        CHECK(b.permanentPoolSize == 16 * a.permanentPoolSize);
    }
}

TEST_CASE("without history SIGMA has no permanent memory and serves many lights in a frame", "[unit]")
{
    for (Denoiser denoiser : kBoth)
    {
        const InstancePtr instance = makeLights(denoiser, 1, false);
        const InstanceDesc& desc = GetInstanceDesc(*instance);
        CHECK(desc.permanentPoolSize == 0);
        CHECK_FALSE(isRequired(*instance, ResourceType::IN_MV));
        CommonSettings common = makeCommon();
        requestFrame(*instance, common);
        const std::vector<std::string> passes = passNames(request(*instance, {0}));
        CHECK(passes == std::vector<std::string>{"Classify tiles", "Blur", "Post-blur"});
        const InstancePtr kept = makeLights(denoiser, 1, true);
        CHECK(bytesPerPixel(desc.transientPool, desc.transientPoolSize) <
              bytesPerPixel(GetInstanceDesc(*kept).transientPool, GetInstanceDesc(*kept).transientPoolSize));
    }
}

TEST_CASE("a light with history is denoised once a frame", "[unit]")
{
    const InstancePtr instance = makeLights(Denoiser::SIGMA_SHADOW, 1, true);
    CommonSettings common = makeCommon();
    requestFrame(*instance, common);
    const DispatchDesc* dispatches = nullptr;
    uint32_t num = 0;
    const Identifier identifier = 0;
    CHECK(GetComputeDispatches(*instance, &identifier, 1, dispatches, num) == Result::INVALID_ARGUMENT);
}

TEST_CASE("SIGMA needs motion only where it stabilises, and colour only where there is some", "[unit]")
{
    const InstancePtr instance = makeInstance({Denoiser::SIGMA_SHADOW});
    CHECK(isRequired(*instance, ResourceType::IN_MV));
    CHECK(isRequired(*instance, ResourceType::IN_PENUMBRA));
    CHECK_FALSE(isRequired(*instance, ResourceType::IN_TRANSLUCENCY));
    SigmaSettings settings;
    settings.maxStabilizedFrameNum = 0;
    REQUIRE(SetDenoiserSettings(*instance, 0, settings) == Result::SUCCESS);
    CHECK_FALSE(isRequired(*instance, ResourceType::IN_MV));
    CHECK(isRequired(*makeInstance({Denoiser::SIGMA_SHADOW_TRANSLUCENCY}), ResourceType::IN_TRANSLUCENCY));
}

TEST_CASE("fields of SigmaSettings keep to their ranges", "[unit]")
{
    CHECK_FALSE(findError(SigmaSettings{}));
    SigmaSettings s;
    s.maxStabilizedFrameNum = 15;
    s.planeDistanceSensitivity = 1.0f;
    s.checkerboardMode = CheckerboardMode::WHITE;
    s.lightDirection[1] = -3e38f;
    CHECK_FALSE(findError(s));
    s = {};
    s.maxStabilizedFrameNum = 16;
    requireRefused(s, "maxStabilizedFrameNum is 16, expected [0; 15]");
    s = {};
    s.planeDistanceSensitivity = 0.0f;
    requireRefused(s, "planeDistanceSensitivity is 0, expected (0; 1]");
    s = {};
    s.checkerboardMode = CheckerboardMode::MAX_NUM;
    requireRefused(s, "checkerboardMode is 3, expected an enumerator");
    for (auto vector : {&SigmaSettings::lightDirection, &SigmaSettings::lightPosition})
    {
        s = {};
        (s.*vector)[2] = std::numeric_limits<float>::quiet_NaN();
        const nrd::Error error = findError(s);
        CHECK(error.result == Result::INVALID_ARGUMENT);
        CHECK(std::string(error.text.c_str()).find("[2] is nan") != std::string::npos);
    }
}

TEST_CASE("the light reaches the shaders in view space: unit, a position, or not at all", "[unit]")
{
    const InstancePtr instance = makeInstance({Denoiser::SIGMA_SHADOW});
    CommonSettings common = makeCommon();
    setCameraPosition(common.worldToViewMatrix, 10.0f, 0.0f, 0.0f);
    const auto light = [&](const SigmaSettings& settings)
    {
        REQUIRE(SetDenoiserSettings(*instance, 0, settings) == Result::SUCCESS);
        return constantsOf<nrd::shared::DenoiserConstants>(requestFrame(*instance, common).back()).sigmaLight;
    };
    SigmaSettings settings;
    CHECK(light(settings).w == 0.0f);
    settings.lightDirection[1] = 5.0f;
    CHECK(light(settings).w == 1.0f);
    CHECK(light(settings).y == Approx(1.0f));
    settings.isLightLocal = true;
    settings.lightPosition[0] = 12.0f;
    CHECK(light(settings).w == 2.0f);
    CHECK(light(settings).x == Approx(2.0f));
}
