// One step of a wavelet over the tiles: a single path knows little about how the light round it has changed.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "confidence.glsl"

layout(constant_id = SPEC_NORMAL_ENCODING) const int kNormalEncoding = NRD_NORMAL_R10G10B10A2_UNORM;
layout(constant_id = SPEC_ROUGHNESS_ENCODING) const int kRoughnessEncoding = NRD_ROUGHNESS_LINEAR;
layout(constant_id = SPEC_STEP) const int kStride = 1; // tiles

layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Gradient;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_StoredSample;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_StoredNormalRoughness;
layout(set = SET_RESOURCES, binding = 3) uniform writeonly image2D gOut_Gradient;

struct Tile
{
    vec3 position;
    vec3 normal;
    float viewZ;
};

Tile readTile(ivec2 tile)
{
    float viewZ = decodeViewZ(texelFetch(gIn_StoredSample, tile, 0).z);
    vec2 uv = (vec2(tile) + 0.5) / g.rectSizePrev;
    vec3 inView = reconstructViewPosition(uv, g.frustumPrev, viewZ, g.isOrthographic);
    float materialID;
    vec4 guide = NRD_UnpackNormalAndRoughness(texelFetch(gIn_StoredNormalRoughness, tile, 0), kNormalEncoding,
                                              kRoughnessEncoding, materialID);
    return Tile(rotate(g.viewToWorldPrev, inView), guide.xyz, viewZ);
}

float weightOf(Tile centre, Tile other, ivec2 offset)
{
    if (!isInRange(other.viewZ)) return 0.0;
    float tolerated = g.planeDistance * (g.isOrthographic != 0.0 ? 1.0 : centre.viewZ);
    float plane = soft(abs(dot(centre.normal, other.position - centre.position)) / tolerated);
    float gauss = exp(-0.5 * float(dot(offset, offset)));
    return gauss * plane * square(max(dot(centre.normal, other.normal), 0.0));
}

void main()
{
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(tile)) return;
    Tile centre = readTile(tile);
    vec4 sum = texelFetch(gIn_Gradient, tile, 0);
    float weights = 1.0;
    for (int y = -2; y <= 2; y++)
    {
        for (int x = -2; x <= 2; x++)
        {
            ivec2 other = tile + kStride * ivec2(x, y);
            if ((x == 0 && y == 0) || !isInRect(other) || !isInRange(centre.viewZ)) continue;
            float weight = weightOf(centre, readTile(other), ivec2(x, y));
            sum += weight * texelFetch(gIn_Gradient, other, 0);
            weights += weight;
        }
    }
    imageStore(gOut_Gradient, tile, sum / weights);
}
