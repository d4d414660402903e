// Part of nrd_frontend.glsl: include that.
//
// Darkening for parallax or baked cavities: how much of the lobe's light the opening of the cavity lets in. Two cones,
// the opening about the normal and the light about its direction; Oat and Sander 2007, "Ambient Aperture Lighting".
#ifndef NRD_CAVITY_GLSL
#define NRD_CAVITY_GLSL

#define NRD_CAVITY_LIGHT_COS 0.707 // 45 degrees
#define NRD_CAVITY_STRENGTH 0.85

// Within 0.01 rad.
float NRD_AcosApprox(float x)
{
    float a = clamp(abs(x), 0.0, 1.0);
    float positive = (0.5 * NRD_PI - 0.156583 * a) * sqrt(1.0 - a);
    return x < 0.0 ? NRD_PI - positive : positive;
}

// Solid angle, over 2 pi, of the intersection of two cones given by the cosines of their half angles.
float NRD_IntersectCones(float cosA, float cosB, float cosBetween)
{
    float rA = NRD_AcosApprox(cosA);
    float rB = NRD_AcosApprox(cosB);
    float t = NRD_AcosApprox(cosBetween);
    // 1e-6: a closed opening has no radius to divide by.
    float s = 1.0 - clamp((t - abs(rA - rB)) / max(2.0 * min(rA, rB), 1e-6), 0.0, 1.0);
    return s * s * (3.0 - 2.0 * s) * (1.0 - max(cosA, cosB));
}

// cavity: [0; 1], 0 open to the hemisphere, 1 closed. lightCos: of the light cone's half angle, below 1.
float NRD_SG_CavityShadow(NRD_SG sg, vec3 normal, float cavity, float lightCos, float strength)
{
    vec3 L = NRD_SG_ExtractDirection(sg);
    if (dot(L, L) == 0.0) return 1.0;
    float openingCos = sqrt(clamp(cavity, 0.0, 1.0));
    float visible = NRD_IntersectCones(openingCos, lightCos, dot(normal, L));
    return mix(1.0, clamp(visible / max(1.0 - lightCos, 1e-6), 0.0, 1.0), strength);
}

// Multiply the resolved lobe by it.
float NRD_SG_CavityShadow(NRD_SG sg, vec3 normal, float cavity)
{
    return NRD_SG_CavityShadow(sg, normal, cavity, NRD_CAVITY_LIGHT_COS, NRD_CAVITY_STRENGTH);
}

#endif
