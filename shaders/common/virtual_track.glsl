// The history of what is seen in the surface: follows the virtual image behind the reflector.
// Needs the textures of surface_track.glsl and gIn_PrevTrack, or gIn_SpecularHistory for occlusion.
#ifndef VIRTUAL_TRACK_GLSL
#define VIRTUAL_TRACK_GLSL
#include "surface_track.glsl"
#include "virtual_motion.glsl"
#include "random.glsl"

const float kMaxVirtualAcceleration = 5.0; // of a concave image against the surface's motion
const float kRoughnessSensitivity = 0.003;

// What is seen in the surface.
struct Reflection
{
    float hitDist; // world units
    vec3 motion;   // world, previous position minus now
};

bool isMoving(Reflection reflection) { return any(notEqual(reflection.motion, vec3(0.0))); }

struct VirtualTrack
{
    vec2 uv;
    float distanceToSurface; // pixels between the two tracks
    vec2 reflectedShift;     // uv the image moves because what is reflected does
    Footprint footprint;
    vec4 valid;
    vec4 weights;
    float NoN;
    bool isCubic;
    float quality;
    float confidence;
    float stillness; // of what is reflected: confidence in the other track
    float n;
};

// Compact falloff on squared roughness.
float roughnessWeight(float a, float b, float fraction, float sensitivity)
{
    float m = a * a;
    return soft(abs(b * b - m) / mix(sensitivity, 1.0, mix(m * m, m, saturate(fraction))));
}

Reflector makeReflector(Surface s, SurfaceTrack track)
{
    Reflector r;
    r.X = s.X;
    r.Xprev = track.Xprev;
    r.N = s.guide.N;
    r.V = s.V;
    r.factor = dominantFactor(s.NoV, s.guide.roughness);
    r.NoD = dot(s.guide.N, dominantDirection(s.guide.N, s.V, r.factor));
    r.NoV = s.NoV;
    r.distanceToCamera = length(s.X);
    return r;
}

// On the previous screen, by what is reflected. `hitDist` is the pixel's own: the nearest of the neighbourhood, which
// the image's place needs, would make every motion look greater.
vec2 reflectedShift(Reflector r, Reflection reflection, float curvature)
{
    if (!isMoving(reflection)) return vec2(0.0);
    vec3 position = virtualPosition(r, reflection.hitDist, curvature);
    vec3 motion = imageMotion(r, reflection.hitDist, curvature, reflection.motion);
    return projectToUv(g.worldToClipPrev, position + motion) - projectToUv(g.worldToClipPrev, position);
}

// The surface keeps a reflection only as long as what is reflected stays within a new sample's share of the lobe.
float stillnessConfidence(Surface s, Reflector r, Reflection reflection, float n)
{
    if (!isMoving(reflection)) return 1.0;
    vec3 motion = mirrorMotion(reflection.motion, s.guide.N);
    float turn = angleOf(length(motion - dot(motion, r.V) * r.V) / max(reflection.hitDist, 1e-6));
    float allowed = angleOf(lobeTangent(s.guide.roughness, 0.75) * newSampleWeight(n));
    return square(square(ramp(max(allowed, normalEncodingError(kNormalEncoding)), 0.0, turn)));
}

// A concave mirror near its focus magnifies without bound; beyond a limit the reflection is taken as flat.
float limitConcavity(Reflector r, SurfaceTrack track, float hitDist, float curvature)
{
    if (!(curvature < 0.0)) return curvature;
    Reflector still = r;
    still.Xprev = r.X;
    vec2 image = projectToUv(g.worldToClipPrev, virtualPosition(still, hitDist, curvature));
    float moved = length((image - projectToUv(g.worldToClipPrev, r.X)) * g.rectSize);
    return moved < kMaxVirtualAcceleration * track.parallaxMax + g.rectSizeInv.x ? curvature : 0.0;
}

