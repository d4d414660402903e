// A yard with a mirror on its wall, and the yard that the mirror shows, built behind a hole in that wall. No lamps:
// made for the sky, which both see alike if its front and back halves are alike.
#pragma once
#include "scene.h"

namespace sample
{
Scene makeMirrorYard();

/// Without mirrors, the same yard once more on the far side of the mirror's plane, left and right swapped: through the
/// hole in its place one sees directly what the mirror shows.
Scene makeMirrorTwin();
} // namespace sample
