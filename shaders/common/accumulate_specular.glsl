// Temporal accumulation of the specular lobe: two tracks, their confidences, and the choice between them.
#ifndef ACCUMULATE_SPECULAR_GLSL
#define ACCUMULATE_SPECULAR_GLSL
#include "reflected_motion.glsl"

const float kCurvaturePlaneSensitivity = 0.04;
// Rougher lobes are so wide that what they show moves with the surface; half of this pass is spared.
const float kNoImageRoughness = 0.7;

// Nearest reflected surface of the 3x3, world units, 0 = unknown.
float trackingDistance(Surface s)
{
    float nearest = 1e30;
    for (int i = 0; i < 9; i++)
    {
        float candidate = neighbourSample(kSpecularChannel, ivec2(i % 3, i / 3) - 1).w;
        nearest = candidate > 0.0 ? min(nearest, candidate) : nearest;
    }
    if (nearest == 1e30) return 0.0;
    bool isWorld = kHasPrepass && !kIsOcclusion;
    float hitDist = isWorld ? nearest : getHitDist(nearest, s.viewZ, s.guide.roughness);
    return min(hitDist, kTrackingMax);
}

// Roughness widened by the spread of normals in the neighbourhood: Neubelt and Pettineo 2013.
float widenedRoughness(Surface s)
{
    float len = clamp(length(s.meanN), 1e-3, 1.0);
    float variance = saturate(1.0 - len * len) / (len * (3.0 - len * len));
    return sqrt(saturate(square(s.guide.roughness) + variance));
}

// In view space, where rays are cheap.
struct ViewSurface
{
    vec3 X;
    vec3 N;
};

vec3 viewPosition(vec2 uv, float viewZ) { return reconstructViewPosition(uv, g.frustum, viewZ, g.cameraDelta.w); }

float planeDistance(ViewSurface v, vec3 X) { return abs(dot(v.N, X - v.X)); }

// The neighbour's ray meets the tangent plane; its own normal says how the surface bends. edge: to there, view space.
bool edgePoint(Surface s, ViewSurface v, ivec2 offset, out vec3 edge, out vec3 N)
{
    vec4 other = neighbour(offset);
    vec2 uv = s.uv + vec2(offset) * g.rectSizeInv;
    vec3 ray = viewPosition(uv, 1.0);
    vec3 direction = g.cameraDelta.w != 0.0 ? vec3(0.0, 0.0, -1.0) : ray;
    vec3 start = g.cameraDelta.w != 0.0 ? ray : vec3(0.0);
    float cosine = dot(v.N, direction);
    edge = start + direction * (dot(v.N, v.X - start) / (abs(cosine) < 1e-6 ? 1e-6 : cosine)) - v.X;
    N = other.xyz;
    // Across a silhouette the neighbour says nothing of this surface.
    return other.w > 0.0 && planeDistance(v, viewPosition(uv, other.w)) < kCurvaturePlaneSensitivity * s.frustumSize;
}

// Curvature along the apparent motion, convex > 0.
float motionCurvature(Surface s, SurfaceTrack track)
{
    ViewSurface v = ViewSurface(viewPosition(s.uv, s.viewZ), s.guide.N * mat3(g.viewToWorld));
    vec2 weights = abs(track.direction) + 1.0 / 256.0;
    vec3 edgeX, Nx, edgeY, Ny;
    weights.x = edgePoint(s, v, ivec2(1, 0), edgeX, Nx) ? weights.x : 0.0;
    weights.y = edgePoint(s, v, ivec2(0, 1), edgeY, Ny) ? weights.y : 0.0;
    float sum = weights.x + weights.y;
    vec3 edge = vec3(0.0), N = s.guide.N;
    if (sum > 0.0)
    {
        edge = (edgeX * weights.x + edgeY * weights.y) / sum;
        N = (Nx * weights.x + Ny * weights.y) / sum;
    }
    // Under high parallax the distance really travelled is measured, which flattens the bumps of normal maps.
    vec2 far = s.uv + track.parallaxMin * track.direction * g.rectSizeInv;
    if (track.parallaxMin > 1.41421 && isInScreen(far))
    {
        ivec2 pixel = clampToRect(ivec2(far * g.rectSize));
        float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
        vec3 farX = viewPosition(pixelUv(pixel), viewZ);
        if (isInRange(viewZ) && soft(planeDistance(v, farX) / (kCurvaturePlaneSensitivity * s.frustumSize)) > 0.5)
        {
            edge = farX - v.X;
            N = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(pixel), 0)).N;
        }
    }
    return curvatureFromEdge(vec3(0.0), s.guide.N, rotate(g.viewToWorld, edge), N);
}

