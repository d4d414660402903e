// One hash for stochastic decisions.
#ifndef RANDOM_GLSL
#define RANDOM_GLSL

// PCG output function: Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
uint hashPcg(uint x)
{
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

uint seedPixel(ivec2 pixel, uint frame) { return hashPcg(uint(pixel.x) + hashPcg(uint(pixel.y) + hashPcg(frame))); }

float nextRandom(inout uint seed) // [0; 1)
{
    seed = hashPcg(seed);
    return float(seed >> 8) * (1.0 / 16777216.0);
}

#endif
