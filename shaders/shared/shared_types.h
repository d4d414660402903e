// Types with equal layout in C++ and in a std140 block.
#ifndef SHARED_TYPES_H
#define SHARED_TYPES_H

#ifdef __cplusplus
#include <cstdint>
#define SHARED_BEGIN namespace nrd::shared {
#define SHARED_END }
namespace nrd::shared
{
using uint = uint32_t;
struct alignas(8) vec2 { float x, y; };
struct alignas(8) ivec2 { int32_t x, y; };
struct alignas(16) vec4 { float x, y, z, w; };
struct alignas(16) mat4 { float columns[16]; }; // column-major
} // namespace nrd::shared
#else
#define SHARED_BEGIN
#define SHARED_END
#endif

#endif