// Validity of the 2x2 footprint: on the tangent plane, of like roughness and material. Grazing views are stricter,
// or sporadic bright texels are dragged into streaks next to thin occluders.
void testVirtual(Surface s, SurfaceTrack surface, inout VirtualTrack track, out vec4 roughnessWeights,
                 out vec4 previousGuide)
{
    ivec2 origin = track.footprint.origin;
    float threshold = s.disocclusionThreshold * s.frustumSize * mix(0.1, 1.0, s.NoV);
    float minCosine = 0.01745 - 0.25 * ramp(0.25, 0.0, surface.parallaxMax);
    float relax = smooth01(track.distanceToSurface);
    // Distance from the tangent plane of what lies at a depth, start + slope * depth.
    vec3 ray = reconstructViewPosition(track.uv, g.frustumPrev, 1.0, g.cameraDelta.w), eye = vec3(0.0);
    if (g.cameraDelta.w != 0.0)
    {
        eye = vec3(ray.xy, 0.0);
        ray = vec3(0.0, 0.0, 1.0);
    }
    float start = dot(s.guide.N, transform(g.viewToWorldPrev, eye) - surface.Xprev);
    float slope = dot(s.guide.N, rotate(g.viewToWorldPrev, ray));
    vec4 inside = footprintInside(origin, lastPrevTexel());
    vec4 codes = gatherPrevCodes(origin);
    vec4 NoN = vec4(0.0);
    previousGuide = vec4(0.0);
    for (int i = 0; i < 4; i++)
    {
        Guide other = decodeGuide(texelFetch(gIn_PrevNormalRoughness,
                                             footprintTexel(origin, i, lastPrevTexel()), 0));
        float weight = roughnessWeight(s.guide.roughness, other.roughness, g.roughnessFraction, kRoughnessSensitivity);
        roughnessWeights[i] = mix(1.0, weight, relax);
        float depth = decodeDepth(codes[i]); // 0: sky
        float planeDistance = abs(start + slope * depth);
        NoN[i] = dot(other.N, s.guide.N);
        bool isAccepted = inside[i] > 0.0 && NoN[i] > minCosine && roughnessWeights[i] >= 0.5 &&
                          depth > 0.0 && planeDistance <= threshold - kEps &&
                          isSameMaterial(s.guide.materialID, other.materialID, g.minMaterialForSpecular);
        track.valid[i] = isAccepted ? 1.0 : 0.0;
        previousGuide += vec4(other.N, other.roughness) * track.footprint.bilinear[i];
    }
    track.weights = track.footprint.bilinear * track.valid;
    track.NoN = dot(NoN, track.footprint.bilinear);
}

// Angle between two normals against what curvature explains and what the lobe forgives.
float angleConfidence(vec3 a, vec3 b, float explained, float forgiven)
{
    float w = smooth01(1.0 - (angleBetween(a, b) - explained) / forgiven);
    return smooth01((w - 0.05) / 0.9); // absorbs encoding error
}

// Was the place the previous frame's virtual history came from a matching surface too? Otherwise one frame of wrongly
// chosen surface history would be carried on for many.
float lookBackConfidence(Surface s, VirtualTrack track, vec2 surfaceUv, vec4 previousGuide, float curvatureAngle,
                         float lobeAngle)
{
    vec2 direction = (track.uv - surfaceUv) * g.rectSize / max(track.distanceToSurface, 1e-6);
    float travelled = min(track.distanceToSurface * g.frameRateScale, 2.0) + track.distanceToSurface;
    vec2 position = track.uv * g.rectSizePrev + direction * travelled;
    if (any(lessThan(position, vec2(0.0))) || any(greaterThanEqual(position, g.rectSizePrev))) return 1.0;
    // Stochastic bilinear read: the octahedral encoding cannot be filtered.
    uint seed = seedPixel(s.pixel, g.frameIndex);
    position += vec2(nextRandom(seed), nextRandom(seed)) - 0.5;
    Guide other = decodeGuide(texelFetch(gIn_PrevNormalRoughness,
                                         clamp(ivec2(position), ivec2(0), lastPrevTexel()), 0));
    vec3 N = normalize(previousGuide.xyz + 1e-9);
    float w = angleConfidence(N, other.N, curvatureAngle * (1.0 + travelled), lobeAngle) *
              roughnessWeight(previousGuide.w, other.roughness, g.roughnessFraction, kRoughnessSensitivity);
    return travelled < 1.0 ? mix(1.0, w, travelled) : w;
}

// Occlusion is a hit distance itself, so its history says what radiance needs a texture of its own for.
float previousHitDist(Surface s, vec2 uv)
{
#if IS_BOUNDED
    float history = decodeValue(textureLod(sampler2D(gIn_SpecularHistory, gLinearClamp), uv, 0.0)).w;
    return getHitDist(history, s.viewZ, s.guide.roughness);
#else
    return abs(textureLod(sampler2D(gIn_PrevTrack, gLinearClamp), uv, 0.0).x);
#endif
}

