// One blur of both: a dense part of 5x5 pixels from shared memory, which finds the width of the penumbra, and a sparse
// part as wide as the penumbra. Needs gIn_Tiles, gIn_ViewZ, gIn_NormalRoughness and
// ShadowSample readFiltered(ivec2 pixel, float viewZ), what is filtered, and with HAS_PAST float readPastVisibility(
// ivec2 pixel), of the last frames, kNone where there is none.
#ifndef PENUMBRA_FILTER_GLSL
#define PENUMBRA_FILTER_GLSL
#include "plane.glsl"
#extension GL_EXT_control_flow_attributes : require

const int kRadius = 2;
const ivec2 kHalo = ivec2(8 + 2 * kRadius, 16 + 2 * kRadius);
// Radius of the sparse part over the penumbra's half-width. Wider blurs the penumbra's ends, narrower leaves noise to
// the frames that follow; both blurs together reach half of the penumbra.
const float kKernelScale = 0.35;
const float kMinCosine = 0.25; // of the light with the surface: stretches a kernel four times at most
const float kWidestKernel = 32.0; // pixels
const float kNone = -1.0;

struct Texel
{
    float viewZ;
    ShadowSample value; // radius kNone: not to be used
    float past;         // visibility, kNone: not there
};

// One read of 16 bytes per texel: shared memory's bandwidth is what this filter spends.
shared uint sKinds;
shared uvec4 sTexels[kHalo.y][kHalo.x];

uvec4 packTexel(Texel t)
{
    uint depth = floatBitsToUint(t.viewZ), radiusPast = packHalf2x16(vec2(t.value.radius, t.past));
#if HAS_TRANSLUCENCY
    return uvec4(packHalf2x16(t.value.shadow.xy), packHalf2x16(t.value.shadow.zw), radiusPast, depth);
#else
    return uvec4(floatBitsToUint(t.value.shadow), 0u, radiusPast, depth);
#endif
}

Texel unpackTexel(uvec4 words)
{
    vec2 radiusPast = unpackHalf2x16(words.z);
#if HAS_TRANSLUCENCY
    Shadow shadow = vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y));
#else
    Shadow shadow = uintBitsToFloat(words.x);
#endif
    return Texel(uintBitsToFloat(words.w), ShadowSample(shadow, radiusPast.x), radiusPast.y);
}

// Of the group's tile and those around it. Every invocation of the group must come here.
uint gatherKinds(ivec2 group)
{
    if (gl_LocalInvocationIndex == 0) sKinds = 0u;
    barrier();
    int i = int(gl_LocalInvocationIndex);
    ivec2 tile = group / TILE_SIZE + ivec2(i % 3, i / 3) - 1;
    if (i < 9 && all(greaterThanEqual(tile, ivec2(0))) && all(lessThanEqual(tile, g.rectSizeMinusOne / TILE_SIZE)))
        atomicOr(sKinds, texelFetch(gIn_Tiles, tile, 0).x);
    barrier();
    return sKinds;
}

void loadNeighbourhood(ivec2 group)
{
    for (int i = int(gl_LocalInvocationIndex); i < kHalo.x * kHalo.y; i += 128)
    {
        ivec2 local = ivec2(i % kHalo.x, i / kHalo.x);
        ivec2 pixel = group + local - kRadius;
        ivec2 inside = clampToRect(pixel);
        float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(inside), 0).x);
        Texel t = Texel(viewZ, ShadowSample(Shadow(0.0), kNone), kNone);
        if (pixel == inside && isInRange(viewZ)) // what is out of range was not written
        {
            t.value = readFiltered(pixel, viewZ);
#if HAS_PAST
            t.past = readPastVisibility(pixel);
#endif
        }
        sTexels[local.y][local.x] = packTexel(t);
    }
}

struct Receiver
{
    ivec2 pixel;
    vec3 Xv;
    vec3 Nv;
    float pixelSize;
    float tooFar; // from the plane, world units
    Plane plane;  // in these
};

Receiver makeReceiver(ivec2 pixel, float viewZ)
{
    Receiver r;
    r.pixel = pixel;
    r.Xv = reconstructViewPosition(pixelUv(pixel), g.frustum, viewZ, g.cameraDelta.w);
    vec3 N = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(pixel), 0)).N;
    r.Nv = N * mat3(g.viewToWorld); // the inverse of a rotation
    r.pixelSize = getPixelSize(viewZ);
    r.tooFar = g.planeDistanceSensitivity * getFrustumSize(viewZ);
    r.plane = makePlane(r.Nv, r.Xv, r.tooFar);
    return r;
}

float planeWeight(Receiver r, ivec2 pixel, float viewZ)
{
    return soft(planeDistance(r.plane, vec2(pixel), viewZ));
}

// Small penumbrae dominate the mean: near a contact the narrow one is right.
float widthWeight(float radius) { return 1.0 / (1.0 + max(radius, 0.0)); } // a missing one may be -1

struct Sums
{
    Shadow shadow;
    float weight;
    float radius;
    float radiusWeight; // of hits only: lit pixels have no width
};

void addSample(inout Sums sums, ShadowSample s, float weight)
{
    sums.shadow += s.shadow * weight;
    sums.weight += weight;
    float radiusWeight = isLit(s.radius) ? 0.0 : weight * widthWeight(s.radius);
    sums.radius += s.radius * radiusWeight;
    sums.radiusWeight += radiusWeight;
}

// What 5x5 pixels of the same surface hold.
struct Neighbourhood
{
    Shadow mean;
    Shadow sigma;
    float radius; // 0: no hit
    float change; // of the visibility since the last frames, where they are known; of other surfaces as well
};

