// A vector no longer than one in ten bits a component; 512 is zero.
#ifndef AXIS_GLSL
#define AXIS_GLSL

// Of a step. Far more than a read of a texel or a mean of equal texels is off, far less than shows.
const float kTrifle = 0.0125;

// What was rounded up may be longer than one by less than two steps; to shorten it would be to round it once more.
const float kLongest = 1.0 + 2.0 / 511.0;

// Rounded at random: in a running mean, rounding to the nearest would swallow small steps for good. What is whole but
// for a trifle stays whole, or a constant read a trifle too low would lose a step wherever the dither is near zero.
vec3 roundAtRandom(vec3 x, vec3 dither)
{
    vec3 whole = floor(x + 0.5);
    return mix(floor(x + dither), whole, lessThan(abs(x - whole), vec3(kTrifle)));
}

vec3 encodeAxis(vec3 axis, vec3 dither)
{
    axis *= min(1.0, kLongest * inversesqrt(max(dot(axis, axis), 1e-20)));
    return clamp(roundAtRandom(axis * 511.0 + 512.0, dither), 0.0, 1023.0) * (1.0 / 1023.0);
}

vec3 decodeAxis(vec3 stored) { return (stored * 1023.0 - 512.0) * (1.0 / 511.0); }

#endif
