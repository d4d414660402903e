// Random numbers: Owen-scrambled Sobol points in pairs of dimensions (Burley 2020), a different scramble per pixel and
// pair, so that consecutive frames (or samples) of a pixel fill every pair of dimensions evenly.
#ifndef SAMPLING_GLSL
#define SAMPLING_GLSL
#include "scene_data.glsl"

uint hash(uint x)
{
    x ^= x >> 16;
    x *= 0x7FEB352Du;
    x ^= x >> 15;
    x *= 0x846CA68Bu;
    return x ^ (x >> 16);
}

// Laine and Karras' permutation: an Owen scramble of the bits from the lowest up.
uint permute(uint x, uint seed)
{
    x += seed;
    x ^= x * 0x6C50B47Cu;
    x ^= x * 0xB82F1E52u;
    x ^= x * 0xC7AFE638u;
    return x ^ (x * 0x8D22F6E6u);
}

// Second dimension of Sobol's sequence with its bits reversed: Pascal's triangle modulo 2 times the index.
uint sobolReversed(uint i)
{
    i ^= (i & 0xAAAAAAAAu) >> 1;
    i ^= (i & 0xCCCCCCCCu) >> 2;
    i ^= (i & 0xF0F0F0F0u) >> 4;
    i ^= (i & 0xFF00FF00u) >> 8;
    return i ^ ((i & 0xFFFF0000u) >> 16);
}

float toUnit(uint x)
{
    return float(x >> 8) * (1.0 / 16777216.0);
}

// Point `index` of the sequence `seed` in [0; 1)^2.
vec2 sampleSquare(uint seed, uint index)
{
    uint shuffled = bitfieldReverse(permute(bitfieldReverse(index), hash(seed)));
    // Both dimensions with reversed bits, which is what permute() wants.
    uint x = bitfieldReverse(permute(shuffled, hash(seed ^ 0xA511E9B3u)));
    uint y = bitfieldReverse(permute(sobolReversed(shuffled), hash(seed ^ 0x63D83595u)));
    return vec2(toUnit(x), toUnit(y));
}

vec3 sampleCosine(vec2 u, vec3 n)
{
    vec3 t, b;
    makeFrame(n, t, b);
    float r = sqrt(u.x), phi = 2.0 * kPi * u.y;
    return normalize(t * (r * cos(phi)) + b * (r * sin(phi)) + n * sqrt(max(1.0 - u.x, 0.0)));
}
#endif