// History whose reflected object was at another depth is foreground in place of background or the reverse.
float parallaxConfidence(Surface s, Reflector r, VirtualTrack track, float hitDist, float curvature, float lobeTan)
{
    vec2 uv = track.uv * g.rectSizePrev * g.resourceSizeInvPrev;
    float previous = previousHitDist(s, uv);
    vec2 image = projectToUv(g.worldToClipPrev, virtualPosition(r, previous, curvature)) + track.reflectedShift;
    float moved = length((image - track.uv) * g.rectSize);
    float imageZ = length(virtualPosition(r, hitDist, curvature));
    float footprint = 0.5 * min(hitDist, previous) * lobeTan / max(getPixelSize(imageZ), 1e-15);
    // 1e-3 pixels: a mirror with no hit distance has no tolerance at all, and the ramp no width.
    return ramp(max(max(footprint, 0.1 * s.guide.roughness), 1e-3), 0.0, moved);
}

// hitDist: of the neighbourhood's nearest reflection; `reflection` is the pixel's own.
VirtualTrack trackVirtual(Surface s, SurfaceTrack surface, float hitDist, float curvature, Reflection reflection)
{
    VirtualTrack track;
    Reflector r = makeReflector(s, surface);
    curvature = limitConcavity(r, surface, hitDist, curvature);
    bool isAttached = kHasMaterialTest && s.guide.materialID == g.cameraAttachedMaterialID;
    track.uv = isAttached ? surface.uv : projectToUv(g.worldToClipPrev, virtualPosition(r, hitDist, curvature));
    track.reflectedShift = isAttached ? vec2(0.0) : reflectedShift(r, reflection, curvature);
    track.stillness = isAttached ? 1.0 : stillnessConfidence(s, r, reflection, surface.n[kSpecularChannel]);
    track.uv += track.reflectedShift;
    track.distanceToSurface = length((track.uv - surface.uv) * g.rectSizePrev);
    track.footprint = makeFootprint(clamp(track.uv, -1.0, 2.0) * g.rectSizePrev);
    vec4 roughnessWeights, previousGuide;
    testVirtual(s, surface, track, roughnessWeights, previousGuide);
    if (!isInScreen(track.uv)) track.valid = track.weights = vec4(0.0);
    track.isCubic = surface.isCubic && all(greaterThan(track.valid, vec4(0.5)));
    track.quality = sqrt(saturate(dot(track.weights, vec4(1.0))));
    track.n = fetchLengths(track.footprint.origin, track.weights)[kSpecularChannel];

    float lobeTan = max(lobeTangent(s.guide.roughness, 0.75 / (1.0 + track.n)), normalEncodingError(kNormalEncoding));
    float lobeAngle = angleOf(lobeTan);
    float stretch = max(track.distanceToSurface / max(s.NoV, 0.01), 1.0);
    float curvatureAngle = angleOf(2.0 * s.pixelSize * abs(curvature) * stretch);
    float normalPart = angleConfidence(s.guide.N, normalize(previousGuide.xyz + 1e-9), curvatureAngle, lobeAngle);
    normalPart = mix(1.0, normalPart, smooth01(track.distanceToSurface));
    float lookBack = lookBackConfidence(s, track, surface.uv, previousGuide, curvatureAngle, lobeAngle);
    track.confidence = min(dot(roughnessWeights, track.footprint.bilinear) * normalPart, lookBack);
    if (!isAttached) track.confidence *= parallaxConfidence(s, r, track, hitDist, curvature, lobeTan);
    return track;
}

// Where no image is followed: it moves with the surface.
VirtualTrack surfaceImage(SurfaceTrack surface)
{
    VirtualTrack track;
    track.uv = surface.uv;
    track.distanceToSurface = 0.0;
    track.reflectedShift = vec2(0.0);
    track.footprint = surface.footprint;
    track.valid = surface.valid;
    track.weights = surface.weights;
    track.NoN = surface.NoN;
    track.isCubic = surface.isCubic;
    track.quality = surface.quality;
    track.confidence = 1.0;
    track.stillness = 1.0;
    track.n = surface.n[kSpecularChannel];
    return track;
}

#endif
