// Constants of the tracing and composing shaders; read by C++ and GLSL. Only 16-byte types, so both lay it out alike.
#ifndef TRACE_CONSTANTS_H
#define TRACE_CONSTANTS_H
#ifdef __cplusplus
#include <glm/glm.hpp>
namespace sample
{
using glm::mat4;
using glm::uvec4;
using glm::vec4;
#endif

struct TraceConstants
{
    mat4 worldToView;
    mat4 viewToWorld;
    vec4 frustum; // .xy tangents of the half angles, .z radians per pixel, .w view z of the sky (negative)
    vec4 jitter;  // .xy pixels in [-0.5; 0.5], .z ray offset per unit of distance from the origin, .w least offset
    vec4 hitDistanceParameters; // A, B, C of the hit distance's normalisation, .w largest radiance of a sample
    vec4 limits; // .x least roughness of a surface seen by a bounce, as a share of the bounce's own; .y largest of a
                 // mirror
    uvec4 size;  // .xy pixels, .z nodes of one order of the hierarchy, .w lights
    uvec4 environment; // .xy texels, .z its index among the lights, .w largest number of bounces
    uvec4 sampling;    // .x seed, .y first index in the sequence, .z number of samples, .w 1: clear the sums first
    uvec4 shadow;      // .x the light whose shadow is a signal of its own
    uvec4 tiles;       // .xy number of tiles, of which one pixel has paths, .z pixels a side; .w as .z, of frames
};

#ifdef __cplusplus
} // namespace sample
#endif
#endif
