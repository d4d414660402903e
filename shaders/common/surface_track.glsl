// The history a pixel's own surface left on the previous frame's screen.
// Needs gIn_PrevDepth, gIn_PrevNormalRoughness, gIn_PrevLength, gIn_Cut.
#ifndef SURFACE_TRACK_GLSL
#define SURFACE_TRACK_GLSL
#include "motion.glsl"
#include "history.glsl"
#include "history_reset.glsl"
#include "prev_surface.glsl"

struct Surface
{
    ivec2 pixel;
    vec2 uv;
    float viewZ;
    float pixelSize;   // world
    float frustumSize; // world
    vec3 X;
    vec3 V;
    float NoV;
    vec3 meanN; // of four neighbours, not normalised
    uint likeNeighbours; // bits of those next to it that show the same
    Guide guide;
    float disocclusionThreshold; // fraction of the frustum's size
};

struct SurfaceTrack
{
    vec2 uv;
    vec3 Xprev;
    float parallaxMax; // pixels; the safe choice for rejection
    float parallaxMin; // pixels; how far may be looked along the motion
    vec2 direction;    // of apparent motion, unit, pixels
    Footprint footprint;
    vec4 valid;   // 0 or 1
    vec4 weights; // bilinear * valid
    float NoN;    // of the footprint's normals with the mean normal
    bool isCubic; // all 12 texels valid: Catmull-Rom is allowed
    float quality;
    vec2 n; // frames, diffuse and specular
};

ivec2 lastPrevTexel() { return ivec2(g.rectSizePrev) - 1; }

// Both vanish under pure rotation of the camera; they differ on surfaces that move with it.
void measureParallax(Surface s, inout SurfaceTrack track)
{
    vec2 rest = projectToUv(g.worldToClipPrev, track.Xprev + g.cameraDelta.xyz);
    vec2 a = (rest - track.uv) * g.rectSize;
    vec2 b = (projectToUv(g.worldToClip, track.Xprev - g.cameraDelta.xyz) - s.uv) * g.rectSize;
    float lengthA = length(a), lengthB = length(b);
    track.parallaxMax = max(lengthA, lengthB);
    track.parallaxMin = min(lengthA, lengthB);
    track.direction = -a / max(lengthA, 1.0 / 256.0);
}

// Slanted planes change depth fast per pixel, so the threshold grows with 1 / cosine; not under high parallax, where
// that would smear behind silhouettes.
float disocclusionDistance(Surface s, float parallax)
{
    float cosine = mix(s.NoV, 1.0, saturate(parallax / 30.0));
    return s.frustumSize * saturate(s.disocclusionThreshold / max(0.05, cosine));
}

vec4 gatherPrevCodes(ivec2 texel)
{
    vec2 uv = (vec2(texel) + 1.0) * g.resourceSizeInvPrev;
    return gatherOrder(textureGather(sampler2D(gIn_PrevDepth, gNearestClamp), uv));
}

const vec2 kNoDepth = vec2(2.0, -1.0);

// Of stored codes, lowest and highest: within a threshold of what is expected. Half a step more, so that rounding
// refuses nothing that lies within the threshold.
vec2 depthBounds(float expected, float threshold)
{
    float nearest = expected - threshold, farthest = expected + threshold;
    if (!(threshold >= 0.0 && farthest > 0.0)) return kNoDepth;
    return vec2(encodeDepth(max(nearest, 1e-30)) - 0.5 * kDepthStep, encodeDepth(farthest) + 0.5 * kDepthStep);
}

// 1 = between the bounds.
vec4 testDepths(vec4 codes, vec2 bounds)
{
    return vec4(greaterThanEqual(codes, bounds.xxxx)) * vec4(lessThanEqual(codes, bounds.yyyy));
}

