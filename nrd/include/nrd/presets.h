// Settings to start from, by how much time a frame has. Each is a difference to the defaults of settings.h, which are
// BALANCED; what describes the scene (hit distance parameters, light, checkerboard) stays at its default for the caller
// to set.
#pragma once
#include <nrd/settings.h>

namespace nrd
{
enum class Quality : uint32_t
{
    FAST,     // passes that pay least for their time are left out
    BALANCED, // the defaults
    BEST,     // a longer history and a wider filter: still pictures gain, changes of light are followed later
    MAX_NUM
};

// MAX_NUM and beyond are taken for BALANCED.
inline ReblurSettings GetReblurSettings(Quality quality)
{
    ReblurSettings settings;
    if (quality == Quality::FAST)
    {
        settings.prePassMode = PrePassMode::OFF;
        settings.maxStabilizedFrameNum = 0;
    }
    if (quality == Quality::BEST) settings.maxAccumulatedFrameNum = 63;
    return settings;
}

inline RelaxSettings GetRelaxSettings(Quality quality)
{
    RelaxSettings settings;
    if (quality == Quality::FAST)
    {
        settings.prePassMode = PrePassMode::OFF;
        settings.atrousIterationNum = 2;
    }
    if (quality == Quality::BEST)
    {
        settings.atrousIterationNum = 4;
        settings.diffuseMaxAccumulatedFrameNum = settings.specularMaxAccumulatedFrameNum = 63;
    }
    return settings;
}

inline SigmaSettings GetSigmaSettings(Quality quality)
{
    SigmaSettings settings;
    if (quality == Quality::FAST) settings.maxStabilizedFrameNum = 0;
    if (quality == Quality::BEST) settings.maxStabilizedFrameNum = 7;
    return settings;
}
} // namespace nrd
