// A sentence in a fixed buffer: no allocation, no locale, cut off when full.
#pragma once
#include <charconv>
#include <cstddef>
#include <cstdint>

namespace nrd
{
template <size_t Capacity> class FixedText
{
public:
    const char* c_str() const { return m_text; }
    bool isEmpty() const { return m_size == 0; }
    void clear()
    {
        m_size = 0;
        m_text[0] = 0;
    }

    FixedText& operator<<(const char* text)
    {
        while (*text != 0 && m_size + 1 < Capacity) m_text[m_size++] = *text++;
        m_text[m_size] = 0;
        return *this;
    }
    FixedText& operator<<(uint32_t value) { return number(value); }
    FixedText& operator<<(float value) { return number(value); }
    FixedText& operator<<(double value) { return number(value); }

private:
    template <class T> FixedText& number(T value)
    {
        char digits[40] = {};
        const std::to_chars_result end = std::to_chars(digits, digits + sizeof(digits) - 1, value);
        if (end.ec == std::errc{}) *this << digits;
        return *this;
    }

    char m_text[Capacity] = {};
    size_t m_size = 0;
};

using Sentence = FixedText<256>;
} // namespace nrd
