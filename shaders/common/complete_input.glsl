// What an application may leave out of a pixel: hit distances of a lobe that was not chosen, and every second pixel of
// a checkerboard. Needs gIn_ViewZ and gIn_NormalRoughness.
#ifndef COMPLETE_INPUT_GLSL
#define COMPLETE_INPUT_GLSL

struct Centre
{
    ivec2 pixel;
    Signal signal;
    float hitDist; // normalised; reconstructed where the pixel has none, 0 if that failed
    bool isValid;  // false: the pixel takes no part in sums
    bool isFound;  // by the pixel, or by the neighbours that a checkerboard gives it
};

// Mean of the left and right neighbours, which have data where a pixel has none, as far as they lie as deep.
Signal resolveCheckerboard(texture2D t, texture2D second, Pixel p, ivec2 pixel, out bool isFound)
{
    Signal sum = kNoSignal;
    float weightSum = 0.0;
    for (int i = -1; i <= 1; i += 2)
    {
        ivec2 neighbour = pixel + ivec2(i, 0);
        if (clampToRect(neighbour) != neighbour) continue;
        float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(neighbour), 0).x);
        bool isValid;
        Signal value = readInput(t, second, inputTexel(neighbour), isValid);
        bool isNear = abs(viewZ - p.viewZ) <= p.frustumSize * saturate(0.02 / max(0.05, p.NoV));
        if (!isValid || !isInRange(viewZ) || !isNear) continue;
        sum = addWeighted(sum, value, 1.0);
        weightSum += 1.0;
    }
    isFound = weightSum > 0.0;
    return isFound ? scaled(sum, 1.0 / weightSum) : kNoSignal;
}

// Long-tailed weights but for the plane, so as not to lose the only sample of the window.
float reconstructionWeight(Pixel p, Lobe lobe, bool isSpecular, ivec2 pixel, vec2 offset)
{
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
    if (!isInRange(viewZ)) return 0.0;
    Guide guide = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(pixel), 0));
    float angle = max(atan(lobeTangent(lobe.roughness, 0.75)), normalEncodingError(kNormalEncoding));
    float weight = exp(-0.66 * 0.25 * dot(offset, offset));
    weight *= heavy(angleBetween(p.guide.N, guide.N) / angle);
    weight *= soft(planeDistance(p.plane, vec2(pixel), viewZ));
    float m = square(p.guide.roughness);
    if (isSpecular) weight *= heavy(abs(square(guide.roughness) - m) / mix(0.01, 1.0, m));
    return weight;
}

// Radiance needs no reconstruction: it is divided by the probability of its lobe, so its expectation is right. .xyz is
// of use where the hit distance lengthens a direction.
vec4 reconstructHitDist(texture2D t, texture2D second, Pixel p, Lobe lobe, bool isSpecular, ivec2 position)
{
    vec4 sum = vec4(0.0);
    float weightSum = 0.0;
    int size = 2 * g.reconstructionRadius + 1;
    for (int i = 0; i < size * size; i++)
    {
        ivec2 offset = ivec2(i % size, i / size) - g.reconstructionRadius;
        ivec2 pixel = position + offset;
        if (clampToRect(pixel) != pixel || !hasData(pixel, isSpecular)) continue;
        bool isValid;
        vec4 value = sanitize(texelFetch(t, inputTexel(pixel), 0), isValid);
        if (!(value.w > 0.0)) continue;
        float weight = reconstructionWeight(p, lobe, isSpecular, pixel, vec2(offset));
        sum += value * weight;
        weightSum += weight;
    }
    return weightSum > 0.0 ? sum / weightSum : vec4(0.0);
}

Centre completeCentre(texture2D t, texture2D second, Pixel p, Lobe lobe, bool isSpecular, ivec2 position)
{
    Centre centre;
    centre.pixel = position;
    bool isHere = hasData(position, isSpecular);
    if (isHere)
    {
        centre.signal = readInput(t, second, inputTexel(position), centre.isValid);
        centre.isFound = centre.isValid;
    }
    else
    {
        centre.signal = resolveCheckerboard(t, second, p, position, centre.isFound);
        centre.isValid = kIsBounded && centre.signal.value.w > 0.0; // no blur follows that would find more
    }
    centre.hitDist = centre.signal.value.w;
    if (centre.hitDist == 0.0 && g.reconstructionRadius > 0)
    {
        vec4 filled = reconstructHitDist(t, second, p, lobe, isSpecular, position);
        centre.hitDist = filled.w;
        if (kIsDirectional) centre.signal.value.xyz = filled.xyz;
    }
    return centre;
}

// Taps land on pixels that have data: a step to the left or right, by turns.
vec2 snapToData(vec2 position, bool isSpecular, int tap, out bool isInside)
{
    isInside = true;
    if (g.checkerboard == CHECKERBOARD_OFF) return position;
    ivec2 pixel = foldedPlace(placeAt(position)).texel;
    if (!hasData(pixel, isSpecular)) pixel.x += (tap & 1) == 0 ? 1 : -1;
    isInside = clampToRect(pixel) == pixel;
    return vec2(pixel);
}

#endif
