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

/// Within a watch: what is taken or given back while it lives is nobody's.
class AllocationPause
{
public:
    AllocationPause();
    ~AllocationPause();
    AllocationPause(const AllocationPause&) = delete;
    AllocationPause& operator=(const AllocationPause&) = delete;

private:
    bool m_wasWatching;
};

/// What this thread has taken under all its watches so far and not given back under one.
ptrdiff_t liveAllocations();
} // namespace test
