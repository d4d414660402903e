// What the shaders of nrd-bench are told; read by C++ and GLSL. Only 16-byte types, so both lay it out alike.
#ifndef BENCH_CONSTANTS_H
#define BENCH_CONSTANTS_H
#ifdef __cplusplus
#include <array>
#include <cstdint>
namespace sample::bench
{
using vec4 = std::array<float, 4>;
using uvec4 = std::array<uint32_t, 4>;
#endif

// What one dispatch writes into its image; from BENCH_RADIANCE on they are of one lobe.
#define BENCH_MOTION 0
#define BENCH_NORMAL_ROUGHNESS 1
#define BENCH_VIEWZ 2
#define BENCH_SIGNAL 3    // radiance as it is
#define BENCH_RADIANCE 4  // radiance and normalised hit distance; also the first of an SH pair
#define BENCH_HITDIST 5   // normalised hit distance
#define BENCH_DIRECTION 6 // direction of the ray times normalised hit distance, and that
#define BENCH_SH1 7       // direction of the ray times luma
#define BENCH_RELAX 8     // linear radiance and hit distance in metres; also the first of an SH pair
#define BENCH_PENUMBRA 9  // of the sun, and below what comes through on the way to it: metals stand in for tinted glass
#define BENCH_TRANSLUCENCY 10

#define BENCH_SUN_X 0.39f // towards the sun
#define BENCH_SUN_Y 0.78f
#define BENCH_SUN_Z (-0.49f)

struct BenchConstants
{
    vec4 camera;                // .xyz world position, .w yaw in radians, 0 looks along +Z
    vec4 view;                  // .xy tangents of the half angles, .zw jitter in pixels
    vec4 sky;                   // .x share of the picture [0; 0.25], .y its view depth
    vec4 hitDistanceParameters; // .xyz A, B, C
    uvec4 frame;                // .xy pixels, .z seed
    uvec4 target;               // .x BENCH_..., .y 1: the specular lobe, .z pixels from one texel to the next
};

#ifdef __cplusplus
} // namespace sample::bench
#endif
#endif
