// Counts every call of the global operator new of this program.
#pragma once
#include <cstddef>

size_t allocationNum();
