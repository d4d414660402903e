// Shared by the passes of REBLUR and RELAX: reading of guides, and the factors of the methods.
#ifndef DENOISER_GLSL
#define DENOISER_GLSL
#include "variant.glsl"
#include "math.glsl"
#include "geometry.glsl"
#include "nrd_frontend.glsl"
#include "denoiser_bindings.glsl"

const int kSpecularChannel = LOBE_NUM - 1; // of textures that hold one scalar per lobe; diffuse is channel 0
const float kTrackingMax = 65000.0; // hit distances are stored in half floats

//----------------------------------------------------------------------------------------------------------------------
// Guides

// Comparisons are written so that NaN counts as out of range.
bool isInRange(float viewZ) { return viewZ < g.denoisingRange; }
bool isInRect(ivec2 pixel) { return all(lessThanEqual(pixel, g.rectSizeMinusOne)); }
ivec2 clampToRect(ivec2 pixel) { return clamp(pixel, ivec2(0), g.rectSizeMinusOne); }
ivec2 mirrorPixel(ivec2 pixel)
{
    pixel = abs(pixel);
    return clampToRect(min(pixel, 2 * g.rectSizeMinusOne - pixel));
}
ivec2 guideTexel(ivec2 pixel) { return pixel * g.guideStride + g.rectOrigin; }
vec2 pixelUv(ivec2 pixel) { return (vec2(pixel) + 0.5) * g.rectSizeInv; }

// 1e-4 keeps the frustum's size, a divisor of every distance weight, away from zero.
float decodeViewZ(float stored) { return max(abs(stored * g.viewZScale), 1e-4); }

struct Guide
{
    vec3 N;
    float roughness;
    uint materialID;
};

Guide decodeGuide(vec4 packed)
{
    float materialID;
    vec4 normalRoughness = NRD_UnpackNormalAndRoughness(packed, kNormalEncoding, kRoughnessEncoding, materialID);
    return Guide(normalRoughness.xyz, normalRoughness.w, uint(materialID));
}

bool isSameMaterial(uint a, uint b, uint minMaterial)
{
    return !kHasMaterialTest || max(a, minMaterial) == max(b, minMaterial);
}

vec3 viewDirection(vec3 X) // surface to camera
{
    return g.cameraDelta.w != 0.0 ? g.viewDirection.xyz : -X * inversesqrt(max(dot(X, X), 1e-20));
}

float getPixelSize(float viewZ) { return pixelSize(g.unproject, viewZ, g.cameraDelta.w); }
float getFrustumSize(float viewZ) { return g.minRectDim * getPixelSize(viewZ); }

//----------------------------------------------------------------------------------------------------------------------
// History lengths: quarter frames in 8 bits

vec2 unpackLengths(vec2 stored) { return floor(stored * 255.0 + 0.5) * 0.25; }
vec2 packLengths(vec2 frames) { return clamp(frames * (4.0 / 255.0), 0.0, 1.0); }
uint packLengthWord(vec2 frames)
{
    uvec2 q = uvec2(clamp(frames * 4.0 + 0.5, 0.0, 255.0));
    return LOBE_NUM == 2 ? q.x | (q.y << 8) : q.x;
}
vec4 unpackLengthWords(uvec4 words, int channel) { return vec4((words >> uint(8 * channel)) & 0xFFu) * 0.25; }

// Weight of the new sample for a history of n frames.
float newSampleWeight(float n) { return 1.0 / (1.0 + n); }

// Falls from 1 to about 1 / (1 + n), later than that: residual noise of a fresh history is worse than excess blur.
float convergence(float n)
{
    float e = g.convergence.x + g.convergence.y * saturate(n * g.convergenceLengthInv);
    return 1.0 / (1.0 + e * n);
}

//----------------------------------------------------------------------------------------------------------------------
// Signals

// RELAX is given world units.
float getHitDist(float normHitDist, float viewZ, float roughness)
{
    return kIsRelax ? normHitDist : REBLUR_GetHitDist(normHitDist, viewZ, g.hitDistanceParameters.xyz, roughness);
}

// The share of the screen the hit distance spans; near contacts it is 0 and every kernel collapses.
float hitDistFactor(float hitDist, float frustumSize) { return saturate(hitDist / frustumSize); }

// Half the size of one lobe-angle cut-off: convergence narrows the admissible angle so that normal detail returns.
float normalCutoff(float roughness, float narrowing)
{
    float share = 0.75 * mix(g.lobeAngleFraction, 1.0, narrowing);
    return max(angleOf(lobeTangent(roughness, share)), normalEncodingError(kNormalEncoding));
}

#include "signal.glsl"

vec4 packScalars(float diffuse, float specular)
{
    return LOBES == 2 ? vec4(specular) : vec4(diffuse, specular, 0.0, 0.0);
}

vec4 packPairs(vec2 diffuse, vec2 specular) { return LOBES == 2 ? vec4(specular, 0.0, 0.0) : vec4(diffuse, specular); }

#endif
