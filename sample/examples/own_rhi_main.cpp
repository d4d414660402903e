// An application's own RHI: own_rhi.cpp executes the descriptor library's dispatches with plain Vulkan.
#include "noisy_wall.h"
#include "run_own_rhi.h"
#include <cstdio>

int main(int argc, char** argv)
try
{
    if (argc != 2)
    {
        std::fprintf(stderr, "usage: %s PICTURE\n", argv[0]);
        return 2;
    }
    example::writePicture(argv[1], example::denoiseWall());
    std::printf("denoised %u frames\n", example::kFrameNum);
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
}
