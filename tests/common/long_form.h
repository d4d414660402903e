// How much a test does, by the environment: the short form; the middle one of every landing, with NRD_TEST_MIDDLE; or
// all, with NRD_TEST_LONG. Suites with a middle form have the label "middle", those that the short form leaves out have
// the label "landing".
#pragma once
#include <cstdlib>

namespace test
{
inline bool isSet(const char* variable)
{
    const char* value = std::getenv(variable);
    return value && *value;
}
inline bool isLong() { return isSet("NRD_TEST_LONG"); }
inline bool isMiddle() { return isSet("NRD_TEST_MIDDLE") || isLong(); } // at least
} // namespace test
