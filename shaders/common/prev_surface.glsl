// What a frame keeps of its surfaces for the next one: the depth's code, and the guide. Diffuse light asks hardly more
// of a normal than its side, so where there is no other, two bytes of an octahedron do; their last bits are the material.
#ifndef PREV_SURFACE_GLSL
#define PREV_SURFACE_GLSL
#include "denoiser.glsl"
#include "depth_code.glsl"

// What is no number is sky. Inside the denoising range.
float depthCode(float storedViewZ) { return NRD_IsFinite(storedViewZ) ? encodeDepth(decodeViewZ(storedViewZ)) : 0.0; }

vec4 packSide(Guide guide)
{
    vec3 n = guide.N / max(abs(guide.N.x) + abs(guide.N.y) + abs(guide.N.z), 1e-15); // guards a zero normal
    vec2 folded = (1.0 - abs(n.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(n.xy, vec2(0.0)));
    uvec2 bytes = uvec2((n.z < 0.0 ? folded : n.xy) * 127.5 + 128.0);
    if (kHasMaterialTest) bytes = (bytes & ~1u) | (uvec2(guide.materialID, guide.materialID >> 1) & 1u);
    return vec4(min(vec2(bytes) / 255.0, vec2(1.0)), 0.0, 0.0);
}

// Without a roughness.
Guide unpackSide(vec2 stored)
{
    vec3 n;
    n.xy = 2.0 * stored - 1.0;
    n.z = 1.0 - abs(n.x) - abs(n.y);
    float fold = max(-n.z, 0.0);
    n.xy -= mix(vec2(-fold), vec2(fold), greaterThanEqual(n.xy, vec2(0.0)));
    uint material = 0u;
    if (kHasMaterialTest)
    {
        uvec2 bytes = uvec2(stored * 255.0 + 0.5) & 1u;
        material = bytes.x | (bytes.y << 1);
    }
    return Guide(normalize(n), 1.0, material);
}

Guide decodePrevGuide(vec4 stored)
{
#if HAS_SPECULAR
    return decodeGuide(stored);
#else
    return unpackSide(stored.xy);
#endif
}

#endif
