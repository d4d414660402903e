#include "compile_shaders.h"
#include <fstream>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <spirv-tools/optimizer.hpp>
#include <stdexcept>

namespace example
{
namespace
{
std::string read(const std::string& path)
{
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path);
    return {std::istreambuf_iterator<char>(file), {}};
}

class Includer final : public glslang::TShader::Includer
{
public:
    explicit Includer(const std::vector<std::string>& folders) : m_folders(folders) {}
    // Beside the file that includes, or in one of the folders.
    IncludeResult* includeLocal(const char* name, const char* from, size_t) override
    {
        const std::string path = from;
        if (IncludeResult* beside = find(path.substr(0, path.find_last_of('/') + 1) + name)) return beside;
        for (const std::string& folder : m_folders)
            if (IncludeResult* result = find(folder + "/" + name)) return result;
        return nullptr;
    }
    void releaseInclude(IncludeResult* result) override
    {
        if (!result) return;
        const std::unique_ptr<std::string> text(static_cast<std::string*>(result->userData));
        delete result;
    }

private:
    static IncludeResult* find(const std::string& path)
    {
        if (!std::ifstream(path)) return nullptr;
        auto text = std::make_unique<std::string>(read(path));
        const auto result = new IncludeResult(path, text->data(), text->size(), text.get());
        text.release(); // goes with the result
        return result;
    }
    const std::vector<std::string>& m_folders;
};

std::string preambleOf(const std::vector<std::string>& defines)
{
    std::string result;
    for (const std::string& define : defines)
    {
        const size_t sign = define.find('=');
        result += "#define " + define.substr(0, sign) + " " + define.substr(sign + 1) + "\n";
    }
    return result;
}

std::vector<uint32_t> optimise(const std::vector<unsigned int>& words)
{
    spvtools::Optimizer optimizer(SPV_ENV_UNIVERSAL_1_6);
    optimizer.RegisterPerformancePasses();
    std::vector<uint32_t> result;
    if (!optimizer.Run(words.data(), words.size(), &result)) throw std::runtime_error("spirv-opt failed");
    return result;
}
} // namespace

ShaderCompiler::ShaderCompiler(const std::string& folder, const std::string& manifestFile) : m_folder(folder)
{
    const nlohmann::json manifest = nlohmann::json::parse(read(manifestFile));
    if (manifest.at("targetEnvironment") != "vulkan1.1" || manifest.at("optimizer") != "performance")
        throw std::runtime_error("nrd_shaders.json asks for what this compiler does not do");
    for (const std::string include : manifest.at("includes")) m_includes.push_back(folder + "/" + include);
    for (const nlohmann::json& shader : manifest.at("shaders"))
        m_permutations[shader.at("name")] = {shader.at("file"), shader.at("defines")};
    glslang::InitializeProcess();
}

ShaderCompiler::~ShaderCompiler() { glslang::FinalizeProcess(); }

std::vector<std::string> ShaderCompiler::permutations() const
{
    std::vector<std::string> result;
    for (const auto& [name, permutation] : m_permutations) result.push_back(name);
    return result;
}

std::vector<uint32_t> ShaderCompiler::compile(const std::string& permutation) const
{
    const Permutation& source = m_permutations.at(permutation);
    const std::string path = m_folder + "/" + source.file, text = read(path), preamble = preambleOf(source.defines);
    const char* const string = text.c_str();
    const char* const name = path.c_str();

    glslang::TShader shader(EShLangCompute);
    shader.setStringsWithLengthsAndNames(&string, nullptr, &name, 1);
    shader.setPreamble(preamble.c_str());
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    Includer includer(m_includes);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    if (!shader.parse(GetDefaultResources(), 460, false, messages, includer))
        throw std::runtime_error(permutation + ": " + shader.getInfoLog());
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages) || !program.mapIO())
        throw std::runtime_error(permutation + ": " + program.getInfoLog());
    std::vector<unsigned int> words;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), words);
    return optimise(words);
}
} // namespace example
