// History confidence: what an application stores of each frame and traces again in the next. Part of nrd_frontend.glsl.
#ifndef NRD_CONFIDENCE_GLSL
#define NRD_CONFIDENCE_GLSL

// The pixel of a tile whose path is traced again: its centre.
// tileSize: InstanceCreationDesc::confidenceTileSize; rectSize: of the frame the path is of, pixels.
ivec2 NRD_GetConfidencePixel(ivec2 tile, int tileSize, ivec2 rectSize)
{
    return min(tile * tileSize + tileSize / 2, rectSize - 1);
}

// IN_STORED_SAMPLE and IN_RETRACED_SAMPLE, from demodulated radiance as it is before packing for the denoiser; black
// for a lobe the path did not sample. viewZ: as in IN_VIEWZ. Rec. 709 luminance, at most what half floats hold.
vec4 NRD_FrontEnd_PackConfidenceSample(vec3 diffuseRadiance, vec3 specularRadiance, float viewZ)
{
    vec3 weights = vec3(0.2126, 0.7152, 0.0722);
    return vec4(min(dot(diffuseRadiance, weights), NRD_FP16_MAX), min(dot(specularRadiance, weights), NRD_FP16_MAX),
                viewZ, 0.0);
}

#endif
