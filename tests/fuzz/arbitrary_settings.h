// Settings with a few fields that hold something else than they should.
#pragma once
#include "byte_reader.h"
#include "replay_settings.h"

namespace fuzz
{
void changeSettings(sample::ReplaySettings& settings, sample::Family family, ByteReader& reader);
} // namespace fuzz
