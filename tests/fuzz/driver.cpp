// The fixed-seed form, for compilers without libFuzzer: random inputs until the asked number of calls was made.
#include "fuzz.h"

#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

namespace
{
constexpr uint32_t kSeed = 6;
constexpr uint64_t kLongFactor = 10;
constexpr size_t kMaxInputSize = 1024; // bytes, about forty calls of the hungriest target

std::vector<uint8_t> randomInput(std::mt19937& random)
{
    std::vector<uint8_t> input(1 + random() % kMaxInputSize);
    for (uint8_t& byte : input) byte = static_cast<uint8_t>(random());
    return input;
}
} // namespace

int main(int argc, char** argv)
{
    uint64_t callNum = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 0;
    if (std::getenv("NRD_TEST_LONG")) callNum *= kLongFactor;
    if (callNum == 0)
    {
        std::fprintf(stderr, "usage: %s CALLS\n", argv[0]);
        return 2;
    }
    std::mt19937 random(kSeed);
    while (fuzz::callNum() < callNum)
    {
        const std::vector<uint8_t> input = randomInput(random);
        (void)LLVMFuzzerTestOneInput(input.data(), input.size());
    }
    return 0;
}