// own: not facing away. Differences to it: a variance from sums of squares has no digits left on flat walls.
Neighbourhood measureNeighbourhood(Receiver r, ShadowSample own)
{
    Sums sums = Sums(Shadow(0.0), 0.0, 0.0, 0.0);
    Shadow squares = Shadow(0.0);
    vec2 change = vec2(0.0); // .y weight
    // Unrolled and without branches here and below, so that the reads of all taps are under way at once.
    [[unroll]] for (int i = 0; i < 25; i++)
    {
        ivec2 offset = ivec2(i % 5, i / 5);
        ivec2 local = ivec2(gl_LocalInvocationID.xy) + offset;
        Texel t = unpackTexel(sTexels[local.y][local.x]);
        vec2 distance = vec2(offset - kRadius);
        float onPlane = i == 12 ? 1.0 : planeWeight(r, r.pixel + offset - kRadius, t.viewZ);
        float weight = onPlane * exp2(-0.238 * dot(distance, distance)); // exp(-0.66 (d / 2)^2)
        bool isUsed = t.value.radius > 0.0; // neither missing nor facing away
        weight = isUsed ? weight : 0.0;
        Shadow difference = t.value.shadow - own.shadow;
        addSample(sums, ShadowSample(difference, t.value.radius), weight);
        squares += difference * difference * weight;
        change += isUsed && t.past != kNone ? vec2(visibility(t.value.shadow) - t.past, 1.0) : vec2(0.0);
    }
    Neighbourhood n;
    Shadow mean = sums.shadow / sums.weight; // the centre counts at least
    n.mean = own.shadow + mean;
    n.sigma = sqrt(max(squares / sums.weight - mean * mean, Shadow(0.0)));
    n.radius = sums.radiusWeight > 0.0 ? sums.radius / sums.radiusWeight : 0.0;
    n.change = change.y > 0.0 ? abs(change.x) / change.y : 0.0;
    return n;
}

// Pixels per penumbra half-width of one pixel, along two axes on the receiving surface: a disc of light throws an
// ellipse, longer along the direction the light comes from the flatter it comes.
mat2 makeKernel(Receiver r)
{
    vec3 L = g.sigmaLight.w == 0.0 ? vec3(0.0) : g.sigmaLight.xyz;
    if (g.sigmaLight.w == 2.0) L = NRD_NormalizeOrZero(g.sigmaLight.xyz - r.Xv);
    float cosine = dot(r.Nv, L);
    vec3 T = L - r.Nv * cosine, B;
    float stretch = 1.0;
    if (dot(T, T) > 1e-4)
    {
        T = normalize(T);
        B = cross(r.Nv, T);
        stretch = 1.0 / max(abs(cosine), kMinCosine);
    }
    else
        tangentBasis(r.Nv, T, B);
    vec2 slope = g.cameraDelta.w != 0.0 ? vec2(0.0) : r.Xv.xy / r.Xv.z;
    vec2 scale = g.unproject * g.rectSize / g.frustum.zw; // -1 where screen and view run against each other
    return mat2((T.xy - slope * T.z) * scale * stretch, (B.xy - slope * B.z) * scale);
}

const vec3 kSparseTaps[8] = vec3[](
    vec3(-1.0, 0.0, 0.5169), vec3(0.0, 1.0, 0.5169), vec3(1.0, 0.0, 0.5169), vec3(0.0, -1.0, 0.5169),
    vec3(-0.35355, 0.35355, 0.8479), vec3(0.35355, 0.35355, 0.8479),
    vec3(0.35355, -0.35355, 0.8479), vec3(-0.35355, -0.35355, 0.8479));

void addSparse(inout Sums sums, Receiver r, float radius, vec4 rotator)
{
    mat2 kernel = makeKernel(r) * min(radius * kKernelScale, kWidestKernel);
    [[unroll]] for (int i = 0; i < 8; i++)
    {
        vec2 offset = kernel * (kSparseTaps[i].x * rotator.xy + kSparseTaps[i].y * rotator.zw);
        vec2 uv = mirrorUv(pixelUv(r.pixel) + offset * g.rectSizeInv);
        ivec2 pixel = clampToRect(ivec2(uv * g.rectSize));
        float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
        ShadowSample s = readFiltered(pixel, viewZ);
        // Umbra under a near occluder stays out of the mean of a wide penumbra, and what faces away, 0, altogether.
        float weight = kSparseTaps[i].z * saturate(s.radius / radius) * planeWeight(r, pixel, viewZ);
        // What is out of range was not written, and times 0 it could still be no number.
        bool isUsed = isInRange(viewZ);
        s.shadow = isUsed ? s.shadow : Shadow(0.0);
        addSample(sums, s, isUsed ? weight : 0.0);
    }
}

// Narrow penumbrae keep their sharp sample, and are hardly moved by the sparse part: 0 for none, 1 from six pixels on.
float softness(float radius) { return smooth01(radius * kKernelScale * 0.5); }

ShadowSample filterPenumbra(Receiver r, ShadowSample own, Neighbourhood n, vec4 rotator)
{
    float f = softness(n.radius);
    Shadow shadow = mix(own.shadow, n.mean, f);
    if (n.radius == 0.0) return ShadowSample(shadow, own.radius);
    float boost = mix(4.0, 1.0, f);
    Sums sums = Sums(shadow * boost, boost, n.radius * boost * widthWeight(n.radius), boost * widthWeight(n.radius));
    addSparse(sums, r, n.radius, rotator);
    return ShadowSample(sums.shadow / sums.weight, sums.radius / sums.radiusWeight);
}

#endif
