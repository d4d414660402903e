// The white-box way: shaders compiled at run time from the installed sources, as the library's build compiles them.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace example
{
class ShaderCompiler
{
public:
    /// `folder` is share/nrd/shaders of an installation: the sources, and nrd_shaders.json, the list of permutations.
    explicit ShaderCompiler(const std::string& folder) : ShaderCompiler(folder, folder + "/nrd_shaders.json") {}
    /// With the list elsewhere, as a build has it.
    ShaderCompiler(const std::string& folder, const std::string& manifestFile);
    ~ShaderCompiler();
    ShaderCompiler(const ShaderCompiler&) = delete;
    ShaderCompiler& operator=(const ShaderCompiler&) = delete;

    /// Optimised SPIR-V of a permutation, named as in nrd::PipelineDesc::shaderIdentifier. Throws what the compiler
    /// says.
    std::vector<uint32_t> compile(const std::string& permutation) const;
    std::vector<std::string> permutations() const;

private:
    struct Permutation
    {
        std::string file;
        std::vector<std::string> defines; // "NAME=VALUE"
    };
    std::string m_folder;
    std::vector<std::string> m_includes; // folders
    std::map<std::string, Permutation> m_permutations;
};
} // namespace example
