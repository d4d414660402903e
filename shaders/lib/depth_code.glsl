// Depth as a logarithm in 16 bits: 4e-4 apart from 6e-5 to 1e6 units, beyond which it is clamped. 0: nothing is there.
#ifndef DEPTH_CODE_GLSL
#define DEPTH_CODE_GLSL

const float kDepthOctaves = 34.0, kDepthFirstOctave = -14.0;
const float kDepthStep = 1.0 / 65535.0;

// To be stored in 16 bits of [0; 1], which rounds it.
float encodeDepth(float viewZ)
{
    float octave = (log2(viewZ) - kDepthFirstOctave) / kDepthOctaves;
    return kDepthStep + clamp(octave, 0.0, 1.0) * (1.0 - kDepthStep);
}

float decodeDepth(float stored)
{
    float octave = (stored - kDepthStep) / (1.0 - kDepthStep);
    return stored == 0.0 ? 0.0 : exp2(octave * kDepthOctaves + kDepthFirstOctave);
}

uint packDepth(float viewZ) { return uint(encodeDepth(viewZ) * 65535.0 + 0.5); }
float unpackDepth(uint code) { return decodeDepth(float(code) * kDepthStep); }

#endif
