// Shows what the denoiser was given and what became of it, as a grid of small views. Alpha is coverage; after a reset
// there is nothing to judge yet, and everything is 0.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "checkerboard.glsl"
#include "motion.glsl"
#include "validation_views.glsl"

#define FIRST_SIGNAL (4 + HAS_SPECULAR)

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_Motion;
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Length;
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL) uniform texture2D gIn_Diffuse;
#if IS_SH
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + LOBE_NUM) uniform texture2D gIn_DiffuseSh;
#endif
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = 4) uniform texture2D gIn_VirtualAmount;
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + LOBE_NUM - 1) uniform texture2D gIn_Specular;
#if IS_SH
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + 2 * LOBE_NUM - 1) uniform texture2D gIn_SpecularSh;
#endif
#endif
layout(set = SET_RESOURCES, binding = FIRST_SIGNAL + SIGNAL_NUM) uniform writeonly image2D gOut_Validation;

// With the split at the right border nothing was denoised, so there is no history to show.
bool hasHistory() { return g.splitScreen < 1.0; }

float storedViewZ(ivec2 pixel) { return texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x * g.viewZScale; }

// Before decodeViewZ(), whose max() would make a number of NaN.
bool isShown(ivec2 pixel)
{
    float viewZ = storedViewZ(pixel);
    return NRD_IsFinite(viewZ) && isInRange(abs(viewZ));
}

vec3 worldPosition(ivec2 pixel) // from the camera
{
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
    return rotate(g.viewToWorld, reconstructViewPosition(pixelUv(pixel), g.frustum, viewZ, g.cameraDelta.w));
}

// Half way to white at a few times the hit distance that is normalised to 1, a length of the scene's own scale.
vec4 depthColor(ivec2 pixel)
{
    if (!isShown(pixel)) return kRed;
    float viewZ = storedViewZ(pixel);
    float share = sqrt(abs(viewZ) / (abs(viewZ) + g.hitDistanceParameters.x / g.hitDistanceParameters.y));
    return viewZ < 0.0 ? vec4(0.0, 0.0, share, 1.0) : vec4(0.0, share, 0.0, 1.0);
}

// Pixels by which the motion differs from that of a static scene; right of moving objects, a fault elsewhere.
vec4 motionColor(ivec2 pixel)
{
    vec3 X = worldPosition(pixel);
    vec3 texel = texelFetch(gIn_Motion, guideTexel(pixel), 0).xyz;
    bool isWorldSpace = g.motionVectorScale.w != 0.0;
    if (!NRD_IsFinite(texel.x) || !NRD_IsFinite(texel.y) || (isWorldSpace && !NRD_IsFinite(texel.z))) return kMagenta;
    vec3 mv = readMotion(gIn_Motion, gIn_ViewZ, pixel);
    vec2 given = followMotion(pixelUv(pixel), abs(storedViewZ(pixel)), X, mv).uv;
    vec2 difference = clamp(abs(given - projectToUv(g.worldToClipPrev, X)) * g.rectSize, 0.0, 1.0);
    return vec4(difference, isInScreen(given) ? 0.0 : 1.0, 1.0);
}

vec4 virtualAmountColor(ivec2 pixel)
{
#if HAS_SPECULAR
    ivec2 texel = min(pixel, g.rectSizeMinusOne - VIRTUAL_AMOUNT_STEP / 2) / VIRTUAL_AMOUNT_STEP;
    ivec2 owner = texel * VIRTUAL_AMOUNT_STEP + VIRTUAL_AMOUNT_STEP / 2; // the one pixel that wrote it
    if (!isInRect(owner) || !hasHistory()) return kNothing;
    return isShown(owner) ? vec4(vec3(texelFetch(gIn_VirtualAmount, texel, 0).x), 1.0) : kBlack;
#else
    return kNothing;
#endif
}

