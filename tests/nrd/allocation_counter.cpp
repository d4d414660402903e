#include "allocation_counter.h"
#include <atomic>
#include <cstdlib>
#include <new>

namespace
{
std::atomic<size_t> g_allocationNum{0};

void* allocate(size_t byteSize, size_t alignment)
{
    g_allocationNum++;
    const size_t rounded = (byteSize + alignment - 1) / alignment * alignment;
    if (void* memory = std::aligned_alloc(alignment, rounded > 0 ? rounded : alignment)) return memory;
    throw std::bad_alloc();
}

void* allocateOrNull(size_t byteSize) noexcept
{
    try
    {
        return allocate(byteSize, alignof(std::max_align_t));
    }
    catch (const std::bad_alloc&)
    {
        return nullptr;
    }
}
} // namespace

size_t allocationNum() { return g_allocationNum; }

void* operator new(size_t byteSize) { return allocate(byteSize, alignof(std::max_align_t)); }
void* operator new[](size_t byteSize) { return allocate(byteSize, alignof(std::max_align_t)); }
void* operator new(size_t byteSize, std::align_val_t alignment) { return allocate(byteSize, size_t(alignment)); }
void* operator new[](size_t byteSize, std::align_val_t alignment) { return allocate(byteSize, size_t(alignment)); }
void* operator new(size_t byteSize, const std::nothrow_t&) noexcept { return allocateOrNull(byteSize); }
void* operator new[](size_t byteSize, const std::nothrow_t&) noexcept { return allocateOrNull(byteSize); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
