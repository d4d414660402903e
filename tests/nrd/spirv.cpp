#include "spirv.h"
#include "catch.h"

namespace test
{
namespace
{
// Numbers of the SPIR-V specification, 1.3.
enum Op : uint32_t
{
    OpName = 5,
    OpMemberName = 6,
    OpExecutionMode = 16,
    OpTypeImage = 25,
    OpTypeSampler = 26,
    OpTypePointer = 32,
    OpVariable = 59,
    OpDecorate = 71,
    OpMemberDecorate = 72
};
constexpr uint32_t kLocalSize = 17, kSpecId = 1, kBinding = 33, kDescriptorSet = 34, kOffset = 35;
constexpr uint32_t kStorageClassUniformConstant = 0, kStorageClassUniform = 2;

std::string readString(const uint32_t* words, uint32_t num)
{
    std::string text;
    for (uint32_t i = 0; i < num; i++)
    {
        for (uint32_t shift = 0; shift < 32; shift += 8)
        {
            const char c = static_cast<char>((words[i] >> shift) & 0xFFu);
            if (c == 0) return text;
            text += c;
        }
    }
    return text;
}

struct Reader
{
    std::map<uint32_t, std::string> names;
    std::map<uint32_t, std::map<uint32_t, std::string>> memberNames;
    std::map<uint32_t, std::map<uint32_t, uint32_t>> memberOffsets;
    std::map<uint32_t, uint32_t> sets, bindings, pointees, imageSampled;
    std::map<uint32_t, bool> samplers;
    std::vector<std::pair<uint32_t, uint32_t>> variables; // type, id
    ShaderModule module;

    void decorate(const uint32_t* w)
    {
        if (w[2] == kDescriptorSet) sets[w[1]] = w[3];
        if (w[2] == kBinding) bindings[w[1]] = w[3];
        if (w[2] == kSpecId) module.specializationIds.push_back(w[3]);
    }

    void read(uint32_t op, const uint32_t* w, uint32_t num)
    {
        switch (op)
        {
        case OpName:
            names[w[1]] = readString(w + 2, num - 2);
            break;
        case OpMemberName:
            memberNames[w[1]][w[2]] = readString(w + 3, num - 3);
            break;
        case OpExecutionMode:
            if (w[2] == kLocalSize) std::copy(w + 3, w + 6, module.localSize);
            break;
        case OpTypeImage:
            imageSampled[w[1]] = w[7];
            break;
        case OpTypeSampler:
            samplers[w[1]] = true;
            break;
        case OpTypePointer:
            pointees[w[1]] = w[3];
            break;
        case OpVariable:
            if (w[3] == kStorageClassUniformConstant || w[3] == kStorageClassUniform) variables.push_back({w[1], w[2]});
            break;
        case OpDecorate:
            decorate(w);
            break;
        case OpMemberDecorate:
            if (w[3] == kOffset) memberOffsets[w[1]][w[2]] = w[4];
            break;
        default:
            break;
        }
    }

    BindingKind kindOf(uint32_t pointer)
    {
        const uint32_t type = pointees[pointer];
        if (samplers.count(type)) return BindingKind::Sampler;
        if (!imageSampled.count(type)) return BindingKind::UniformBuffer;
        return imageSampled[type] == 1 ? BindingKind::SampledImage : BindingKind::StorageImage;
    }

    void finish()
    {
        for (const auto& [type, id] : variables)
        {
            if (bindings.count(id)) module.bindings.push_back({sets[id], bindings[id], kindOf(type), names[id]});
        }
        for (const auto& [id, members] : memberOffsets)
        {
            for (const auto& [index, offset] : members)
                module.memberOffsets[names[id]][memberNames[id][index]] = offset;
        }
    }
};
} // namespace

ShaderModule parseSpirv(const uint32_t* words, size_t byteSize)
{
    constexpr uint32_t kMagic = 0x07230203;
    const size_t num = byteSize / 4;
    REQUIRE(num > 5);
    REQUIRE(words[0] == kMagic);
    Reader reader;
    for (size_t i = 5; i < num;)
    {
        const uint32_t length = words[i] >> 16;
        REQUIRE(length > 0);
        REQUIRE(i + length <= num);
        reader.read(words[i] & 0xFFFFu, words + i, length);
        i += length;
    }
    reader.finish();
    return reader.module;
}
} // namespace test
