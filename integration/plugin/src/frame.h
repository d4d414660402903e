// The frame an engine sets, in the library's terms: defaults for what is 0, and the check on the thread that sets it.
#pragma once
#include "settings.h"
#include "unique_instance.h"
#include <nrd/plugin.h>

namespace nrd::plugin
{
/// As if it were the first frame: last frame's matrices, sizes and jitter are this frame's.
CommonSettings toCommonSettings(const NrdPluginFrame& frame, const uint16_t (&resourceSize)[2]);
/// SIGMA's have the frame's light.
DenoiserSettings withLight(const DenoiserSettings& settings, const NrdPluginFrame& frame);
/// Throws the sentence the descriptor library has for it.
void requireValid(Denoiser denoiser, const DenoiserSettings& settings);

/// Last frame's matrices, sizes and jitter from `last`.
void continueFrom(const CommonSettings& last, CommonSettings& settings);

class FrameChecker
{
public:
    FrameChecker();
    /// Throws the sentence the descriptor library has for it.
    void require(const NrdPluginFrame& frame);

private:
    UniqueInstance m_instance;
};
} // namespace nrd::plugin
