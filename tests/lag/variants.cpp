#include "variants.h"
#include <string_view>

namespace lag
{
namespace
{
bool hasInName(nrd::Denoiser denoiser, std::string_view part)
{
    return std::string_view(nrd::toString(denoiser)).find(part) != std::string_view::npos;
}

nrd::RelaxSettings makeRelax(Reaction reaction)
{
    nrd::RelaxSettings settings;
    if (!reaction.hasAntilag) settings.antilagSettings.accelerationAmount = settings.antilagSettings.resetAmount = 0.0f;
    if (!reaction.hasClamping)
    {
        settings.diffuseMaxFastAccumulatedFrameNum = settings.diffuseMaxAccumulatedFrameNum;
        settings.specularMaxFastAccumulatedFrameNum = settings.specularMaxAccumulatedFrameNum;
    }
    return settings;
}

nrd::ReblurSettings makeReblur(Reaction reaction)
{
    nrd::ReblurSettings settings;
    if (!reaction.hasAntilag) settings.antilagSettings = {100.0f, 100.0f}; // differences that never come up
    if (!reaction.hasClamping) settings.maxFastAccumulatedFrameNum = settings.maxAccumulatedFrameNum;
    return settings;
}
} // namespace

bool isRelax(nrd::Denoiser denoiser) { return hasInName(denoiser, "RELAX"); }
bool isSpecular(nrd::Denoiser denoiser) { return hasInName(denoiser, "SPECULAR"); }

quality::Settings makeSettings(nrd::Denoiser denoiser, Reaction reaction)
{
    if (isRelax(denoiser)) return makeRelax(reaction);
    return makeReblur(reaction);
}

quality::Settings makeFireflySettings(nrd::Denoiser denoiser, bool hasAntiFirefly, bool hasPrePass)
{
    quality::Settings settings = makeSettings(denoiser, {true, true});
    const auto change = [&](auto& chosen)
    {
        chosen.enableAntiFirefly = hasAntiFirefly;
        chosen.prePassMode = hasPrePass ? nrd::PrePassMode::SIMPLE : nrd::PrePassMode::OFF;
    };
    std::visit(change, settings);
    return settings;
}

quality::Signal packFor(nrd::Denoiser denoiser, quality::Signal grey)
{
    for (glm::vec4& v : grey)
    {
        if (isRelax(denoiser))
            v.w *= 4.0f; // world units
        else
            v.y = v.z = 0.0f; // no chroma
    }
    return grey;
}

const quality::Signal& denoiseLobe(quality::Harness& harness, nrd::Denoiser denoiser, const quality::Guides& guides,
                                   const quality::Signal& grey)
{
    const quality::Signal packed = packFor(denoiser, grey);
    harness.denoise({guides, packed, packed});
    return isSpecular(denoiser) ? harness.specular() : harness.diffuse();
}
} // namespace lag
