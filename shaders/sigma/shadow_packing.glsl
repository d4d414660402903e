// Visibility and penumbra of a pixel, and the forms in which passes hand them on. Pure functions, without bindings.
// HAS_TRANSLUCENCY: 1 = visibility and colour, 0 = visibility alone.
#ifndef SHADOW_PACKING_GLSL
#define SHADOW_PACKING_GLSL

#if HAS_TRANSLUCENCY
#define Shadow vec4 // visibility, then the colour that comes through
float visibility(Shadow s) { return s.x; }
#else
#define Shadow float
float visibility(Shadow s) { return s; }
#endif

// Half-width of the penumbra a pixel's ray measured, in pixels at its own depth; two values are flags.
const float kUnlitRadius = 0.0;   // the surface faces away from the light
const float kLitRadius = 32768.0; // the ray crossed nothing, which says nothing of a width
const float kMinRadius = 1.0 / 16.0, kMaxRadius = 64.0;

struct ShadowSample
{
    Shadow shadow;
    float radius;
};

bool isUnlit(float radius) { return radius == kUnlitRadius; }
bool isLit(float radius) { return radius == kLitRadius; }

//----------------------------------------------------------------------------------------------------------------------
// Between the blurs: the radius as a logarithm in 8 bits, 2.7 % apart, visibility as a half float or as square roots in
// 8 bits each.

float encodeRadius(float radius)
{
    if (isUnlit(radius)) return 0.0;
    if (isLit(radius)) return 1.0;
    float octave = log2(clamp(radius, kMinRadius, kMaxRadius) / kMinRadius) / log2(kMaxRadius / kMinRadius);
    return (1.0 + octave * 253.0) / 255.0;
}

float decodeRadius(float stored)
{
    float code = floor(stored * 255.0 + 0.5);
    if (code == 0.0) return kUnlitRadius;
    if (code == 255.0) return kLitRadius;
    return kMinRadius * exp2((code - 1.0) / 253.0 * log2(kMaxRadius / kMinRadius));
}

#if HAS_TRANSLUCENCY
Shadow decodeShadow(vec4 stored) { return stored * stored; }
vec4 encodeShadow(Shadow s) { return sqrt(clamp(s, 0.0, 1.0)); }
#else
Shadow decodeShadow(vec4 stored) { return stored.x; }
vec4 encodeShadow(Shadow s) { return vec4(clamp(s, 0.0, 1.0)); }
#endif

// What the application gets: square roots, so that eight bits are spent where banding shows.
vec4 encodeOutput(Shadow s)
{
#if HAS_TRANSLUCENCY
    return sqrt(clamp(s, 0.0, 1.0));
#else
    return vec4(sqrt(clamp(s, 0.0, 1.0)));
#endif
}

#endif