vec4 lengthColor(View v, int channel)
{
    if (!hasHistory()) return kNothing;
    float maxLength = max(max(g.maxAccumulatedFrameNum.x, g.maxAccumulatedFrameNum.y), 1.0);
    vec4 color = kBlack;
    if (isShown(v.source))
    {
        float n = unpackLengths(texelFetch(gIn_Length, v.source, 0).xy)[channel];
        bool isOdd = (((v.pixel.x ^ v.pixel.y) >> 2) & 1) != 0;
        color = n < 1.0 && isOdd ? kBlack : vec4(rainbow(n / maxLength), 1.0);
    }
    int barTop = int(0.95 * v.size.y);
    if (v.pixel.y >= barTop) return vec4(rainbow(v.uv.x), 1.0);
    int scale = textScale(v);
    int textTop = barTop - (kGlyphSize.y + 1) * scale;
    uint number = uint(max(g.maxAccumulatedFrameNum.x, g.maxAccumulatedFrameNum.y));
    int digitNum = number >= 10u ? 2 : 1;
    drawNumber(v, 0u, ivec2(scale, textTop), color);
    drawNumber(v, number, ivec2(int(v.size.x) - kAdvance * digitNum * scale, textTop), color);
    return color;
}

// Red: this lobe has no sample here, which is fine for some pixels and a fault for all. A pixel of a checkerboard that
// has no data shows that of its neighbour.
vec4 hitDistColor(texture2D signal, texture2D second, ivec2 pixel)
{
    if (!isShown(pixel)) return kBlack;
    ivec2 texel = inputTexel(pixel);
    vec4 value = texelFetch(signal, texel, 0);
    bool isFinite = NRD_IsRadianceFinite(value.xyz);
    if (kIsSh) isFinite = isFinite && NRD_IsRadianceFinite(texelFetch(second, texel, 0).xyz);
    float hitDist = kIsOcclusion ? value.x : value.w;
    // World units, shown over the length that REBLUR takes for open.
    if (kIsRelax)
    {
        float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
        hitDist = REBLUR_FrontEnd_GetNormHitDist(hitDist, viewZ, g.hitDistanceParameters.xyz, 1.0);
    }
    if (!isFinite) return kMagenta;
    return hitDist == 0.0 ? kRed : greyOf(hitDist);
}

// Place in the unit cube. Half a step of the output keeps walls and floors at whole numbers from flickering between 0
// and 1, so that noise in this view means noise in the depth.
vec4 worldColor(ivec2 pixel)
{
    return vec4(fract(worldPosition(pixel) + g.cameraPosition.xyz + 0.5 / 255.0), 1.0);
}

vec4 guideColor(View v)
{
    if (!isShown(v.source)) return kBlack;
    Guide guide = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(v.source), 0));
    switch (v.index)
    {
    case kViewRoughness: return greyOf(guide.roughness);
    case kViewNormal: return vec4(0.5 * guide.N + 0.5, 1.0);
    case kViewMotion: return motionColor(v.source);
    }
    return worldColor(v.source);
}

vec4 viewColor(View v)
{
    switch (v.index)
    {
    case kViewWorld:
    case kViewRoughness:
    case kViewMotion:
    case kViewNormal: return guideColor(v);
    case kViewDepth: return depthColor(v.source);
    case kViewVirtualAmount: return virtualAmountColor(v.source);
#if HAS_DIFFUSE
    case kViewDiffuseLength: return lengthColor(v, 0);
    case kViewDiffuseHitDist: return hitDistColor(gIn_Diffuse, gIn_DiffuseSh, v.source);
#endif
#if HAS_SPECULAR
    case kViewSpecularLength: return lengthColor(v, kSpecularChannel);
    case kViewSpecularHitDist: return hitDistColor(gIn_Specular, gIn_SpecularSh, v.source);
#endif
    }
    return kNothing;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(pixel)) return;
    View v = makeView(pixel);
    vec4 color = g.isHistoryReset != 0u ? kNothing : viewColor(v);
    if (color.w > 0.0)
    {
        if (v.index == kViewWorld) drawMiniViews(v, color);
        drawLabel(v, color);
    }
    imageStore(gOut_Validation, pixel, color);
}
