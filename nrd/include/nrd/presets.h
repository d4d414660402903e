// Settings to start from, by how much time a frame has. Each is a difference to the defaults of settings.h, which are
// BALANCED; what describes the scene (hit distance parameters, light, checkerboard) stays at its default for the caller
// to set.
#pragma once
#include <nrd/settings.h>

namespace nrd
{
enum class Quality : uint32_t
{
    FAST,     // passes that pay least for their time are left out; more flicker
    BALANCED, // the defaults
    BEST,     // what lowers the error, measured over the recorded sequences, at any price in time and lag
    MAX_NUM
};

// FAST: no pre-pass, no temporal stabilisation and with it no antilag. BEST: longer histories, which follow changes of
// light later. MAX_NUM is taken for BALANCED.
inline ReblurSettings GetReblurSettings(Quality quality)
{
    ReblurSettings settings;
    if (quality == Quality::FAST)
    {
        settings.prePassMode = PrePassMode::OFF;
        settings.maxStabilizedFrameNum = 0;
    }
    if (quality == Quality::BEST)
    {
        settings.maxAccumulatedFrameNum = 63;
        settings.maxFastAccumulatedFrameNum = 10;
    }
    return settings;
}

// FAST: no pre-pass, two iterations of the wavelet. BEST: the defaults, since neither longer histories nor more
// iterations lower the error. MAX_NUM is taken for BALANCED.
inline RelaxSettings GetRelaxSettings(Quality quality)
{
    RelaxSettings settings;
    if (quality == Quality::FAST)
    {
        settings.prePassMode = PrePassMode::OFF;
        settings.atrousIterationNum = 2;
    }
    return settings;
}

// The defaults, whatever the quality: no setting saves SIGMA a pass, and its stabilisation gains up to 5 dB for what it
// reads.
inline SigmaSettings GetSigmaSettings(Quality /*quality*/) { return {}; }
} // namespace nrd
