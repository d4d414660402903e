// What an application's own shaders need: packing of the guides and noisy signals, unpacking of the results. The one
// file to include; it brings the others of this folder. No bindings, no globals, nothing that belongs to a stage.
// GLSL needs GL_GOOGLE_include_directive. HLSL works by the keyword map below (FXC: define __HLSL_VERSION yourself).
//
// Define before including, if the instance was not created with the defaults:
//   NRD_NORMAL_ENCODING     value of nrd::NormalEncoding, default 2 (R10_G10_B10_A2_UNORM)
//   NRD_ROUGHNESS_ENCODING  value of nrd::RoughnessEncoding, default 1 (LINEAR)
//
// Roughness is linear (perceptual) everywhere; its square is GGX alpha. Directions are unit, in world space.
#ifndef NRD_FRONTEND_GLSL
#define NRD_FRONTEND_GLSL

#ifdef __HLSL_VERSION
#define ivec2 int2
#define vec2 float2
#define vec3 float3
#define vec4 float4
#define mat3 float3x3
#define mix lerp
#define inversesqrt rsqrt
#define floatBitsToUint asuint
#define NRD_MUL(matrix3, v) mul(matrix3, v)
#else
#define NRD_MUL(matrix3, v) ((matrix3) * (v))
#endif

#ifndef NRD_NORMAL_ENCODING
#define NRD_NORMAL_ENCODING 2
#endif
#ifndef NRD_ROUGHNESS_ENCODING
#define NRD_ROUGHNESS_ENCODING 1
#endif

#define NRD_NORMAL_RGBA8_UNORM 0
#define NRD_NORMAL_RGBA8_SNORM 1
#define NRD_NORMAL_R10G10B10A2_UNORM 2
#define NRD_NORMAL_RGBA16_UNORM 3
#define NRD_NORMAL_RGBA16_SNORM 4
#define NRD_ROUGHNESS_SQ_LINEAR 0
#define NRD_ROUGHNESS_LINEAR 1
#define NRD_ROUGHNESS_SQRT_LINEAR 2

#define NRD_FP16_MAX 65504.0
#define NRD_LUMA_EPS 1e-6
// The sign of normal.z rides on the encoded roughness, which therefore never reaches the middle of the 10-bit range.
#define NRD_MIN_ENCODED_ROUGHNESS (1.5 / 512.0)

//----------------------------------------------------------------------------------------------------------------------
// Helpers

// A compiler may assume that NaN does not occur, so the bits are looked at: exponent all ones is NaN or infinity.
bool NRD_IsFinite(float x)
{
    return (floatBitsToUint(x) & 0x7F800000u) != 0x7F800000u;
}

// NaN only: an infinite hit distance is a miss, not an error.
bool NRD_IsNan(float x)
{
    return (floatBitsToUint(x) & 0x7FFFFFFFu) > 0x7F800000u;
}

// Zero for a zero vector (no direction known), where normalize() is undefined. 1e-30: smaller squares are denormal.
vec3 NRD_NormalizeOrZero(vec3 v)
{
    float squared = dot(v, v);
    return squared > 1e-30 ? v * inversesqrt(squared) : vec3(0.0, 0.0, 0.0);
}

// For sums over several paths: drop a path whose radiance is not finite, not the mean.
bool NRD_IsRadianceFinite(vec3 radiance)
{
    return NRD_IsFinite(radiance.x) && NRD_IsFinite(radiance.y) && NRD_IsFinite(radiance.z);
}

// YCoCg: luma is one channel, the transform is exactly invertible with cheap constants.
vec3 NRD_LinearToYCoCg(vec3 color)
{
    float y = 0.25 * color.x + 0.5 * color.y + 0.25 * color.z;
    return vec3(y, 0.5 * (color.x - color.z), 0.5 * color.y - 0.25 * (color.x + color.z));
}

// Clamped to non-negative values.
vec3 NRD_YCoCgToLinear(vec3 color)
{
    float t = color.x - color.z;
    return max(vec3(t + color.y, color.x + color.z, t - color.y), vec3(0.0, 0.0, 0.0));
}

// (1 - 2^(-200 r^2)) * r^p: 0 for mirrors, rises fast, 1 at r = 1.
float NRD_GetLobeSpread(float roughness, float p)
{
    float r = clamp(roughness, 0.0, 1.0);
    return r > 0.0 ? (1.0 - exp2(-200.0 * r * r)) * pow(r, p) : 0.0;
}

//----------------------------------------------------------------------------------------------------------------------
// Normal and roughness

float NRD_EncodeRoughness(float roughness, int roughnessEncoding)
{
    float r = clamp(roughness, 0.0, 1.0);
    if (roughnessEncoding == NRD_ROUGHNESS_SQ_LINEAR) return r * r;
    return roughnessEncoding == NRD_ROUGHNESS_SQRT_LINEAR ? sqrt(r) : r;
}

