// Which pixels have a sample of a lobe when each lobe is traced in every second pixel, and where it is packed.
#ifndef CHECKERBOARD_GLSL
#define CHECKERBOARD_GLSL

// `mode` is nrd::CheckerboardMode: 0 off, 1 black, 2 white. It names diffuse's pixels; specular has the others.
bool hasCheckerboardSample(ivec2 pixel, uint frameIndex, uint mode, bool isDiffuse)
{
    bool isOdd = ((uint(pixel.x ^ pixel.y) ^ frameIndex) & 1u) != 0u;
    return mode == 0u || isOdd == (isDiffuse == (mode == 2u));
}

// Samples lie side by side in the left half of the image.
ivec2 packedPixel(ivec2 pixel, uint mode)
{
    return mode == 0u ? pixel : ivec2(pixel.x >> 1, pixel.y);
}
#endif
