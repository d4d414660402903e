// Small pure functions: ramps and falloffs.
#ifndef MATH_GLSL
#define MATH_GLSL

const float kPi = 3.14159265358979;
const float kEps = 1e-6;

float saturate(float x) { return clamp(x, 0.0, 1.0); }

// 0 at a, 1 at b; a > b gives a falling ramp. A zero-width ramp is a step, not 0 / 0.
float ramp(float a, float b, float x)
{
    float width = b - a;
    return saturate((x - a) / (abs(width) < 1e-20 ? 1e-20 : width));
}

float smooth01(float x)
{
    float t = saturate(x);
    return t * t * (3.0 - 2.0 * t);
}

// Compact falloff for noise-free guides: 1 at 0, exactly 0 from 1 on. Of a square, so that distances need no root; the
// product of several takes one square, of the product of their roots.
float softRoot(float xx) { return saturate(1.0 - xx); }
float soft(float x)
{
    float root = softRoot(x * x);
    return root * root;
}

// Long-tailed falloff for noisy quantities, a rational stand-in for exp(-3x): never 0, so no tap set starves.
float heavy(float x) { return 1.0 / (1.0 + 3.0 * x + 9.0 * x * x); }

// Between unit vectors, by the chord: within 1 % up to 28 degrees. From a cosine it would be a difference of numbers
// near 1, which takes equal normals for 5e-4 radians apart, a sixth of what a mirror allows.
float angleBetween(vec3 a, vec3 b) { return distance(a, b); }
float squaredAngleBetween(vec3 a, vec3 b)
{
    vec3 turn = a - b;
    return dot(turn, turn);
}

float square(float x) { return x * x; }

// Of a tangent of at least 0, within 0.005 radians: atan() takes three times as long. Exact towards 0.
float angleOf(float tangent)
{
    float inner = tangent / (1.0 + 0.28 * tangent * tangent);
    float outer = 0.5 * kPi - tangent / (tangent * tangent + 0.28);
    return tangent <= 1.0 ? inner : outer;
}

// To the nearest half float. Some devices truncate on store; in a recurrent filter that is a steady loss of energy.
float roundToHalf(float x)
{
    float v = clamp(x, -65504.0, 65504.0);
    // Adding a number whose last bit counts what that of the half float does rounds: 1.5 times 2^13 times its power of
    // two, or, where the half float is subnormal and its steps are fixed, 1.5 times 1/2.
    float powerOfTwo = uintBitsToFloat(floatBitsToUint(v) & 0x7F800000u);
    float last = max(powerOfTwo * 12288.0, 0.75);
    precise float rounded = v + last;
    precise float result = rounded - last;
    return result;
}

vec4 roundToHalf(vec4 v) { return vec4(roundToHalf(v.x), roundToHalf(v.y), roundToHalf(v.z), roundToHalf(v.w)); }

#endif
