// How a refused call leaves the inside: thrown here, caught in the one place that turns it into a Result.
#pragma once
#include <nrd/types.h>
#include <stdexcept>
#include <string>

namespace nrd
{
class Refusal : public std::runtime_error
{
public:
    Refusal(Result result, const std::string& text) : std::runtime_error(text), m_result(result) {}
    Result result() const { return m_result; }

private:
    Result m_result;
};

/// A sentence: printf-like, for messages only.
[[gnu::format(printf, 1, 2)]] std::string sentence(const char* format, ...);
} // namespace nrd
