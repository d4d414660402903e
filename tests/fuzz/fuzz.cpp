#include "fuzz.h"

#include <cstdio>
#include <cstdlib>

namespace fuzz
{
namespace
{
struct CallCounter
{
    uint64_t num = 0;
    ~CallCounter()
    {
        std::printf("FIGURE fuzzed calls of " NRD_FUZZ_TARGET ": %llu\n", static_cast<unsigned long long>(num));
    }
};
CallCounter g_calls;
} // namespace

void countCall() { g_calls.num++; }
uint64_t callNum() { return g_calls.num; }

void require(bool isTrue, const char* promise)
{
    if (isTrue) return;
    std::fprintf(stderr, "broken promise: %s\n", promise);
    std::abort();
}

std::string damaged(std::string valid, ByteReader& reader)
{
    for (uint32_t edits = reader.below(8); edits > 0 && !valid.empty(); edits--)
    {
        const size_t at = reader.value<uint32_t>() % valid.size();
        const uint32_t kind = reader.below(16);
        if (kind == 0)
            valid.resize(at);
        else if (kind < 4)
            valid.erase(at, 1 + reader.below(8));
        else if (kind < 8)
            valid.insert(at, 1, reader.value<char>());
        else
            valid[at] = reader.value<char>();
    }
    return valid;
}
} // namespace fuzz