float NRD_DecodeRoughness(float encoded, int roughnessEncoding)
{
    if (roughnessEncoding == NRD_ROUGHNESS_SQ_LINEAR) return sqrt(clamp(encoded, 0.0, 1.0));
    return roughnessEncoding == NRD_ROUGHNESS_SQRT_LINEAR ? encoded * encoded : encoded;
}

// normal: world space, any length > 0. materialID: [0; 3], stored by the 10-bit encoding only.
vec4 NRD_PackNormalAndRoughness(vec3 normal, float roughness, float materialID, int normalEncoding,
                                int roughnessEncoding)
{
    float r = NRD_EncodeRoughness(roughness, roughnessEncoding);
    if (normalEncoding == NRD_NORMAL_R10G10B10A2_UNORM)
    {
        // Octahedral diamond turned by 45 degrees to fill the square; max() guards a zero normal.
        vec3 n = normal / max(abs(normal.x) + abs(normal.y) + abs(normal.z), 1e-15);
        float signedRoughness = max(r, NRD_MIN_ENCODED_ROUGHNESS) * (n.z < 0.0 ? -1.0 : 1.0);
        return vec4(0.5 * (n.x + n.y) + 0.5, 0.5 * (n.y - n.x) + 0.5, 0.5 * signedRoughness + 0.5,
                    clamp(materialID / 3.0, 0.0, 1.0));
    }
    // Dividing by the largest component uses the whole volume of the cube.
    vec3 b = normal / max(max(abs(normal.x), max(abs(normal.y), abs(normal.z))), 1e-15);
    bool isSigned = normalEncoding == NRD_NORMAL_RGBA8_SNORM || normalEncoding == NRD_NORMAL_RGBA16_SNORM;
    return vec4(isSigned ? b : 0.5 * b + 0.5, r);
}

// Returns (unit normal, roughness); materialID is 0 where the encoding carries none.
vec4 NRD_UnpackNormalAndRoughness(vec4 packed, int normalEncoding, int roughnessEncoding, out float materialID)
{
    vec3 n;
    float r;
    materialID = 0.0;
    if (normalEncoding == NRD_NORMAL_R10G10B10A2_UNORM)
    {
        float t = 2.0 * packed.z - 1.0;
        n.x = packed.x - packed.y;
        n.y = packed.x + packed.y - 1.0;
        n.z = (1.0 - abs(n.x) - abs(n.y)) * (t < 0.0 ? -1.0 : 1.0);
        r = abs(t);
        materialID = floor(packed.w * 3.0 + 0.5);
    }
    else
    {
        bool isSigned = normalEncoding == NRD_NORMAL_RGBA8_SNORM || normalEncoding == NRD_NORMAL_RGBA16_SNORM;
        n = isSigned ? packed.xyz : 2.0 * packed.xyz - 1.0;
        r = packed.w;
    }
    // 1e-9: an all-zero texel decodes to a zero normal, not to NaN.
    return vec4(n * inversesqrt(dot(n, n) + 1e-9), NRD_DecodeRoughness(r, roughnessEncoding));
}

// IN_NORMAL_ROUGHNESS
vec4 NRD_FrontEnd_PackNormalAndRoughness(vec3 normal, float roughness, float materialID)
{
    return NRD_PackNormalAndRoughness(normal, roughness, materialID, NRD_NORMAL_ENCODING, NRD_ROUGHNESS_ENCODING);
}

vec4 NRD_FrontEnd_PackNormalAndRoughness(vec3 normal, float roughness)
{
    return NRD_FrontEnd_PackNormalAndRoughness(normal, roughness, 0.0);
}

vec4 NRD_FrontEnd_UnpackNormalAndRoughness(vec4 packed, out float materialID)
{
    return NRD_UnpackNormalAndRoughness(packed, NRD_NORMAL_ENCODING, NRD_ROUGHNESS_ENCODING, materialID);
}

vec4 NRD_FrontEnd_UnpackNormalAndRoughness(vec4 packed)
{
    float materialID;
    return NRD_FrontEnd_UnpackNormalAndRoughness(packed, materialID);
}

//----------------------------------------------------------------------------------------------------------------------
// Hit distance

// Several diffuse paths: the mean over those that are diffuse. Several specular paths: the nearest non-zero one, found
// by these three, since tracking must see the nearest reflected surface.
float NRD_FrontEnd_SpecHitDistAveraging_Begin()
{
    return 3.402823466e+38;
}

void NRD_FrontEnd_SpecHitDistAveraging_Add(inout float accumulated, float hitDist)
{
    // 1e30: an infinite miss stays below what Begin() returned, which means that nothing came. NaN is skipped.
    accumulated = hitDist > 0.0 && !NRD_IsNan(hitDist) ? min(accumulated, min(hitDist, 1e30)) : accumulated;
}

