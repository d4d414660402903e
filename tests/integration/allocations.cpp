#include "allocations.h"
#include <cstdlib>
#include <new>
#include <utility>

namespace
{
thread_local bool isWatching = false;
thread_local size_t allocationCount = 0;
thread_local size_t failingAllocation = 0;
thread_local ptrdiff_t liveBlocks = 0;

void release(void* memory)
{
    if (isWatching && memory) liveBlocks--;
    std::free(memory);
}
} // namespace

// Replaces the program's own, in all forms but the aligned ones: those a sanitizer brings would not fit to these.
void* operator new(std::size_t size)
{
    if (isWatching && ++allocationCount == failingAllocation) throw std::bad_alloc();
    void* const memory = std::malloc(size ? size : 1);
    if (!memory) throw std::bad_alloc();
    if (isWatching) liveBlocks++;
    return memory;
}
void* operator new[](std::size_t size) { return operator new(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
    try
    {
        return operator new(size);
    }
    catch (const std::bad_alloc&)
    {
        return nullptr;
    }
}
void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept { return operator new(size, tag); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }

namespace test
{
AllocationWatch::AllocationWatch(size_t failAt)
{
    allocationCount = 0;
    failingAllocation = failAt;
    isWatching = true;
}
AllocationWatch::~AllocationWatch() { isWatching = false; }
size_t AllocationWatch::count() const { return allocationCount; }

AllocationPause::AllocationPause() : m_wasWatching(std::exchange(isWatching, false)) {}
AllocationPause::~AllocationPause() { isWatching = m_wasWatching; }

ptrdiff_t liveAllocations() { return liveBlocks; }
} // namespace test