// Twelve texels in four quadrants, each tied to its inner texel of the 2x2 footprint by normal and material.
void testSurface(Surface s, inout SurfaceTrack track)
{
    ivec2 origin = track.footprint.origin;
    float threshold = disocclusionDistance(s, track.parallaxMax);
    float viewZPrev = transform(g.worldToViewPrev, track.Xprev).z;
    // Without motion a little back-facing noise is tolerated.
    float minCosine = 0.01745 - 0.25 * ramp(0.25, 0.0, track.parallaxMax);
    uint minMaterial = min(g.minMaterialForDiffuse, g.minMaterialForSpecular);
    vec2 bounds = depthBounds(viewZPrev, threshold - kEps); // -eps: a zeroed threshold rejects even equality
    vec4 inside = footprintInside(origin, lastPrevTexel());
    vec4 NoN, quadrantSum;
    for (int i = 0; i < 4; i++)
    {
        ivec2 quadrant = ivec2(i & 1, i >> 1);
        Guide other = decodePrevGuide(texelFetch(gIn_PrevNormalRoughness,
                                                 footprintTexel(origin, i, lastPrevTexel()), 0));
        NoN[i] = dot(other.N, s.meanN);
        // By the own normal: at a contact the mean points between the surfaces, and lets one's light into the other.
        bool isAccepted = inside[i] > 0.0 && dot(other.N, s.guide.N) > minCosine &&
                          isSameMaterial(s.guide.materialID, other.materialID, minMaterial);
        vec4 passed = testDepths(gatherPrevCodes(origin - 1 + 2 * quadrant), isAccepted ? bounds : kNoDepth);
        track.valid[i] = passed[3 - i];
        quadrantSum[i] = dot(passed, vec4(1.0)) - passed[i];
    }
    track.isCubic = all(greaterThanEqual(quadrantSum, vec4(2.5)));
    track.weights = track.footprint.bilinear * track.valid;
    track.NoN = dot(NoN, track.footprint.bilinear);
}

// Partial footprints, and ones that were seen at a more grazing angle, are worth less.
float surfaceQuality(Surface s, SurfaceTrack track)
{
    vec3 toCameraPrev = g.cameraDelta.w != 0.0 ? g.viewDirection.xyz : normalize(g.cameraDelta.xyz - track.Xprev);
    float cosinePrev = abs(dot(s.guide.N, toCameraPrev));
    float size = saturate(square((cosinePrev + 1e-3) / (s.NoV + 1e-3)));
    return sqrt(saturate(dot(track.weights, vec4(1.0)))) * mix(0.1, 1.0, size);
}

// A confidence of 1 leaves the length alone, 0 leaves less than a frame; short histories are cut less.
float applyConfidence(float n, float confidence) { return n * mix(confidence, 1.0, 1.0 / (1.0 + n)); }

// The application's is taken at its word: 0 leaves nothing, since with one frame the light that went off would still be
// half of the picture, and a third of the next. It may be anything: a length below 0 would turn the signs of weights.
float applyGivenConfidence(float n, float given)
{
    float confidence = clamp(given, 0.0, 1.0);
    return n * mix(confidence, 1.0, confidence / (1.0 + n));
}

vec2 fetchLengths(ivec2 origin, vec4 weights)
{
    vec2 uv = (vec2(origin) + 1.0) * g.resourceSizeInvPrev;
    uvec4 words = gatherOrder(textureGather(usampler2D(gIn_PrevLength, gNearestClamp), uv));
    vec2 n = vec2(customBilinear(unpackLengthWords(words, 0), weights), 0.0);
    if (LOBE_NUM == 2) n.y = customBilinear(unpackLengthWords(words, 1), weights);
    return isHistoryReset() ? vec2(0.0) : min(n, LOBES == 2 ? g.maxAccumulatedFrameNum.yy : g.maxAccumulatedFrameNum);
}

SurfaceTrack trackSurface(Surface s, vec3 motion)
{
    SurfaceTrack track;
    Motion followed = followMotion(s.uv, s.viewZ, s.X, motion);
    track.uv = followed.uv;
    track.Xprev = followed.Xprev;
    measureParallax(s, track);
    // Nearly static hair: accept almost anything, or sub-pixel geometry resets every frame.
    if (kHasMaterialTest && s.guide.materialID == g.strandMaterialID)
        s.disocclusionThreshold = mix(0.25, s.disocclusionThreshold, smooth01(track.parallaxMax));
    // Clamped: a wild motion vector must not overflow the integer texel.
    track.footprint = makeFootprint(clamp(track.uv, -1.0, 2.0) * g.rectSizePrev);
    testSurface(s, track);
    if (!isInScreen(track.uv))
    {
        track.valid = track.weights = vec4(0.0);
        track.isCubic = false;
    }
    track.quality = surfaceQuality(s, track);
    track.n = fetchLengths(track.footprint.origin, track.weights);
    return track;
}

#endif