void NRD_FrontEnd_SpecHitDistAveraging_End(inout float accumulated)
{
    accumulated = accumulated == 3.402823466e+38 ? 0.0 : accumulated;
}

// Ray offsets turn "inside the surface" into tiny positive distances; below the threshold they become "none".
float NRD_FrontEnd_TrimHitDistance(float hitDist, float threshold)
{
    return hitDist >= threshold && !NRD_IsNan(hitDist) ? hitDist : 0.0;
}

// (A + |viewZ| B) mix(C, 1, spread(roughness)); parameters: A, B, C of ReblurSettings::hitDistanceParameters.
float REBLUR_GetHitDistanceNormalization(float viewZ, vec3 parameters, float roughness)
{
    return (parameters.x + abs(viewZ) * parameters.y) * mix(parameters.z, 1.0, NRD_GetLobeSpread(roughness, 0.5));
}

// hitDist: distance from the primary surface to the first bounce's hit, world units; 0 = this lobe has no sample.
// roughness: 1 for diffuse.
float REBLUR_FrontEnd_GetNormHitDist(float hitDist, float viewZ, vec3 parameters, float roughness)
{
    float n = hitDist / max(REBLUR_GetHitDistanceNormalization(viewZ, parameters, roughness), 1e-15);
    return NRD_IsNan(n) ? 0.0 : clamp(n, 0.0, 1.0); // clamp() of NaN is undefined
}

float REBLUR_GetHitDist(float normHitDist, float viewZ, vec3 parameters, float roughness)
{
    return normHitDist * REBLUR_GetHitDistanceNormalization(viewZ, parameters, roughness);
}

//----------------------------------------------------------------------------------------------------------------------
// REBLUR: IN_DIFF_RADIANCE_HITDIST, IN_SPEC_RADIANCE_HITDIST

// radiance: demodulated, linear, [0; 65504], unexposed. sanitize: non-finite input becomes "no sample".
vec4 REBLUR_FrontEnd_PackRadianceAndNormHitDist(vec3 radiance, float normHitDist, bool sanitize)
{
    if (sanitize)
    {
        bool isValid = NRD_IsRadianceFinite(radiance) && NRD_IsFinite(normHitDist);
        radiance = isValid ? clamp(radiance, 0.0, NRD_FP16_MAX) : vec3(0.0, 0.0, 0.0);
        normHitDist = isValid ? clamp(normHitDist, 0.0, 1.0) : 0.0;
    }
    return vec4(NRD_LinearToYCoCg(radiance), normHitDist);
}

// Not finite becomes "no direction". Clamped: a longer vector times the largest luma overflows half floats.
vec3 NRD_SanitizeDirection(vec3 direction, bool sanitize)
{
    if (!sanitize) return direction;
    return NRD_IsRadianceFinite(direction) ? clamp(direction, -1.0, 1.0) : vec3(0.0, 0.0, 0.0);
}

// Returns (linear radiance, normalised hit distance or history length): OUT_DIFF_RADIANCE_HITDIST,
// OUT_SPEC_RADIANCE_HITDIST. What the ..._SH and directional denoisers return is unpacked in nrd_resolve.glsl.
vec4 REBLUR_BackEnd_UnpackRadianceAndNormHitDist(vec4 data)
{
    return vec4(NRD_YCoCgToLinear(data.xyz), data.w);
}

// IN_DIFF_SH0, IN_SPEC_SH0; sh1 is IN_DIFF_SH1, IN_SPEC_SH1.
// direction: world space, of the first bounce's ray, unit; several paths of the lobe: their mean, then shorter.
vec4 REBLUR_FrontEnd_PackSh(vec3 radiance, float normHitDist, vec3 direction, out vec4 sh1, bool sanitize)
{
    vec4 sh0 = REBLUR_FrontEnd_PackRadianceAndNormHitDist(radiance, normHitDist, sanitize);
    sh1 = vec4(NRD_SanitizeDirection(direction, sanitize) * sh0.x, 0.0);
    return sh0;
}

// IN_DIFF_DIRECTION_HITDIST: ambient occlusion and the bent direction it came from.
vec4 REBLUR_FrontEnd_PackDirectionalOcclusion(vec3 direction, float normHitDist, bool sanitize)
{
    if (sanitize) normHitDist = NRD_IsFinite(normHitDist) ? clamp(normHitDist, 0.0, 1.0) : 0.0;
    return vec4(NRD_SanitizeDirection(direction, sanitize) * normHitDist, normHitDist);
}

//----------------------------------------------------------------------------------------------------------------------
// RELAX: the same slots, but linear RGB and world units

