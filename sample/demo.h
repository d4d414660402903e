// The pictures and the table of errors of --demo.
#pragma once
#include "options.h"
#include "sequence.h"

namespace sample
{
/// What one set of denoisers made of the frames with a reference.
struct DemoColumn
{
    std::string name; // "denoised", or of several "denoised-" and the set's name
    SequenceMeasurer measurer;
};

/// Writes noisy.png, a picture per column, reference.png and side-by-side.png (left to right) of the last measured
/// frame to the folder. Throws FileError.
void writeDemoPictures(const std::filesystem::path& folder, const std::vector<DemoColumn>& columns);

/// Prints the errors of the composed picture, noisy against denoised, averaged over the frames with a reference.
void printErrorTable(const std::vector<DemoColumn>& columns);
} // namespace sample
