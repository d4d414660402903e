// The eight-tap recurrent blur that the pre-pass, blur and post-blur share; they differ in a Kernel and in the lobe.
#ifndef SPATIAL_FILTER_GLSL
#define SPATIAL_FILTER_GLSL
#include "plane.glsl"

// Four taps at radius 1, four at radius 1/2 on the diagonals; .z = exp(-0.66 r^2).
const vec3 kTaps[8] = vec3[](
    vec3(-1.0, 0.0, 0.5169), vec3(0.0, 1.0, 0.5169), vec3(1.0, 0.0, 0.5169), vec3(0.0, -1.0, 0.5169),
    vec3(-0.35355, 0.35355, 0.8479), vec3(0.35355, 0.35355, 0.8479),
    vec3(0.35355, -0.35355, 0.8479), vec3(-0.35355, -0.35355, 0.8479));

struct Pixel
{
    vec2 position; // pixels; centres of pixels are whole numbers
    vec2 uv;
    float viewZ;
    vec3 Xv; // view space
    vec3 Nv;
    vec3 Vv;
    float NoV;
    float frustumSize;
    Plane plane; // the unit is what lies too far off it
    Guide guide;
};

struct Lobe
{
    float roughness; // 1 for diffuse
    uint minMaterial;
    float maxRadius; // pixels
};

// What turns differences between the centre and a tap into weights.
struct Weights
{
    float normal;    // 1 / radians
    float roughness; // 1 / roughness, 0 for diffuse
    float hitDist;   // 1 / normalised hit distance
    float minHitDist;
};

struct Tap
{
    vec2 position; // pixels
    ivec2 pixel;
    float viewZ;
    Guide guide;
    float weight; // guides only, 0 = rejected
};

Pixel makePixel(ivec2 position, float viewZ, Guide guide)
{
    Pixel p;
    p.position = vec2(position);
    p.uv = pixelUv(position);
    p.viewZ = viewZ;
    p.Xv = reconstructViewPosition(p.uv, g.frustum, viewZ, g.cameraDelta.w);
    p.Nv = guide.N * mat3(g.viewToWorld); // the inverse of a rotation
    p.Vv = g.cameraDelta.w != 0.0 ? vec3(0.0, 0.0, -1.0) : -normalize(p.Xv);
    p.NoV = abs(dot(p.Nv, p.Vv));
    p.frustumSize = getFrustumSize(viewZ);
    p.guide = guide;
    p.plane = makePlane(p.Nv, p.Xv, g.planeDistanceSensitivity * p.frustumSize);
    return p;
}

Weights makeWeights(Pixel p, Lobe lobe, bool isSpecular, float narrowing, float fractionScale, float minHitDist)
{
    Weights w;
    w.normal = 1.0 / (normalCutoff(lobe.roughness, narrowing) * fractionScale);
    float admissible = mix(0.01, 1.0, saturate(lobe.roughness * g.roughnessFraction * fractionScale));
    w.roughness = isSpecular ? 1.0 / admissible : 0.0;
    w.hitDist = 1.0 / narrowing;
    w.minHitDist = minHitDist;
    return w;
}

// Radius in pixels for a hit-distance factor; convergence scales the area, hence the root.
float blurRadius(Lobe lobe, float hitDistFactor, float narrowing)
{
    float spread = NRD_GetLobeSpread(lobe.roughness, 0.5);
    float radius = saturate(sqrt(hitDistFactor * narrowing)) * lobe.maxRadius * spread;
    return max(radius, g.minBlurRadius * spread);
}

// 1.5 * 2^23: added to a number, the last bit of its mantissa counts ones. Conversions and floor() run at a fraction
// of the rate of additions, and a blur has dozens.
const float kOnes = 12582912.0;

// A pixel, given by any position in it.
struct Place
{
    vec2 position; // whole
    ivec2 texel;
};

Place placeAt(vec2 position)
{
    precise vec2 ones = position + kOnes;
    precise vec2 whole = ones - kOnes;
    return Place(whole, ivec2(floatBitsToUint(ones) - floatBitsToUint(kOnes)));
}

// Folds what lies outside the screen back once, so that kernels at borders do not starve.
Place foldedPlace(Place place)
{
    vec2 position = max(place.position, -1.0 - place.position);
    position = max(min(position, 2.0 * g.rectSize - 1.0 - position), 0.0);
    ivec2 texel = placeAt(position).texel;
    return Place(position, ivec2(min(uvec2(texel), uvec2(g.rectSizeMinusOne)))); // NaN stays inside
}

vec3 viewPosition(Tap tap)
{
    vec2 uv = (tap.position + 0.5) * g.rectSizeInv;
    return reconstructViewPosition(uv, g.frustum, tap.viewZ, g.cameraDelta.w);
}

