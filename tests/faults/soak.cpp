#include "soak.h"
#include <options.h>

namespace faults
{
namespace
{
template <class Enumeration> Enumeration any(Dice& dice)
{
    return static_cast<Enumeration>(dice.below(static_cast<uint32_t>(Enumeration::MAX_NUM)));
}

template <class Settings> Settings anySignalSettings(Dice& dice)
{
    Settings settings;
    settings.checkerboardMode = any<nrd::CheckerboardMode>(dice);
    settings.hitDistanceReconstructionMode = any<nrd::HitDistanceReconstructionMode>(dice);
    settings.enableAntiFirefly = dice.once(2);
    return settings;
}
} // namespace

nrd::Result changeSettings(Dice& dice, nrd::NrdIntegration& integration, nrd::Identifier identifier,
                           nrd::Denoiser denoiser)
{
    nrd::ReblurSettings reblur = anySignalSettings<nrd::ReblurSettings>(dice);
    reblur.maxStabilizedFrameNum = dice.below(64);
    nrd::SigmaSettings sigma;
    sigma.maxStabilizedFrameNum = dice.below(16);
    nrd::ReferenceSettings reference;
    reference.maxAccumulatedFrameNum = dice.below(4096);
    switch (options::familyOf(denoiser))
    {
    case options::Family::Reblur:
        return integration.SetDenoiserSettings(identifier, reblur);
    case options::Family::Relax:
        return integration.SetDenoiserSettings(identifier, anySignalSettings<nrd::RelaxSettings>(dice));
    case options::Family::Sigma:
        return integration.SetDenoiserSettings(identifier, sigma);
    case options::Family::Reference:
        break;
    }
    return integration.SetDenoiserSettings(identifier, reference);
}
} // namespace faults
