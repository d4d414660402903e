// The eight-tap recurrent blur that the pre-pass, blur and post-blur share; they differ in a Kernel and in the lobe.
#ifndef SPATIAL_FILTER_GLSL
#define SPATIAL_FILTER_GLSL
#include "denoiser.glsl"

// Four taps at radius 1, four at radius 1/2 on the diagonals; .z = exp(-0.66 r^2).
const vec3 kTaps[8] = vec3[](
    vec3(-1.0, 0.0, 0.5169), vec3(0.0, 1.0, 0.5169), vec3(1.0, 0.0, 0.5169), vec3(0.0, -1.0, 0.5169),
    vec3(-0.35355, 0.35355, 0.8479), vec3(0.35355, 0.35355, 0.8479),
    vec3(0.35355, -0.35355, 0.8479), vec3(-0.35355, -0.35355, 0.8479));

struct Pixel
{
    vec2 uv;
    float viewZ;
    vec3 Xv; // view space
    vec3 Nv;
    vec3 Vv;
    float NoV;
    float frustumSize;
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
    float plane;     // 1 / world units
    float hitDist;   // 1 / normalised hit distance
    float minHitDist;
};

struct Tap
{
    ivec2 pixel;
    float viewZ;
    vec3 Xv;
    Guide guide;
    float weight; // guides only, 0 = rejected
};

Pixel makePixel(ivec2 position, float viewZ, Guide guide)
{
    Pixel p;
    p.uv = pixelUv(position);
    p.viewZ = viewZ;
    p.Xv = reconstructViewPosition(p.uv, g.frustum, viewZ, g.cameraDelta.w);
    p.Nv = guide.N * mat3(g.viewToWorld); // the inverse of a rotation
    p.Vv = g.cameraDelta.w != 0.0 ? vec3(0.0, 0.0, -1.0) : -normalize(p.Xv);
    p.NoV = abs(dot(p.Nv, p.Vv));
    p.frustumSize = getFrustumSize(viewZ);
    p.guide = guide;
    return p;
}

Weights makeWeights(Pixel p, Lobe lobe, bool isSpecular, float narrowing, float fractionScale, float minHitDist)
{
    Weights w;
    w.normal = 1.0 / (normalCutoff(lobe.roughness, narrowing) * fractionScale);
    float admissible = mix(0.01, 1.0, saturate(lobe.roughness * g.roughnessFraction * fractionScale));
    w.roughness = isSpecular ? 1.0 / admissible : 0.0;
    w.plane = 1.0 / (g.planeDistanceSensitivity * p.frustumSize);
    w.hitDist = 1.0 / narrowing;
    w.minHitDist = minHitDist;
    return w;
}

// Radius in pixels for a hit-distance factor; convergence scales the area, hence the root.
float blurRadius(Lobe lobe, float scale, float hitDistFactor, float narrowing)
{
    float spread = NRD_GetLobeSpread(lobe.roughness, 0.5);
    float radius = saturate(scale * sqrt(hitDistFactor * narrowing)) * lobe.maxRadius * spread;
    return max(radius, g.minBlurRadius * spread);
}

Tap readTap(texture2D viewZs, texture2D normals, Pixel p, Lobe lobe, Weights w, vec2 uv, float gaussian)
{
    Tap tap;
    bool isInside = isInScreen(uv);
    tap.pixel = clampToRect(ivec2(mirrorUv(uv) * g.rectSize));
    tap.viewZ = decodeViewZ(texelFetch(viewZs, guideTexel(tap.pixel), 0).x);
    tap.Xv = reconstructViewPosition(pixelUv(tap.pixel), g.frustum, tap.viewZ, g.cameraDelta.w);
    tap.guide = decodeGuide(texelFetch(normals, guideTexel(tap.pixel), 0));
    bool isAccepted = isInRange(tap.viewZ) &&
                      isSameMaterial(p.guide.materialID, tap.guide.materialID, lobe.minMaterial);
    // A folded tap keeps weight 1: at borders it stands for several that are missing.
    tap.weight = isAccepted ? (isInside ? gaussian : 1.0) : 0.0;
    tap.weight *= soft(acosApprox(dot(p.guide.N, tap.guide.N)) * w.normal);
    tap.weight *= soft(abs(tap.guide.roughness - p.guide.roughness) * w.roughness);
    tap.weight *= soft(abs(dot(p.Nv, tap.Xv - p.Xv)) * w.plane);
    return tap;
}

float hitDistWeight(Weights w, float centre, float other)
{
    // World units say nothing by themselves, so RELAX compares relative to the distances.
    float difference = abs(other - centre) / (kIsRelax ? other + centre + kEps : 1.0);
    return w.minHitDist + heavy(difference * w.hitDist);
}

vec2 rotateTap(vec4 rotator, vec2 offset) { return offset.x * rotator.xy + offset.y * rotator.zw; }

// Foreshortened disk: offsets shrink along the axis the surface is tilted about.
vec2 diffuseSkew(Pixel p)
{
    vec2 skew = mix(1.0 - abs(p.Nv.xy), vec2(1.0), p.NoV);
    return skew / max(max(skew.x, skew.y), 1e-3);
}

// Tangents, in view space, of a plane that faces the mirrored lobe axis: its footprint stretches at grazing angles.
void specularKernel(Pixel p, float hitDistFactor, float narrowing, float radius, out vec3 T, out vec3 B)
{
    float r = p.guide.roughness;
    vec3 D = dominantDirection(p.Nv, p.Vv, dominantFactor(p.NoV, r));
    float bend = sqrt(hitDistFactor);
    vec3 axis = normalize(mix(p.Nv, D, bend));
    float NoD = abs(dot(p.Nv, D));
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
    T *= size * skew;
    B *= size / skew;
}

vec2 viewToUv(vec3 Xv)
{
    vec2 slope = Xv.xy / (g.cameraDelta.w != 0.0 ? 1.0 : max(Xv.z, 1e-6)); // a tap may reach behind the camera
    return (slope - g.frustum.xy) / g.frustum.zw;
}

#endif