// How far the view may turn before a lobe of this width, reflecting something at this distance, has changed.
float surfaceConfidence(Surface s, SurfaceTrack track, float roughness, float normHitDist, float motion)
{
    float angle = angleOf(track.parallaxMax * s.pixelSize / max(length(s.X), 1e-6)) * mix(0.1, 1.0, motion);
    float weight = newSampleWeight(track.n[kSpecularChannel]);
    vec2 uv = clamp(track.uv, 0.0, 1.0) * g.rectSizePrev * g.resourceSizeInvPrev;
    float history = decodeValue(textureLod(sampler2D(gIn_SpecularHistory, gLinearClamp), uv, 0.0)).w;
    float mixed = weight == 1.0 || kIsRelax ? normHitDist : mix(history, normHitDist, weight);
    float hitDist = getHitDist(mixed, s.viewZ, s.guide.roughness);
    float factor = hitDistFactor(hitDist, s.frustumSize);
    float tangent = lobeTangent(roughness, 0.75) * mix(s.NoV, 1.0, roughness) * weight / (factor + kEps);
    float allowed = max(angleOf(tangent), normalEncodingError(kNormalEncoding));
    float confidence = square(square(ramp(allowed, 0.0, angle)));
    return mix(confidence, 1.0, ramp(0.8, 0.9, roughness));
}

// Cap on the length for low roughness under responsive accumulation.
float responsiveLength(float roughness, float NoN)
{
    float response = smooth01(max(roughness, 1e-3) / max(g.responsiveRoughnessThreshold, 1e-3));
    float spread = NRD_GetLobeSpread(roughness, 0.25);
    float f = mix(spread, 1.0, response) * pow(saturate(NoN) + kEps, mix(32.0, 1.0, spread) * (1.0 - response));
    return max(g.maxAccumulatedFrameNum.y * f, g.responsiveMinFrameNum);
}

// Amount of the virtual track in [0; 1]: it wins ties, the surface must be clearly longer to win.
float virtualAmount(float nVirtual, float nSurface)
{
    return saturate(1.0 + (nVirtual - nSurface) / (1.0 + 0.5 * max(nVirtual, nSurface)));
}

// amount: of the virtual track. Between the two everything is valid, so the weights are those of the place: a track's
// own belong to its own texels.
HistoryRead mixedRead(SurfaceTrack surface, VirtualTrack image, float amount)
{
    HistoryRead read;
    read.position = clamp(mix(surface.uv, image.uv, amount), 0.0, 1.0) * g.rectSizePrev;
    read.isCubic = amount >= 0.5 ? image.isCubic : surface.isCubic;
    Footprint between = makeFootprint(read.position);
    read.origin = between.origin;
    read.weights = between.bilinear;
    if (amount > 0.0 && amount < 1.0) return read;
    read.origin = amount == 0.0 ? surface.footprint.origin : image.footprint.origin;
    read.weights = amount == 0.0 ? surface.weights : image.weights;
    return read;
}

void showVirtualAmount(ivec2 pixel, float amount)
{
    bool isShown = all(equal(pixel & (VIRTUAL_AMOUNT_STEP - 1), ivec2(VIRTUAL_AMOUNT_STEP / 2)));
    if (g.hasValidation != 0u && isShown) imageStore(gOut_VirtualAmount, pixel / VIRTUAL_AMOUNT_STEP, vec4(amount));
}

// Of both tracks: surface, virtual.
struct SpecularLengths
{
    vec2 n;
    vec2 nFix; // what the history fix is told
    vec2 trust;
};

// motion: 0 where nothing moves on screen, 1 from a quarter of a pixel on.
SpecularLengths measureLengths(Surface s, SurfaceTrack surface, VirtualTrack image, float normHitDist, float motion)
{
    float roughness = widenedRoughness(s);
    vec2 stored = vec2(surface.n[kSpecularChannel], image.n);
    vec2 n = vec2(applyConfidence(stored.x, surface.quality), applyConfidence(stored.y, image.quality));
    if (kHasConfidence)
    {
        vec2 given = vec2(textureLod(sampler2D(gIn_SpecularConfidence, gLinearClamp), surface.uv, 0.0).x,
                          textureLod(sampler2D(gIn_SpecularConfidence, gLinearClamp), image.uv, 0.0).x);
        n = min(n, vec2(applyGivenConfidence(stored.x, given.x), applyGivenConfidence(stored.y, given.y)));
    }
    vec2 responsive = vec2(responsiveLength(roughness, surface.NoN),
                           responsiveLength(roughness, image.NoN));
    SpecularLengths lengths;
    float surfaceTrust = surfaceConfidence(s, surface, roughness, normHitDist, motion) * image.stillness;
    lengths.trust = vec2(surfaceTrust, image.confidence);
    n = min(n, g.maxAccumulatedFrameNum.y * lengths.trust);
    // Responsiveness alone must not trigger the history fix, so the length that is passed on is capped more mildly.
    lengths.nFix = min(n, max(responsive, vec2(g.historyFixFrameNum)));
    lengths.n = min(n, responsive);
    return lengths;
}