// As half floats hold it: a miss may be any large value, infinity too. NaN becomes "no sample".
float RELAX_FrontEnd_GetHitDist(float hitDist)
{
    return NRD_IsNan(hitDist) ? 0.0 : clamp(hitDist, 0.0, NRD_FP16_MAX);
}

// IN_DIFF_RADIANCE_HITDIST, IN_SPEC_RADIANCE_HITDIST
// radiance: as for REBLUR. hitDist: as for REBLUR_FrontEnd_GetNormHitDist.
vec4 RELAX_FrontEnd_PackRadianceAndHitDist(vec3 radiance, float hitDist, bool sanitize)
{
    if (sanitize)
    {
        bool isValid = NRD_IsRadianceFinite(radiance) && !NRD_IsNan(hitDist);
        radiance = isValid ? clamp(radiance, 0.0, NRD_FP16_MAX) : vec3(0.0, 0.0, 0.0);
        hitDist = isValid ? hitDist : 0.0;
    }
    return vec4(radiance, RELAX_FrontEnd_GetHitDist(hitDist));
}

// Returns IN_DIFF_SH0, IN_SPEC_SH0; sh1 is IN_DIFF_SH1, IN_SPEC_SH1. direction: as for REBLUR.
// Scaled by the luma that OUT_x_SH0 has, so that |sh1| over luma is the mean cosine there.
vec4 RELAX_FrontEnd_PackSh(vec3 radiance, float hitDist, vec3 direction, out vec4 sh1, bool sanitize)
{
    vec4 sh0 = RELAX_FrontEnd_PackRadianceAndHitDist(radiance, hitDist, sanitize);
    sh1 = vec4(NRD_SanitizeDirection(direction, sanitize) * NRD_LinearToYCoCg(sh0.xyz).x, 0.0);
    return sh0;
}

// OUT_DIFF_RADIANCE_HITDIST, OUT_SPEC_RADIANCE_HITDIST: (linear radiance, history length in frames).
vec4 RELAX_BackEnd_UnpackRadiance(vec4 data)
{
    return data;
}

//----------------------------------------------------------------------------------------------------------------------
// Material demodulation

// Pre-integrated GGX: Ray Tracing Gems, chapter 32, equation 4. GLSL matrices are columns; rows are written as dot().
vec3 NRD_EnvironmentTerm(vec3 F0, float NoV, float roughness)
{
    float m = roughness * roughness;
    float v = NoV;
    vec2 m1 = vec2(1.0, m);
    vec3 m3 = vec3(1.0, m, m * m * m);
    vec2 v1 = vec2(1.0, v);
    vec3 v3 = vec3(1.0, v, v * v * v);
    vec3 v2 = vec3(1.0, v * v, v * v * v);
    float aNum = dot(m1, vec2(dot(vec2(0.99044, -1.28514), v1), dot(vec2(1.29678, -0.755907), v1)));
    float aDen = dot(m3, vec3(dot(vec3(1.0, 2.92338, 59.4188), v3), dot(vec3(20.3225, -27.0302, 222.592), v3),
                              dot(vec3(121.563, 626.13, 316.627), v3)));
    float bNum = dot(m1, vec2(dot(vec2(0.0365463, 3.32707), v1), dot(vec2(9.0632, -9.04756), v1)));
    float bDen = dot(m3, vec3(dot(vec3(1.0, 3.59685, -1.36772), v2), dot(vec3(9.04401, -16.3174, 9.22949), v2),
                              dot(vec3(5.56589, 19.7886, -20.2123), v2)));
    float a = aNum / max(aDen, 1e-6);
    float b = bNum / max(bDen, 1e-6);
    return clamp(F0 * b + vec3(a, a, a), 0.0, 1.0);
}

// What to divide the noisy signals by before packing, and to multiply with after unpacking. The floor of 0.02 keeps
// black albedo from creating infinite radiance.
void NRD_MaterialFactors(vec3 normal, vec3 view, vec3 albedo, vec3 F0, float roughness, out vec3 diffFactor,
                         out vec3 specFactor)
{
    vec3 env = NRD_EnvironmentTerm(F0, abs(dot(normal, view)), roughness);
    diffFactor = (vec3(1.0, 1.0, 1.0) - env) * albedo * 0.98 + 0.02;
    specFactor = env * (0.1 + 0.9 * roughness) * 0.98 + 0.02;
}

// In the order of their needs.
#include "nrd_resolve.glsl"
#include "nrd_restore.glsl"
#include "nrd_rejitter.glsl"
#include "nrd_cavity.glsl"
#include "nrd_lobe_trimming.glsl"
#include "nrd_strands.glsl"
#include "nrd_unfold.glsl"
#include "nrd_sigma.glsl"
#include "nrd_confidence.glsl"

#endif
