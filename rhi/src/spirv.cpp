#include "spirv.h"
#include <cstring>
#include <map>

namespace rhi
{
namespace
{
// Numbers of the SPIR-V specification, sections 2.3 and 3.
constexpr uint32_t kMagic = 0x07230203;
constexpr size_t kHeaderWords = 5;
constexpr uint32_t kOpEntryPoint = 15;
constexpr uint32_t kOpDecorate = 71;
constexpr uint32_t kGlCompute = 5;
constexpr uint32_t kDecorationBinding = 33;
constexpr uint32_t kDecorationDescriptorSet = 34;

bool isComputeMain(Span<const uint32_t> instruction)
{
    constexpr size_t kNameWord = 3;
    constexpr char kName[] = "main"; // with its terminator it fills more than one word
    return instruction.size() >= kNameWord + 2 && instruction[1] == kGlCompute &&
           std::memcmp(&instruction[kNameWord], kName, sizeof(kName)) == 0;
}

void readDecoration(Span<const uint32_t> instruction, std::map<uint32_t, SpirvBinding>& byId)
{
    if (instruction.size() < 4) return;
    if (instruction[2] == kDecorationBinding) byId[instruction[1]].binding = instruction[3];
    if (instruction[2] == kDecorationDescriptorSet) byId[instruction[1]].set = instruction[3];
}
} // namespace

SpirvInfo inspectSpirv(Span<const uint32_t> words)
{
    SpirvInfo info;
    if (words.size() < kHeaderWords || words[0] != kMagic) return {"the shader is not SPIR-V", {}};
    bool hasMain = false;
    std::map<uint32_t, SpirvBinding> byId;
    for (size_t at = kHeaderWords; at < words.size();)
    {
        const uint32_t length = words[at] >> 16;
        if (length == 0 || length > words.size() - at) return {"the shader is cut off", {}};
        const Span<const uint32_t> instruction(words.data() + at, length);
        const uint32_t opcode = words[at] & 0xffff;
        if (opcode == kOpEntryPoint) hasMain = hasMain || isComputeMain(instruction);
        if (opcode == kOpDecorate) readDecoration(instruction, byId);
        at += length;
    }
    if (!hasMain) return {"the shader has no compute entry point 'main'", {}};
    for (const auto& [id, binding] : byId) info.bindings.push_back(binding);
    return info;
}
} // namespace rhi
