// The default scene: a closed Cornell box with a metal block, a dielectric block that moves, and a moving camera.
#pragma once
#include "scene.h"

namespace sample
{
/// Built in code; repeats after 8 seconds. Units are metres.
Scene makeCornellBox();
} // namespace sample
