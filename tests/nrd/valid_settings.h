// Settings that the library takes, for tests to change; without the test framework.
#pragma once
#include <nrd/nrd.h>

namespace test
{
// Perspective with 90 degrees, left-handed unless said otherwise, at the origin, 100 x 60 pixels.
nrd::CommonSettings makeCommon();
void setIdentity(float (&matrix)[16]);
void setPerspective(float (&matrix)[16], float xScale, float yScale, float viewZSign);
void setCameraPosition(float (&worldToView)[16], float x, float y, float z); // keeps the rotation
} // namespace test
