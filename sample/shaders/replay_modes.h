// What the replay tool's shaders do with a slot; read by C++ and GLSL.
#ifndef REPLAY_MODES_H
#define REPLAY_MODES_H

#define REPLAY_PACK_COPY 0
#define REPLAY_PACK_NORMAL_ROUGHNESS 1
#define REPLAY_PACK_REBLUR_RADIANCE 2
#define REPLAY_PACK_REBLUR_HITDIST 3
#define REPLAY_PACK_REBLUR_SH0 4
#define REPLAY_PACK_REBLUR_SH1 5
#define REPLAY_PACK_REBLUR_DIRECTION_HITDIST 6
#define REPLAY_PACK_CONSTANT 7
#define REPLAY_PACK_RELAX_RADIANCE 8 // this and the next two are RELAX's
#define REPLAY_PACK_RELAX_SH0 9
#define REPLAY_PACK_RELAX_SH1 10
#define REPLAY_PACK_SIGMA_PENUMBRA 11
#define REPLAY_PACK_SIGMA_TRANSLUCENCY 12

#define REPLAY_UNPACK_COPY 0
#define REPLAY_UNPACK_REBLUR_RADIANCE 1
#define REPLAY_UNPACK_REBLUR_HITDIST 2
#define REPLAY_UNPACK_REBLUR_DIRECTION_HITDIST 3
#define REPLAY_UNPACK_RELAX_RADIANCE 4
// SH, of which both families return the same record.
#define REPLAY_UNPACK_EXTRACT 5    // the colour without a resolve
#define REPLAY_UNPACK_RESOLVE_SG 6 // by spherical Gaussians
#define REPLAY_UNPACK_RESOLVE_SH 7 // by spherical harmonics
#define REPLAY_UNPACK_RESTORE 8    // what the pixel's own normal adds to its neighbours'

#define REPLAY_UNPACK_SIGMA 9        // .xyz colour, .w visibility

#define REPLAY_LIGHT_SUN 0
#define REPLAY_LIGHT_LOCAL 1

#define REPLAY_HIT_DIST_MISS 65504.0 // recorded where a ray hit nothing

#endif
