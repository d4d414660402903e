// Where everything is bound, and the identifiers of the specialisation constants.
#ifndef BINDINGS_H
#define BINDINGS_H

#ifndef __cplusplus
#extension GL_EXT_samplerless_texture_functions : require // texelFetch from texture2D
#endif

#define SET_CONSTANTS 0
#define BINDING_CONSTANTS 0
#define BINDING_SAMPLERS 1 // nearest clamp, then linear clamp
#define SET_RESOURCES 1

// Per instance
#define SPEC_NORMAL_ENCODING 0    // value of NormalEncoding
#define SPEC_ROUGHNESS_ENCODING 1 // value of RoughnessEncoding
#define SPEC_IS_SOFTWARE 10       // isSoftwareDevice
// Per dispatch: a row of the pass table names the ones it uses
#define SPEC_HAS_PREPASS 2
#define SPEC_HAS_STABILIZATION 3
#define SPEC_HAS_MATERIAL_TEST 4
#define SPEC_HAS_CONFIDENCE 5
#define SPEC_HAS_SPECULAR_MOTION 6
#define SPEC_HAS_ANTI_FIREFLY 7
#define SPEC_IS_LAST 8
// Per pass
#define SPEC_STEP 9 // log2 of the wavelet's stride

#define TILE_SIZE 16
#define VIRTUAL_AMOUNT_STEP 4 // one pixel of 4x4 says how much of its history came along the virtual track

#endif
