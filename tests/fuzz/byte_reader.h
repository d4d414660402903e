// Values drawn from the bytes of a fuzzed input; zeros once they are used up.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace fuzz
{
class ByteReader
{
public:
    ByteReader(const uint8_t* bytes, size_t size) : m_bytes(bytes), m_size(size) {}

    bool isEmpty() const { return m_size == 0; }

    // Arbitrary bits, enumerators that don't exist included; not for bool, which has only two values.
    template <class T> T value()
    {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);
        T result = {};
        const size_t size = std::min(sizeof(T), m_size);
        if (size != 0) std::memcpy(&result, m_bytes, size);
        m_bytes += size;
        m_size -= size;
        return result;
    }
    uint32_t below(uint32_t limit) { return value<uint16_t>() % limit; }
    bool flag() { return (value<uint8_t>() & 1) != 0; }

private:
    const uint8_t* m_bytes;
    size_t m_size;
};
} // namespace fuzz
