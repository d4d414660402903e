// What an application may ask an instance for, made of bytes: mostly sensible, now and then anything.
#pragma once
#include "byte_reader.h"

#include <nrd/descs.h>

namespace fuzz
{
constexpr uint32_t kMaxDenoiserNum = 6;
constexpr uint32_t kIdentifierNum = 8; // more than denoisers: some belong to none

struct ArbitraryInstance
{
    nrd::DenoiserDesc denoisers[kMaxDenoiserNum];
    nrd::InstanceCreationDesc desc; // of these denoisers, or of a null pointer
};
/// Reports are checked and counted in `reportNum`, which is borrowed.
void makeArbitrary(ArbitraryInstance& instance, ByteReader& reader, uint32_t& reportNum);

/// One of kIdentifierNum, or history confidence's.
nrd::Identifier arbitraryIdentifier(ByteReader& reader);
} // namespace fuzz
