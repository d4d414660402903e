// What can fail without being a bug of the caller throws rhi::Error; nothing else leaves the RHI.
#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>

namespace rhi
{
enum class ErrorCode : uint32_t
{
    Failure,         // anything without a code of its own
    InvalidArgument, // a description that cannot be carried out on any device
    Unsupported,     // this device lacks a format, a feature or a limit
    OutOfHostMemory,
    OutOfDeviceMemory,
    PoolExhausted, // a descriptor pool has no room; the pool stays usable
    InvalidShader, // not SPIR-V, or the entry point is missing
    DeviceLost,
};

const char* toString(ErrorCode code);

/// The one exception type. what() is one sentence that names the object.
class Error : public std::runtime_error
{
public:
    Error(ErrorCode code, const std::string& text, int32_t nativeCode = 0)
        : std::runtime_error(text), m_code(code), m_nativeCode(nativeCode)
    {
    }
    ErrorCode code() const { return m_code; }
    int32_t nativeCode() const { return m_nativeCode; } // VkResult of the call that failed, 0 if there was none

private:
    ErrorCode m_code;
    int32_t m_nativeCode;
};
} // namespace rhi
