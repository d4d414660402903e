// Part of nrd_frontend.glsl: include that.
//
// SIGMA: one shadow ray per pixel, from the surface to a random point of one light, packed for IN_PENUMBRA and
// IN_TRANSLUCENCY; the shadow unpacked from OUT_SHADOW_TRANSLUCENCY. Several lights may share one denoiser.
//
// hitDist: distance from the surface to the nearest hit, world units; "accept first hit" returns far ones. 0 where
// N.L <= 0 or outside a spot's cone: left alone. 65504 or more where nothing was hit before the light.
#ifndef NRD_SIGMA_GLSL
#define NRD_SIGMA_GLSL

#define SIGMA_LIT NRD_FP16_MAX    // penumbra of a miss: a flag, not a size
#define SIGMA_MIN_PENUMBRA 1e-4   // a contact must not become the 0 of N.L <= 0; half floats end at 6e-8
#define SIGMA_MAX_PENUMBRA 32768.0

float SIGMA_Luminance(vec3 color)
{
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

// NaN says nothing of an occluder; as a miss it is filtered like any sample, as 0 it would be left as it is.
bool SIGMA_IsLit(float hitDist)
{
    return NRD_IsNan(hitDist) || hitDist >= SIGMA_LIT;
}

// halfWidth: of the penumbra, not yet flagged. A light of no size or of a NaN one casts a hard shadow.
float SIGMA_FlagPenumbra(float hitDist, float halfWidth)
{
    if (SIGMA_IsLit(hitDist)) return SIGMA_LIT;
    if (hitDist <= 0.0) return 0.0;
    return NRD_IsNan(halfWidth) ? SIGMA_MIN_PENUMBRA : clamp(halfWidth, SIGMA_MIN_PENUMBRA, SIGMA_MAX_PENUMBRA);
}

// IN_PENUMBRA of the sun. tanAngularRadius: of the radius, not of the diameter.
float SIGMA_FrontEnd_PackPenumbra(float hitDist, float tanAngularRadius)
{
    return SIGMA_FlagPenumbra(hitDist, hitDist * tanAngularRadius);
}

// IN_PENUMBRA of a sphere, disc, rectangle or spot. lightSize: its diameter as seen from the surface, world units.
// Both are half of the width from lit to dark, so a far light may be packed as a sun.
float SIGMA_FrontEnd_PackPenumbra(float hitDist, float distanceToLight, float lightSize)
{
    return SIGMA_FlagPenumbra(hitDist, 0.5 * lightSize * hitDist / max(distanceToLight - hitDist, 1e-6));
}

// NaN lets nothing through.
float SIGMA_SanitizeTransmission(float x)
{
    return NRD_IsNan(x) ? 0.0 : clamp(x, 0.0, 1.0);
}

vec3 SIGMA_SanitizeTransmission(vec3 color)
{
    return vec3(SIGMA_SanitizeTransmission(color.x), SIGMA_SanitizeTransmission(color.y),
                SIGMA_SanitizeTransmission(color.z));
}

// IN_TRANSLUCENCY: (1 if nothing was hit, else 0; transmitted colour).
// translucency: linear; the product over all surfaces on the way to the light, 0 behind an opaque one.
vec4 SIGMA_FrontEnd_PackTranslucency(float hitDist, vec3 translucency)
{
    if (SIGMA_IsLit(hitDist)) return vec4(1.0, 1.0, 1.0, 1.0);
    return vec4(0.0, SIGMA_SanitizeTransmission(translucency));
}

// OUT_SHADOW_TRANSLUCENCY holds square roots: 8 bits are spent near black. Returns the visible share of the light, from
// SIGMA_SHADOW_TRANSLUCENCY with the transmitted colour in .yzw.
float SIGMA_BackEnd_UnpackShadow(float shadow)
{
    return shadow * shadow;
}

vec4 SIGMA_BackEnd_UnpackShadow(vec4 shadow)
{
    return shadow * shadow;
}

//----------------------------------------------------------------------------------------------------------------------
// Several lights in one SIGMA_SHADOW_TRANSLUCENCY: cheap, exact before filtering. The filter is as wide as the
// brightest penumbra asks, so lights whose penumbrae overlap and differ much deserve a denoiser each.
// The lit radiance of the pixel is what the lights give without shadows, times .yzw of the result.

struct SIGMA_MultiLight
{
    vec3 radiance; // without shadows
    vec3 visible;
    float penumbra; // weighted by `weight`
    float weight;
    bool isAnyLit;
};

SIGMA_MultiLight SIGMA_FrontEnd_MultiLight_Begin()
{
    SIGMA_MultiLight lights;
    lights.radiance = vec3(0.0, 0.0, 0.0);
    lights.visible = vec3(0.0, 0.0, 0.0);
    lights.penumbra = 0.0;
    lights.weight = 0.0;
    lights.isAnyLit = false;
    return lights;
}

// radiance: of the surface by this light without its shadow, >= 0; one that is not finite is left out.
// penumbra: from SIGMA_FrontEnd_PackPenumbra(). visibility: what its ray let through, 1 where it hit nothing.
void SIGMA_FrontEnd_MultiLight_Add(inout SIGMA_MultiLight lights, vec3 radiance, float penumbra, vec3 visibility)
{
    float luminance = SIGMA_Luminance(radiance);
    if (!NRD_IsRadianceFinite(radiance) || !(luminance > 0.0)) return;
    bool isLit = SIGMA_IsLit(penumbra);
    lights.radiance += radiance;
    lights.visible += radiance * (isLit ? vec3(1.0, 1.0, 1.0) : SIGMA_SanitizeTransmission(visibility));
    lights.isAnyLit = lights.isAnyLit || isLit;
    // Flags have no size, so only hits count in the mean.
    float weight = !isLit && penumbra > 0.0 ? luminance : 0.0;
    lights.weight += weight;
    lights.penumbra += weight > 0.0 ? weight * penumbra : 0.0;
}

// A channel without light has no share of its own; that of the whole keeps it from darkening the luminance.
float SIGMA_VisibleShare(float visible, float radiance, float otherwise)
{
    return radiance > NRD_LUMA_EPS ? clamp(visible / radiance, 0.0, 1.0) : otherwise;
}

// Returns IN_PENUMBRA: lit where every light is that reaches the surface, 0 where none does.
float SIGMA_FrontEnd_MultiLight_End(SIGMA_MultiLight lights, out vec4 translucency)
{
    float share = clamp(SIGMA_Luminance(lights.visible) / max(SIGMA_Luminance(lights.radiance), 1e-30), 0.0, 1.0);
    vec3 color = vec3(SIGMA_VisibleShare(lights.visible.x, lights.radiance.x, share),
                      SIGMA_VisibleShare(lights.visible.y, lights.radiance.y, share),
                      SIGMA_VisibleShare(lights.visible.z, lights.radiance.z, share));
    translucency = vec4(SIGMA_Luminance(color), color);
    if (lights.weight > 0.0) return lights.penumbra / lights.weight;
    return lights.isAnyLit ? SIGMA_LIT : 0.0;
}

#endif
