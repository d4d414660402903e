// What IN_SPEC_MV says of a pixel: how what is seen in it moves by itself.
// Needs gIn_SpecularMotion, but for occlusion gIn_PrevTrack and gOut_Track, and the neighbourhood of accumulate.glsl.
#ifndef REFLECTED_MOTION_GLSL
#define REFLECTED_MOTION_GLSL

const float kMaxRoughnessOfOutline = 0.1; // up to here a pixel's samples agree on what it shows
const float kMaxRoughnessOfImage = 0.25; // up to here what is reflected is followed in full
const float kMinRoughnessOfBlur = 0.5;   // from here on not at all

// Of the 3x3 pixels; .w 1, or all 0 where there is no sample of the same surface.
vec4 motionAt(Surface s, int i)
{
    ivec2 offset = ivec2(i % 3, i / 3) - 1;
    vec4 other = neighbour(offset);
    vec4 motion = texelFetch(gIn_SpecularMotion, clampToRect(s.pixel + offset) * g.signalStride, 0);
    // Written so that NaN is no sample.
    bool isUsed = other.w > 0.0 && dot(other.xyz, s.guide.N) > 0.9 && motion.w > 0.0 &&
                  all(lessThan(abs(motion.xyz), vec3(NRD_FP16_MAX)));
    return isUsed ? vec4(motion.xyz, 1.0) : vec4(0.0);
}

// World motion of what the pixel's neighbourhood reflects: of the 3x3 the sample nearest to their mean, since rays of a
// wide lobe hit one thing or another. Rough surfaces have no image that could be followed.
vec3 reflectedMotion(Surface s)
{
    float share = ramp(kMinRoughnessOfBlur, kMaxRoughnessOfImage, s.guide.roughness);
    if (!kHasSpecularMotion || share == 0.0) return vec3(0.0);
    vec4 sum = vec4(0.0);
    // Not unrolled: nine motions at once take more registers than all else, also where there is no motion.
    [[dont_unroll]] for (int i = 0; i < 9; i++) sum += motionAt(s, i);
    vec3 mean = sum.xyz / max(sum.w, 1.0);
    vec3 nearest = vec3(0.0);
    float least = 1e30;
    [[dont_unroll]] for (int i = 0; i < 9; i++)
    {
        vec4 motion = motionAt(s, i);
        vec3 apart = motion.xyz - mean;
        bool isNearer = motion.w > 0.0 && dot(apart, apart) < least;
        least = isNearer ? dot(apart, apart) : least;
        nearest = isNearer ? motion.xyz : nearest;
    }
    return nearest * share;
}

// hitDist: of the pixel, as it is accumulated; 0 = unknown. otherwise: in its place.
Reflection readReflection(Surface s, float normHitDist, float otherwise)
{
    float hitDist = getHitDist(normHitDist, s.viewZ, s.guide.roughness);
    return Reflection(hitDist > 0.0 ? hitDist : otherwise, reflectedMotion(s));
}

// The tracking distance for the next frame; below 0: of something that moves.
void storeTrack(ivec2 pixel, float hitDist, Reflection reflection)
{
#if IS_BOUNDED == 0
    imageStore(gOut_Track, pixel, vec4(isMoving(reflection) ? -hitDist : hitDist));
#endif
}

// Where something stands still now, the history of what has moved on is a ghost. 1 = none of that. Wide lobes see both
// by turns, which is no reason to start anew.
float vacancyConfidence(Surface s, Reflection reflection, Footprint footprint)
{
#if IS_BOUNDED == 0
    if (kHasSpecularMotion && !isMoving(reflection))
    {
        vec2 uv = (vec2(footprint.origin) + 1.0) * g.resourceSizeInvPrev;
        vec4 tracks = gatherOrder(textureGather(sampler2D(gIn_PrevTrack, gNearestClamp), uv));
        float share = ramp(kMaxRoughnessOfImage, kMaxRoughnessOfOutline, s.guide.roughness);
        return 1.0 - share * dot(footprint.bilinear, vec4(lessThan(tracks, vec4(0.0))));
    }
#endif
    return 1.0;
}

#endif
