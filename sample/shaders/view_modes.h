// What display.comp.glsl makes of an image; read by C++ and GLSL.
#ifndef VIEW_MODES_H
#define VIEW_MODES_H
#define VIEW_LIGHT 0u      // radiance: exposed and tone-mapped
#define VIEW_VALUE 1u      // .rgb in [0; 1] as it is
#define VIEW_SIGNED 2u     // .rgb in [-1; 1]: directions
#define VIEW_W 3u          // .w times the range, in grey
#define VIEW_DEPTH 4u      // .x: near is bright
#define VIEW_MOTION 5u     // .rgb times the range, grey stands still
#define VIEW_ID 6u         // .w: a colour for each whole number
#define VIEW_DIFFERENCE 7u // tone-mapped, from the reference, times the range
#define VIEW_OVERLAY 8u    // radiance, with the second image over it by its .w
#define VIEW_X 9u          // .x times the range, in grey

#define TONE_COMPRESS 0u // x / (1 + x), as in the project's pictures
#define TONE_FILMIC 1u   // Narkowicz 2015
#define TONE_CLAMP 2u
#endif
