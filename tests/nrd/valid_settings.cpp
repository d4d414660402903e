#include "valid_settings.h"

#include <algorithm>
#include <iterator>

namespace test
{
using namespace nrd;

void setIdentity(float (&matrix)[16])
{
    for (int i = 0; i < 16; i++) matrix[i] = i % 5 == 0 ? 1.0f : 0.0f;
}

void setPerspective(float (&matrix)[16], float xScale, float yScale, float viewZSign)
{
    std::fill(std::begin(matrix), std::end(matrix), 0.0f);
    matrix[0] = xScale;
    matrix[5] = yScale;
    matrix[10] = viewZSign * 1.001f; // near 0.1, far 100
    matrix[11] = viewZSign;
    matrix[14] = -0.1001f;
}

void setCameraPosition(float (&m)[16], float x, float y, float z)
{
    for (int row = 0; row < 3; row++) m[12 + row] = -(m[row] * x + m[4 + row] * y + m[8 + row] * z);
}

CommonSettings makeCommon()
{
    CommonSettings common;
    setPerspective(common.viewToClipMatrix, 1.0f, 1.0f, 1.0f);
    setPerspective(common.viewToClipMatrixPrev, 1.0f, 1.0f, 1.0f);
    setIdentity(common.worldToViewMatrix);
    setIdentity(common.worldToViewMatrixPrev);
    for (auto size : {&common.resourceSize, &common.resourceSizePrev, &common.rectSize, &common.rectSizePrev})
    {
        (*size)[0] = 100;
        (*size)[1] = 60;
    }
    common.timeDeltaBetweenFrames = 1000.0f / 60.0f;
    return common;
}
} // namespace test
