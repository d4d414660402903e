// White-box: compiles the installed shader sources itself, finds in them the library's own modules bit for bit, and
// denoises with them through OwnRhi.
#include "compile_shaders.h"
#include "noisy_wall.h"
#include "run_own_rhi.h"
#include <cstdio>
#include <stdexcept>

int main(int argc, char** argv)
try
{
    if (argc != 3)
    {
        std::fprintf(stderr, "usage: %s SHADER_FOLDER PICTURE\n", argv[0]);
        return 2;
    }
    const example::ShaderCompiler compiler(argv[1]);
    std::map<std::string, std::vector<uint32_t>> modules; // several pipelines specialise one
    const auto compile = [&](const nrd::PipelineDesc& pipeline)
    {
        std::vector<uint32_t>& words = modules[pipeline.shaderIdentifier];
        if (words.empty()) words = compiler.compile(pipeline.shaderIdentifier);
        if (words != example::embeddedShader(pipeline))
            throw std::runtime_error(std::string(pipeline.shaderIdentifier) + " differs from the library's module");
        return words;
    };
    example::writePicture(argv[2], example::denoiseWall(compile));
    std::printf("%zu of %zu permutations compiled, each is the library's own\n", modules.size(),
                compiler.permutations().size());
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
}
