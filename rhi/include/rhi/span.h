// Two helpers that C++17 lacks: a view of contiguous elements, and bit operators for scoped enumerations.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <type_traits>
#include <utility>

namespace rhi
{
/// Borrows elements; as a parameter it may be built from a braced list, as a variable it may not outlive its source.
template <class T> class Span
{
public:
    constexpr Span() = default;
    constexpr Span(T* data, size_t size) : m_data(data), m_size(size) {}
    template <size_t N> constexpr Span(T (&array)[N]) : m_data(array), m_size(N) {}
    template <class U = T, class = std::enable_if_t<std::is_const_v<U>>>
    constexpr Span(std::initializer_list<std::remove_const_t<T>> list) : Span(std::data(list), list.size())
    {
    }
    template <class C, class = std::enable_if_t<std::is_convertible_v<decltype(std::data(std::declval<C&>())), T*>>>
    constexpr Span(C&& container) : Span(std::data(container), std::size(container))
    {
    }

    constexpr T* data() const { return m_data; }
    constexpr size_t size() const { return m_size; }
    constexpr bool empty() const { return m_size == 0; }
    constexpr T* begin() const { return m_data; }
    constexpr T* end() const { return m_data + m_size; }
    constexpr T& operator[](size_t i) const { return m_data[i]; }

private:
    T* m_data = nullptr;
    size_t m_size = 0;
};

/// Specialise to true for an enumeration whose values are combined with | and &.
template <class E> struct IsFlags : std::false_type
{
};
template <class E, class = std::enable_if_t<IsFlags<E>::value>> constexpr E operator|(E a, E b)
{
    return static_cast<E>(static_cast<std::underlying_type_t<E>>(a) | static_cast<std::underlying_type_t<E>>(b));
}
template <class E, class = std::enable_if_t<IsFlags<E>::value>> constexpr E operator&(E a, E b)
{
    return static_cast<E>(static_cast<std::underlying_type_t<E>>(a) & static_cast<std::underlying_type_t<E>>(b));
}
template <class E, class = std::enable_if_t<IsFlags<E>::value>> constexpr E& operator|=(E& a, E b) { return a = a | b; }
/// True if every bit of `bits` is set in `value`; true for no bits.
template <class E, class = std::enable_if_t<IsFlags<E>::value>> constexpr bool hasAll(E value, E bits)
{
    return (value & bits) == bits;
}
template <class E, class = std::enable_if_t<IsFlags<E>::value>> constexpr bool hasAny(E value, E bits)
{
    return static_cast<std::underlying_type_t<E>>(value & bits) != 0;
}
} // namespace rhi
