// Files of a replay: denoised frames as EXR with the channel names of references, and PNGs of the composed pictures
// and of the validation overlay.
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

// Writes validation_NNNN.png: the overlay, RGBA in [0; 1] for the screen, over the composed picture, or over black when
// there is none. Throws FileError.
void writeOverlayPng(const std::filesystem::path& folder, size_t frameIndex, const Picture& overlay,
                     const Picture& composed);
} // namespace sample
