// Collects the first broken rule of a struct. Every comparison is written so that NaN breaks it.
#pragma once
#include "validate.h"

namespace nrd
{
class Checker
{
public:
    explicit Checker(const char* structName) : m_structName(structName) {}

    const Error& error() const { return m_error; }
    bool isClean() const { return !m_error; }

    // "Struct::field is VALUE, expected EXPECTED"; the index only for elements of arrays, -1 = none.
    template <class T> void require(bool isFine, const char* field, T value, const char* expected, int index = -1)
    {
        if (isFine || m_error) return;
        begin(Result::INVALID_ARGUMENT, field, index);
        m_error.text << " is " << value << ", expected " << expected;
    }
    void unsupported(bool isAsked, const char* field, const char* reason)
    {
        if (!isAsked || m_error) return;
        begin(Result::UNSUPPORTED, field, -1);
        m_error.text << " " << reason;
    }
    void invalid(bool isBroken, const char* field, const char* reason)
    {
        if (!isBroken || m_error) return;
        begin(Result::INVALID_ARGUMENT, field, -1);
        m_error.text << " " << reason;
    }

    void inside(const char* field, float value, float low, float high, int index = -1)
    {
        if ((value >= low && value <= high) || m_error) return;
        begin(Result::INVALID_ARGUMENT, field, index);
        m_error.text << " is " << value << ", expected [" << low << "; " << high << "]";
    }
    void aboveUpTo(const char* field, float value, float low, float high)
    {
        if ((value > low && value <= high) || m_error) return;
        begin(Result::INVALID_ARGUMENT, field, -1);
        m_error.text << " is " << value << ", expected (" << low << "; " << high << "]";
    }
    void inside(const char* field, uint32_t value, uint32_t low, uint32_t high, int index = -1)
    {
        if ((value >= low && value <= high) || m_error) return;
        begin(Result::INVALID_ARGUMENT, field, index);
        m_error.text << " is " << value << ", expected [" << low << "; " << high << "]";
    }
    template <class Enum> void enumerator(const char* field, Enum value)
    {
        require(value < Enum::MAX_NUM, field, static_cast<uint32_t>(value), "an enumerator");
    }

private:
    void begin(Result result, const char* field, int index)
    {
        m_error.result = result;
        m_error.text << m_structName << "::" << field;
        if (index >= 0) m_error.text << "[" << static_cast<uint32_t>(index) << "]";
    }

    const char* m_structName;
    Error m_error;
};
} // namespace nrd
