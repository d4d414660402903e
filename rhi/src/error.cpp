#include <rhi/error.h>

namespace rhi
{
const char* toString(ErrorCode code)
{
    switch (code)
    {
    case ErrorCode::Failure:
        return "failure";
    case ErrorCode::InvalidArgument:
        return "invalid argument";
    case ErrorCode::Unsupported:
        return "unsupported";
    case ErrorCode::OutOfHostMemory:
        return "out of host memory";
    case ErrorCode::OutOfDeviceMemory:
        return "out of device memory";
    case ErrorCode::PoolExhausted:
        return "pool exhausted";
    case ErrorCode::InvalidShader:
        return "invalid shader";
    case ErrorCode::DeviceLost:
        return "device lost";
    }
    return "unknown error";
}
} // namespace rhi
