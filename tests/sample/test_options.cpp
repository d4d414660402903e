// The command line, as far as it needs no device.
#include "catch.h"
#include "options.h"

using namespace sample;

TEST_CASE("reference frames come as pairs or as a list", "[unit]")
{
    const ReferenceFrames pairs = parseReferenceFrames("every-8");
    std::vector<uint32_t> chosen;
    for (uint32_t i = 0; i < 26; ++i)
        if (pairs.contains(i)) chosen.push_back(i);
    CHECK(chosen == std::vector<uint32_t>{7, 8, 15, 16, 23, 24});
    const ReferenceFrames list = parseReferenceFrames("3,12");
    CHECK(list.contains(3));
    CHECK(list.contains(12));
    CHECK_FALSE(list.contains(4));
    for (const char* broken : {"", "a", "1,,2", "every-", "every-1", "-4", "1;2", "99999999999"})
    {
        INFO(broken);
        CHECK_THROWS_AS(parseReferenceFrames(broken), std::invalid_argument);
    }
}
