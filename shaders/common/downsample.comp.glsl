// Noisy signals of several pixels to one: their mean, by how much their surfaces are that of the pixel whose guides the
// denoiser sees, which is the first of them. As packed by the application; what is not finite does not count.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "resampling.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_NormalRoughness;
#define FIRST_OUT (2 + SIGNAL_NUM)
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_First;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_First;
#if IS_SH
layout(set = SET_RESOURCES, binding = 2 + LOBE_NUM) uniform texture2D gIn_FirstSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM) uniform writeonly image2D gOut_FirstSh;
#else
#define gIn_FirstSh gIn_First
#define gOut_FirstSh gOut_First
#endif
#if LOBE_NUM == 2
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Second;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 1) uniform writeonly image2D gOut_Second;
#if IS_SH
layout(set = SET_RESOURCES, binding = 5) uniform texture2D gIn_SecondSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 3) uniform writeonly image2D gOut_SecondSh;
#else
#define gIn_SecondSh gIn_Second
#define gOut_SecondSh gOut_Second
#endif
#endif

// Of one lobe.
struct Sum
{
    vec4 value, axis;
    float weight;        // of all samples
    float hitDistWeight; // of those that the lobe has
};

void add(texture2D t, texture2D second, ivec2 pixel, float weight, inout Sum sum)
{
    vec4 value = texelFetch(t, pixel, 0);
    if (!NRD_IsRadianceFinite(value.xyz) || !NRD_IsFinite(value.w)) return;
    // 0 says that the lobe was not sampled there; its radiance counts, being larger where it was.
    float hitDist = kIsOcclusion ? value.x : value.w;
    float hitDistWeight = hitDist > 0.0 ? weight : 0.0;
    if (kIsBounded)
        sum.value += value * hitDistWeight; // a direction comes with its distance
    else
        sum.value += vec4(value.xyz * weight, value.w * hitDistWeight);
    if (kIsSh)
    {
        vec4 axis = texelFetch(second, pixel, 0);
        if (NRD_IsRadianceFinite(axis.xyz)) sum.axis += axis * weight;
    }
    sum.weight += weight;
    sum.hitDistWeight += hitDistWeight;
}

void store(writeonly image2D t, writeonly image2D second, ivec2 pixel, Sum sum)
{
    // Without any sample both sums are 0.
    float scale = 1.0 / max(sum.weight, 1e-30), hitDistScale = 1.0 / max(sum.hitDistWeight, 1e-30);
    imageStore(t, pixel, roundToHalf(sum.value * vec4(vec3(kIsBounded ? hitDistScale : scale), hitDistScale)));
    if (kIsSh) imageStore(second, pixel, roundToHalf(sum.axis * scale));
}

void main()
{
    ivec2 target = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(target)) return;
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(target), 0).x);
    if (!isInRange(viewZ)) return;
    Surface s = makeSurface(decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(target), 0)), vec2(target), viewZ);
    Sum first = Sum(vec4(0.0), vec4(0.0), 0.0, 0.0), second = first;
    for (int i = 0; i < g.signalStride * g.signalStride; i++)
    {
        ivec2 offset = ivec2(i % g.signalStride, i / g.signalStride);
        ivec2 pixel = min(target * g.signalStride + offset, g.fullRectSizeMinusOne);
        float z = decodeViewZ(texelFetch(gIn_ViewZ, pixel + g.rectOrigin, 0).x);
        if (!isInRange(z)) continue;
        Guide guide = decodeGuide(texelFetch(gIn_NormalRoughness, pixel + g.rectOrigin, 0));
        vec2 weights = kinship(s, guide, vec2(pixel) / float(g.signalStride), z);
        add(gIn_First, gIn_FirstSh, pixel, lobeWeight(weights, 0), first);
#if LOBE_NUM == 2
        add(gIn_Second, gIn_SecondSh, pixel, lobeWeight(weights, 1), second);
#endif
    }
    store(gOut_First, gOut_FirstSh, target, first);
#if LOBE_NUM == 2
    store(gOut_Second, gOut_SecondSh, target, second);
#endif
}
