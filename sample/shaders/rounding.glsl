// Storing a float to a half-float image truncates on some devices (llvmpipe), which darkens what is fed back.
#ifndef ROUNDING_GLSL
#define ROUNDING_GLSL

// The nearest value a half float can hold, ties to even; below its normal range the device's own rounding is left.
float roundToHalf(float x)
{
    uint b = floatBitsToUint(x);
    return uintBitsToFloat((b + 0xFFFu + ((b >> 13) & 1u)) & 0xFFFFE000u);
}

vec4 roundToHalf(vec4 v)
{
    return clamp(vec4(roundToHalf(v.x), roundToHalf(v.y), roundToHalf(v.z), roundToHalf(v.w)), -65504.0, 65504.0);
}
#endif
