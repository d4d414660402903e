// The light whose shadow on the primary surface is a signal of its own: what it gives without the shadow, and one ray
// to a random point of it.
#ifndef SHADOW_LIGHT_GLSL
#define SHADOW_LIGHT_GLSL
#include "lights.glsl"

struct Shadow
{
    vec3 transmittance; // 1: nothing in the way, 0: something opaque
    float distance;     // world units, as the capture format has it
};

const uint kShadowPair = 0x3C6EF372u;      // a pair of dimensions of its own
const float kLeastShadowDistance = 1e-4; // 0 is what faces away from the light

LightSample sampleShadowLight(Surface s, vec2 u)
{
    int light = int(g.shadow.x);
    return samplePunctual(s, light, texelFetch(gLights, kLightWords * light).x, u);
}

// By the middle of the light, 0 where it can't be seen; .w: the distance to it, 0: infinite.
vec4 unshadowedRadiance(Surface s, Bsdf bsdf)
{
    LightSample light = sampleShadowLight(s, vec2(0.0));
    vec3 reflected = evaluate(s, bsdf, light.direction, kDiffuseLobe | kSpecularLobe).value;
    return vec4(reflected * light.radiance, light.distance == kNever ? 0.0 : light.distance);
}

// `unshadowed`: where it is 0, no ray tells anything.
Shadow traceShadow(Surface s, vec3 unshadowed, vec2 u)
{
    if (brightest(unshadowed) <= 0.0) return Shadow(vec3(0.0), 0.0);
    LightSample light = sampleShadowLight(s, u);
    // At the terminator a part of the light is below the horizon.
    if (dot(s.geometricNormal, light.direction) <= 0.0) return Shadow(vec3(0.0), kLeastShadowDistance);
    Passage passage = tracePassage(offsetOrigin(s, light.direction), light.direction, light.distance, false);
    float distance = clamp(passage.distance, kLeastShadowDistance, 65000.0);
    return Shadow(passage.transmittance, passage.distance == kNever ? kMiss : distance);
}
#endif
