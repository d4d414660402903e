// The families of this build. A new family is one file beside this one and one entry here.
#pragma once
#include "pass_table.h"

namespace nrd
{
extern const Family kReblur;
extern const Family kRelax;
extern const Family kSigma;
extern const Family kReference;
extern const Family kHistoryConfidence; // no denoiser, so not among those below

constexpr const Family* kFamilies[] = {&kReblur, &kRelax, &kSigma, &kReference};
} // namespace nrd
