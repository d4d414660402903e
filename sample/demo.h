// The pictures and the table of errors of --demo.
#pragma once
#include "options.h"
#include "sequence.h"

namespace sample
{
/// Writes noisy.png, denoised.png, reference.png and side-by-side.png (left to right) of the last measured frame to
/// the folder. Throws FileError.
void writeDemoPictures(const std::filesystem::path& folder, const ComposedPictures& pictures);

/// Prints the errors of the composed picture, noisy against denoised, averaged over the frames with a reference.
void printErrorTable(const SequenceMeasurer& measurer);
} // namespace sample
