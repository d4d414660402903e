// Counts, and on demand refuses, what this thread takes from operator new.
#pragma once
#include <cstddef>

namespace test
{
class AllocationWatch
{
public:
    /// `failAt`: the n-th allocation from now on throws std::bad_alloc, once; 0 = none.
    explicit AllocationWatch(size_t failAt = 0);
    ~AllocationWatch(); // ends the watch
    AllocationWatch(const AllocationWatch&) = delete;
    AllocationWatch& operator=(const AllocationWatch&) = delete;
    size_t count() const;
};
} // namespace test
