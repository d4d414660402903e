// Radiance of both lobes times its factors, the light traced apart times its shadow, and the direct part; or how far
// the denoised lobes are open, in grey.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D gIn_Diffuse; // linear radiance, .w normalised hit distance if denoised
layout(set = 0, binding = 1) uniform texture2D gIn_Specular;
layout(set = 0, binding = 2) uniform texture2D gIn_DiffuseFactor;
layout(set = 0, binding = 3) uniform texture2D gIn_SpecularFactor;
layout(set = 0, binding = 4) uniform texture2D gIn_Direct;
layout(set = 0, binding = 5) uniform texture2D gIn_Sun;
layout(set = 0, binding = 6) uniform texture2D gIn_Shadow;
layout(set = 0, binding = 7) uniform writeonly image2D gOut_Composed;
layout(push_constant) uniform Constants
{
    uvec2 size;            // pixels
    vec2 occlusionWeights; // of the lobes in a picture of occlusion, sum 1; both 0: a picture of the light
    uint hasShadow;        // 0: gIn_Sun and gIn_Shadow hold nothing
    float signalScale;     // of diffuse, specular and shadow, which may be sums
};

void main()
{
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, size))) return;
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec4 diffuse = texelFetch(gIn_Diffuse, pixel, 0) * signalScale;
    vec4 specular = texelFetch(gIn_Specular, pixel, 0) * signalScale;
    vec3 composed = texelFetch(gIn_Direct, pixel, 0).rgb;
    composed += diffuse.rgb * texelFetch(gIn_DiffuseFactor, pixel, 0).rgb;
    composed += specular.rgb * texelFetch(gIn_SpecularFactor, pixel, 0).rgb;
    if (hasShadow != 0u)
        composed += texelFetch(gIn_Sun, pixel, 0).rgb * texelFetch(gIn_Shadow, pixel, 0).rgb * signalScale;
    if (occlusionWeights != vec2(0.0)) composed = vec3(dot(occlusionWeights, vec2(diffuse.w, specular.w)));
    imageStore(gOut_Composed, pixel, vec4(composed, 1.0));
}