// position: pixels. mayFold: it may lie outside the screen.
Tap readTap(texture2D viewZs, texture2D normals, Pixel p, Lobe lobe, bool isSpecular, Weights w, vec2 position,
            float gaussian, bool mayFold)
{
    Place given = placeAt(position), place = given;
    if (mayFold) place = foldedPlace(given);
    Tap tap;
    tap.position = place.position;
    tap.pixel = place.texel;
    tap.viewZ = decodeViewZ(texelFetch(viewZs, guideTexel(tap.pixel), 0).x);
    tap.guide = decodeGuide(texelFetch(normals, guideTexel(tap.pixel), 0));
    bool isAccepted = isInRange(tap.viewZ) &&
                      isSameMaterial(p.guide.materialID, tap.guide.materialID, lobe.minMaterial);
    // A folded tap keeps weight 1: at borders it stands for several that are missing.
    if (mayFold && given.position != place.position) gaussian = 1.0;
    float root = softRoot(squaredAngleBetween(p.guide.N, tap.guide.N) * square(w.normal));
    root *= softRoot(square(planeDistance(p.plane, tap.position, tap.viewZ)));
    if (isSpecular) root *= softRoot(square((tap.guide.roughness - p.guide.roughness) * w.roughness));
    tap.weight = isAccepted ? gaussian * square(root) : 0.0;
    return tap;
}

float hitDistWeight(Weights w, float centre, float other)
{
    // World units say nothing by themselves, so RELAX compares relative to the distances.
    float difference = abs(other - centre) / (kIsRelax ? other + centre + kEps : 1.0);
    return w.minHitDist + heavy(difference * w.hitDist);
}

vec2 rotateTap(vec4 rotator, vec2 offset) { return offset.x * rotator.xy + offset.y * rotator.zw; }

// Where the taps lie, in homogeneous pixels.
struct Kernel
{
    vec3 centre;
    vec3 axes[4]; // to taps 2, 1, 5, 4; the others lie opposite
    bool isFlat;  // parallel to the screen
};

const int kTapAxes[8] = int[](0, 1, 0, 1, 3, 2, 3, 2);
const float kTapSigns[8] = float[](-1.0, 1.0, 1.0, -1.0, 1.0, 1.0, -1.0, -1.0);

// u, v: where (1, 0) and (0, 1) of the taps lie, before they are rotated.
Kernel makeKernel(vec3 centre, vec3 u, vec3 v, vec4 rotator, bool isFlat)
{
    vec3 right = u * rotator.x + v * rotator.y, up = u * rotator.z + v * rotator.w;
    float half_ = kTaps[5].x;
    return Kernel(centre, vec3[](right, up, (up + right) * half_, (up - right) * half_), isFlat);
}

Kernel flatKernel(Pixel p, vec4 rotator, vec2 radius)
{
    return makeKernel(vec3(p.position, 1.0), vec3(radius.x, 0.0, 0.0), vec3(0.0, radius.y, 0.0), rotator, true);
}

vec2 tapPosition(Kernel kernel, int tap)
{
    vec3 position = kernel.centre + kernel.axes[kTapAxes[tap]] * kTapSigns[tap];
    return kernel.isFlat ? position.xy : position.xy / max(position.z, 1e-6); // a tap may reach behind the camera
}

bool isOnScreen(vec2 position)
{
    return all(bvec4(greaterThanEqual(position, vec2(0.0)), lessThanEqual(position, g.rectSize - 1.0)));
}

// All taps, of which the inner ones lie between the outer ones. False for NaN. Without the branches of &&.
bool isOnScreen(Kernel kernel)
{
    bool isInFront = kernel.centre.z - max(abs(kernel.axes[0].z), abs(kernel.axes[1].z)) > 1e-6;
    bvec4 areOnScreen = bvec4(isOnScreen(tapPosition(kernel, 0)), isOnScreen(tapPosition(kernel, 1)),
                              isOnScreen(tapPosition(kernel, 2)), isOnScreen(tapPosition(kernel, 3)));
    return all(areOnScreen) && (kernel.isFlat || isInFront);
}

// Foreshortened disk: offsets shrink along the axis the surface is tilted about.
vec2 diffuseSkew(Pixel p)
{
    vec2 skew = mix(1.0 - abs(p.Nv.xy), vec2(1.0), p.NoV);
    return skew / max(max(skew.x, skew.y), 1e-3);
}

// View space to homogeneous pixels: a point, or a direction.
vec3 toPixels(vec3 v, float isPoint)
{
    float depth = g.cameraDelta.w != 0.0 ? isPoint : v.z;
    return vec3((v.xy - g.frustum.xy * depth) * (g.rectSize / g.frustum.zw) - 0.5 * depth, depth);
}

// In a plane that faces the mirrored lobe axis: the footprint stretches at grazing angles.
Kernel specularKernel(Pixel p, vec4 rotator, float hitDistFactor, float narrowing, float radius)
{
    float r = p.guide.roughness;
    vec3 D = dominantDirection(p.Nv, p.Vv, dominantFactor(p.NoV, r));
    float bend = sqrt(hitDistFactor);
    vec3 axis = normalize(mix(p.Nv, D, bend));
    float NoD = abs(dot(p.Nv, D));
    vec3 T, B;
    if (abs(dot(axis, p.Nv)) < 0.999)
    {
        vec3 mirrored = reflect(-axis, p.Nv);
        T = normalize(cross(p.Nv, mirrored));
        B = cross(mirrored, T);
    }
    else
        tangentBasis(p.Nv, T, B);
    float skew = mix(0.25 + 0.75 * r, 1.0, NoD);
    skew = mix(1.0, mix(skew, 1.0, narrowing), bend);
    float size = radius * getPixelSize(p.viewZ);
    return makeKernel(toPixels(p.Xv, 1.0), toPixels(T * size * skew, 0.0), toPixels(B * size / skew, 0.0), rotator,
                      false);
}

#endif
