// All memory of an instance comes from here: the caller's callbacks, or the default heap.
#pragma once
#include <memory_resource>
#include <new>
#include <nrd/descs.h>

namespace nrd
{
class CallbackMemory final : public std::pmr::memory_resource
{
public:
    explicit CallbackMemory(const AllocationCallbacks& callbacks) : m_callbacks(callbacks) {}

private:
    void* do_allocate(size_t byteSize, size_t alignment) override
    {
        if (!m_callbacks.allocate) return std::pmr::new_delete_resource()->allocate(byteSize, alignment);
        void* memory = m_callbacks.allocate(m_callbacks.userArg, byteSize, alignment);
        if (!memory) throw std::bad_alloc();
        return memory;
    }
    void do_deallocate(void* memory, size_t byteSize, size_t alignment) override
    {
        if (m_callbacks.allocate)
            m_callbacks.free(m_callbacks.userArg, memory);
        else
            std::pmr::new_delete_resource()->deallocate(memory, byteSize, alignment);
    }
    bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

    AllocationCallbacks m_callbacks;
};
} // namespace nrd
