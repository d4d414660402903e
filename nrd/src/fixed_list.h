// A list with room for Capacity elements inside itself: tables and programs are built without allocation.
#pragma once
#include <cstddef>
#include <initializer_list>

namespace nrd
{
template <class T, size_t Capacity> class FixedList
{
public:
    constexpr FixedList() = default;
    constexpr FixedList(std::initializer_list<T> items)
    {
        for (const T& item : items) push(item);
    }

    // In a constant expression an overflow does not compile.
    constexpr void push(const T& item) { m_items[m_size++] = item; }
    constexpr void clear() { m_size = 0; }

    constexpr size_t size() const { return m_size; }
    static constexpr size_t capacity() { return Capacity; }
    constexpr T& operator[](size_t i) { return m_items[i]; }
    constexpr const T& operator[](size_t i) const { return m_items[i]; }
    constexpr T* begin() { return m_items; }
    constexpr T* end() { return m_items + m_size; }
    constexpr const T* begin() const { return m_items; }
    constexpr const T* end() const { return m_items + m_size; }

private:
    T m_items[Capacity] = {};
    size_t m_size = 0;
};
} // namespace nrd
