// The little of a SPIR-V module the tests compare with the tables.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace test
{
enum class BindingKind
{
    UniformBuffer,
    Sampler,
    SampledImage,
    StorageImage
};

struct ShaderBinding
{
    uint32_t set = 0;
    uint32_t binding = 0;
    BindingKind kind = BindingKind::UniformBuffer;
    std::string name;
};

struct ShaderModule
{
    std::vector<ShaderBinding> bindings;
    std::map<std::string, std::map<std::string, uint32_t>> memberOffsets; // struct -> member -> byte offset
    uint32_t localSize[3] = {};
    std::vector<uint32_t> specializationIds;
};

ShaderModule parseSpirv(const uint32_t* words, size_t byteSize);
} // namespace test
