// Checkerboarded input: each lobe has data on half of the pixels, packed into the left half of its texture. Diffuse has
// it where BLACK or WHITE says, specular on the others, and both change places with every frame.
#ifndef CHECKERBOARD_GLSL
#define CHECKERBOARD_GLSL
#include "denoiser.glsl"

#define CHECKERBOARD_OFF 0u
#define CHECKERBOARD_BLACK 1u

bool hasData(ivec2 pixel, bool isSpecular)
{
    if (g.checkerboard == CHECKERBOARD_OFF) return true;
    bool isBlack = ((uint(pixel.x ^ pixel.y) ^ g.frameIndex) & 1u) == 0u;
    return isBlack == ((g.checkerboard == CHECKERBOARD_BLACK) != isSpecular);
}

ivec2 inputTexel(ivec2 pixel) { return ivec2(g.checkerboard == CHECKERBOARD_OFF ? pixel.x : pixel.x >> 1, pixel.y); }

#endif
