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
constexpr uint32_t kOpTypeStruct = 30;
constexpr uint32_t kOpTypePointer = 32;
constexpr uint32_t kOpFunctionEnd = 56;
constexpr uint32_t kOpVariable = 59;
constexpr uint32_t kOpDecorate = 71;
constexpr uint32_t kOpMemberDecorate = 72;
constexpr uint32_t kGlCompute = 5;
constexpr uint32_t kDecorationNonWritable = 24;
constexpr uint32_t kDecorationBinding = 33;
constexpr uint32_t kDecorationDescriptorSet = 34;

bool isComputeMain(Span<const uint32_t> instruction)
{
    constexpr size_t kNameWord = 3;
    constexpr char kName[] = "main"; // with its terminator it fills more than one word
    return instruction.size() >= kNameWord + 2 && instruction[1] == kGlCompute &&
           std::memcmp(&instruction[kNameWord], kName, sizeof(kName)) == 0;
}

/// Declarations by their result identifiers.
struct Declarations
{
    std::map<uint32_t, SpirvBinding> bindings;
    std::map<uint32_t, uint32_t> readOnlyMembers; // of a struct: how many are readonly
    std::map<uint32_t, uint32_t> members;         // of a struct
    std::map<uint32_t, uint32_t> pointees;        // of a pointer type
    std::map<uint32_t, uint32_t> variables;       // to their pointer types

    void read(uint32_t opcode, Span<const uint32_t> instruction);
    bool isReadOnlyBlock(uint32_t variable) const;
};

void Declarations::read(uint32_t opcode, Span<const uint32_t> instruction)
{
    const size_t length = instruction.size();
    if (opcode == kOpDecorate && length >= 4 && instruction[2] == kDecorationBinding)
        bindings[instruction[1]].binding = instruction[3];
    if (opcode == kOpDecorate && length >= 4 && instruction[2] == kDecorationDescriptorSet)
        bindings[instruction[1]].set = instruction[3];
    if (opcode == kOpDecorate && length >= 3 && instruction[2] == kDecorationNonWritable)
        if (const auto it = bindings.find(instruction[1]); it != bindings.end()) it->second.isReadOnly = true;
    if (opcode == kOpMemberDecorate && length >= 4 && instruction[3] == kDecorationNonWritable)
        readOnlyMembers[instruction[1]]++;
    if (opcode == kOpTypeStruct && length >= 2) members[instruction[1]] = static_cast<uint32_t>(length - 2);
    if (opcode == kOpTypePointer && length >= 4) pointees[instruction[1]] = instruction[3];
    if (opcode == kOpVariable && length >= 4) variables[instruction[2]] = instruction[1];
}

bool Declarations::isReadOnlyBlock(uint32_t variable) const
{
    const auto pointer = variables.find(variable);
    if (pointer == variables.end()) return false;
    const auto type = pointees.find(pointer->second);
    if (type == pointees.end()) return false;
    const auto readOnly = readOnlyMembers.find(type->second);
    const auto all = members.find(type->second);
    return readOnly != readOnlyMembers.end() && all != members.end() && readOnly->second == all->second;
}
} // namespace

SpirvInfo inspectSpirv(Span<const uint32_t> words)
{
    SpirvInfo info;
    if (words.size() < kHeaderWords || words[0] != kMagic) return {"the shader is not SPIR-V", {}};
    bool hasMain = false;
    uint32_t lastOpcode = 0;
    Declarations declarations;
    for (size_t at = kHeaderWords; at < words.size();)
    {
        const uint32_t length = words[at] >> 16;
        if (length == 0 || length > words.size() - at) return {"the shader is cut off", {}};
        const Span<const uint32_t> instruction(words.data() + at, length);
        const uint32_t opcode = words[at] & 0xffff;
        if (opcode == kOpEntryPoint) hasMain = hasMain || isComputeMain(instruction);
        declarations.read(opcode, instruction);
        lastOpcode = opcode;
        at += length;
    }
    if (!hasMain) return {"the shader has no compute entry point 'main'", {}};
    if (lastOpcode != kOpFunctionEnd) return {"the shader is cut off", {}}; // between two instructions
    for (const auto& [id, binding] : declarations.bindings)
    {
        info.bindings.push_back(binding);
        if (declarations.isReadOnlyBlock(id)) info.bindings.back().isReadOnly = true;
    }
    return info;
}
} // namespace rhi
