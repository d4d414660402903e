// What a pass is given beside its textures: the frame's constants, samplers, permutation switches.
#ifndef DENOISER_BINDINGS_GLSL
#define DENOISER_BINDINGS_GLSL
#include "bindings.h"
#include "denoiser_constants.h"
#include "nrd_frontend.glsl"

layout(constant_id = SPEC_NORMAL_ENCODING) const int kNormalEncoding = NRD_NORMAL_R10G10B10A2_UNORM;
layout(constant_id = SPEC_ROUGHNESS_ENCODING) const int kRoughnessEncoding = NRD_ROUGHNESS_LINEAR;
layout(constant_id = SPEC_IS_SOFTWARE) const bool kIsSoftware = false;
layout(constant_id = SPEC_HAS_PREPASS) const bool kHasPrepass = true;
layout(constant_id = SPEC_HAS_STABILIZATION) const bool kHasStabilization = true;
layout(constant_id = SPEC_HAS_MATERIAL_TEST) const bool kHasMaterialTest = false;
layout(constant_id = SPEC_HAS_CONFIDENCE) const bool kHasConfidence = false;
layout(constant_id = SPEC_HAS_SPECULAR_MOTION) const bool kHasSpecularMotion = false;
layout(constant_id = SPEC_HAS_ANTI_FIREFLY) const bool kHasAntiFirefly = true;

layout(set = SET_CONSTANTS, binding = BINDING_CONSTANTS, std140) uniform Constants { DenoiserConstants g; };
layout(set = SET_CONSTANTS, binding = BINDING_SAMPLERS) uniform sampler gNearestClamp;
layout(set = SET_CONSTANTS, binding = BINDING_SAMPLERS + 1) uniform sampler gLinearClamp;

#endif
