// What is wrong with a settings struct: the first field out of range, its value and what was expected. Pure.
#pragma once
#include "text.h"
#include <nrd/descs.h>
#include <nrd/settings.h>

namespace nrd
{
struct Error
{
    Result result = Result::SUCCESS;
    Sentence text;

    explicit operator bool() const { return result != Result::SUCCESS; }
};

Error findError(const InstanceCreationDesc& desc);
Error findError(const CommonSettings& settings, NormalEncoding normalEncoding);
Error findError(const ReblurSettings& settings);
Error findError(const RelaxSettings& settings);
Error findError(const SigmaSettings& settings);
Error findError(const ReferenceSettings& settings);
Error findError(const ConfidenceSettings& settings);
} // namespace nrd
