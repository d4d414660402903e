// Part of nrd_frontend.glsl: include that.
//
// Hair and grass: what their guides hold, and how far below a pixel they are.
#ifndef NRD_STRANDS_GLSL
#define NRD_STRANDS_GLSL

#define NRD_STRAND_THICKNESS 80e-6 // units, 80 um if units are metres

// 0 where a strand covers pixels, 1 where it is far below one. pixelSize: world size of a pixel at the strand's depth.
float NRD_GetStrandThicknessFactor(float pixelSize, float thickness)
{
    return clamp(0.5 * pixelSize / (max(thickness, 0.0) + 1e-6), 0.0, 1.0);
}

// Across the strand, for want of a direction to the neighbouring strands.
vec3 NRD_GetStrandBitangent(vec3 view, vec3 tangent)
{
    return NRD_NormalizeOrZero(cross(view, tangent));
}

// The guide's normal. bitangent: NRD_GetStrandBitangent(), or the mean direction to the neighbouring strands.
vec3 NRD_GetStrandNormal(vec3 tangent, vec3 bitangent)
{
    vec3 n = NRD_NormalizeOrZero(cross(tangent, bitangent));
    if (dot(n, n) > 0.0) return n;
    // A strand that points at the camera has no side of its own: any direction across it will do, NaN will not.
    vec3 axis = abs(tangent.z) < 0.7 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
    return NRD_NormalizeOrZero(cross(tangent, axis));
}

#endif
