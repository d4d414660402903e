// Files of a replay: denoised frames as EXR with the channel names of references, and PNGs of the composed pictures.
#pragma once
#include "signals.h"

#include <filesystem>

namespace sample
{
// Writes denoised_NNNN.exr into `folder`. Throws FileError.
void writeDenoisedExr(const std::filesystem::path& folder, size_t frameIndex, const Signals& signals);

// Writes <stem>_NNNN.png of a composed picture; does nothing when there is none. Throws FileError.
void writeComposedPng(const std::filesystem::path& folder, const char* stem, size_t frameIndex,
                      const Picture& composed);
} // namespace sample
