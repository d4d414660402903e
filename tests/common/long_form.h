// NRD_TEST_LONG in the environment asks for the long form of what has one.
#pragma once
#include <cstdlib>

namespace test
{
inline bool isLong()
{
    const char* value = std::getenv("NRD_TEST_LONG");
    return value && *value;
}
} // namespace test
