// What every target shares. A target defines LLVMFuzzerTestOneInput(), run by libFuzzer or by the driver's fixed seed.
#pragma once
#include "byte_reader.h"

#include <string>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size);

namespace fuzz
{
// One call of the fuzzed surface; the total is printed as a figure when the program ends.
void countCall();
uint64_t callNum();

// Ends the program, as a crash does, with the sentence of the broken promise.
void require(bool isTrue, const char* promise);

// A valid text or file with a few bytes overwritten, inserted, removed, or its end cut off: what is near to valid gets
// deeper into a parser than noise does.
std::string damaged(std::string valid, ByteReader& reader);
} // namespace fuzz
