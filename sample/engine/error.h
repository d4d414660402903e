// What the engine throws: one sentence for the user.
#pragma once
#include <vulkan/vulkan.h>

#include <stdexcept>
#include <string>

namespace engine
{
/// A failure in one sentence that names the object or the call; main() prints it to stderr and exits with 1.
class Error : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

/// The name of a VkResult as in the specification, for example "VK_ERROR_DEVICE_LOST".
std::string toString(VkResult result);

/// A zeroed create-info struct with its type set.
template <class T> T describe(VkStructureType type)
{
    T info = {};
    info.sType = type;
    return info;
}

/// Throws Error{"cannot <action>: <result>"} unless `result` is a success code.
void check(VkResult result, const std::string& action);
} // namespace engine
