// What shadows are looked at in: a low sun through coloured panes, between bars and past spheres, one of which moves.
#pragma once
#include "scene.h"

namespace sample
{
Scene makePanes();
} // namespace sample
