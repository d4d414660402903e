// What is packed of a shadow; read by C++ and GLSL.
#ifndef SHADOW_MODES_H
#define SHADOW_MODES_H

#define SHADOW_PENUMBRA 0
#define SHADOW_TRANSLUCENCY 1

#endif
