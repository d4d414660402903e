// capture.json as CaptureInfo and back.
#pragma once
#include "capture.h"

#include <string>

namespace sample
{
// Reads and checks capture.json. Throws FileError that names the file, the key, the value and what was expected.
CaptureInfo readCaptureInfo(const std::filesystem::path& file);

// Writes capture.json. Throws FileError.
void writeCaptureInfo(const std::filesystem::path& file, const CaptureInfo& info);
} // namespace sample
