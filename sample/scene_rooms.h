// Where light may leak: two rooms with a wall of one centimetre between them, one bright, the other all but dark. The
// camera sees both, past the wall's edge.
#pragma once
#include "scene.h"

namespace sample
{
Scene makeRooms();
} // namespace sample
