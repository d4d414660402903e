// What the shaders do with an image of a lobe; read by C++ and GLSL.
#ifndef LOBE_MODES_H
#define LOBE_MODES_H

#define LOBE_RADIANCE 0      // radiance, normalised hit distance
#define LOBE_SH0 1           // the same; unpacked, it takes SH1 too
#define LOBE_SH1 2           // direction of the first bounce, weighted
#define LOBE_HIT_DISTANCE 3  // normalised hit distance alone
#define LOBE_DIRECTION 4     // direction of the first bounce and normalised hit distance
#define LOBE_MOTION 5        // as it is: the motion of what a specular path hits first
// This and all that follow are RELAX's.
#define LOBE_RELAX 6         // linear radiance, hit distance in world units; unpacked: history length
#define LOBE_RELAX_SH0 7     // the same; unpacked, it takes SH1 too
#define LOBE_RELAX_SH1 8     // direction of the first bounce, weighted

#endif
