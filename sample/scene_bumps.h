// The built-in room of normal-mapped relief.
#pragma once
#include "scene.h"

namespace sample
{
/// Studded rubber and embossed metal, lit from the side: what a blur takes out of normal maps is seen at once.
Scene makeBumps();
} // namespace sample