// The weight of a new sample in the short history, which distrusts what neither track vouches for.
float specularFastWeight(Surface s, float n, float trust, float share)
{
    float longest = g.maxFastAccumulatedFrameNum.y;
    if (kHasMaterialTest && s.guide.materialID == g.strandMaterialID)
        longest = max(longest, g.maxAccumulatedFrameNum.y * 0.2);
    return max(1.0 - trust, newSampleWeight(min(n, longest)) * share);
}

#if IS_RELAX
// Keeps how far the reprojection is trusted for the passes that follow. No variance yet is no certainty.
Signal storeConfidence(ivec2 pixel, Signal mixed, float confidence)
{
    imageStore(gOut_Confidence, pixel, vec4(confidence));
    return mixed.value.w == 0.0 ? withVariance(mixed, g.relaxVarianceBoost * (1.0 - confidence)) : mixed;
}
#endif

// What is reflected moves without noise: unlike the surface's, none of its motion is too small to be followed.
float apparentMotion(VirtualTrack image, float motion)
{
    return max(motion, saturate(length(image.reflectedShift * g.rectSize) * 64.0));
}

LobeResult accumulateSpecular(Surface s, SurfaceTrack surface)
{
    LobeResult result;
    float hitDist = trackingDistance(s);
    float normHitDist = readHitDist(gIn_Specular, kSpecularChannel, s.pixel);
    Reflection reflection = readReflection(s, normHitDist, hitDist);
    storeTrack(s.pixel, hitDist, reflection);
    float motion = saturate(length((surface.uv - s.uv) * g.rectSize) / 0.25);
    bool isFollowed = s.guide.roughness < kNoImageRoughness || isMoving(reflection);
    VirtualTrack image = surfaceImage(surface);
    if (isFollowed) image = trackVirtual(s, surface, hitDist, motionCurvature(s, surface), reflection);
    image.stillness *= vacancyConfidence(s, reflection, surface.footprint);
    image.confidence *= vacancyConfidence(s, reflection, image.footprint);
    SpecularLengths lengths = measureLengths(s, surface, image, normHitDist, motion);

    bool isAttached = kHasMaterialTest && s.guide.materialID == g.cameraAttachedMaterialID;
    float amount = virtualAmount(lengths.n.y, lengths.n.x) * (isAttached ? 1.0 : apparentMotion(image, motion));
    if (!isFollowed) amount = 0.0;
    // A position between two different surfaces would smear.
    if (!surface.isCubic || !image.isCubic) amount = amount >= 0.5 ? 1.0 : 0.0;
    showVirtualAmount(s.pixel, amount);
    HistoryRead read = mixedRead(surface, image, amount);
    float n = mix(lengths.n.x, lengths.n.y, amount);
    result.n = mix(lengths.nFix.x, lengths.nFix.y, amount);
    History stored = readHistory(gIn_SpecularHistory, gIn_SpecularHistorySh, kSpecularChannel, read);
    Signal history = stored.signal;
    bool isValid;
    // What a mirror shows has outlines that no guide knows of.
    float calmShare = ramp(0.1, 0.3, s.guide.roughness);
    Signal signal = readAccumulated(gIn_Specular, gIn_SpecularSh, s, kSpecularChannel, calmShare, isValid);
    if (!isValid) signal = history;
    float share = dataShare(s.pixel, true, n);
    Signal mixed = mixHistory(history, signal, n, share, s.guide.roughness);
    float trust = mix(lengths.trust.x, lengths.trust.y, amount);
#if IS_RELAX
    // After a cut the textures of the last frame must not tell, not even by how little they are trusted.
    mixed = storeConfidence(s.pixel, mixed, isHistoryReset() ? 0.0 : trust);
#endif
    storeSignal(gOut_Specular, gOut_SpecularSh, s.pixel, mixed);
    float fastWeight = specularFastWeight(s, n, trust, share);
    result.fast = limitFast(mixFast(stored.fast, luma(signal), fastWeight), luma(history), n);
    result.noisy = limitFast(luma(signal), luma(history), n);
    result.stabHistory = stored.stabilized;
    float valid = mix(dot(surface.weights, vec4(1.0)), dot(image.weights, vec4(1.0)), amount);
    result.stabWeight = isHistoryReset() ? 0.0 : sqrt(saturate(valid));
    return result;
}

#endif
