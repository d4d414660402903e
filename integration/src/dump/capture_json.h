// capture.json of a dump: cameras and settings of its frames.
#pragma once
#include "dump_frame.h"

namespace nrd::dump
{
std::string frameFileName(size_t index); // "frame_0000.exr"

/// `frames` must not be empty; `notes` say what the format could not hold. Throws a Refusal.
void writeCaptureJson(const std::filesystem::path& folder, const std::vector<FrameContext>& frames,
                      const std::vector<std::string>& notes);
} // namespace nrd::dump
