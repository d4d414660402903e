// Matrices and frusta against values computed by hand.
#include "fixture.h"
#include "frame_state.h"
#include <cmath>

using namespace test;

namespace
{
struct Point
{
    double x, y, z;
};

Point transform(const nrd::shared::mat4& m, const Point& p, double w = 1.0)
{
    double r[4] = {};
    for (int row = 0; row < 4; row++)
        r[row] = double{m.columns[row]} * p.x + double{m.columns[4 + row]} * p.y + double{m.columns[8 + row]} * p.z +
                 double{m.columns[12 + row]} * w;
    return w == 0.0 || r[3] == 1.0 ? Point{r[0], r[1], r[2]} : Point{r[0] / r[3], r[1] / r[3], r[2] / r[3]};
}

void checkPoint(const Point& p, double x, double y, double z, double margin = 1e-5)
{
    CHECK(p.x == Approx(x).margin(margin));
    CHECK(p.y == Approx(y).margin(margin));
    CHECK(p.z == Approx(z).margin(margin));
}

// Rotation about the vertical axis that turns world +x into view forward (left-handed view, looking along +x).
void setLookAlongX(float (&m)[16])
{
    setIdentity(m);
    m[0] = 0.0f, m[2] = 1.0f, m[8] = -1.0f, m[10] = 0.0f; // view x = -world z, view z = world x
}

void setOrthographic(float (&m)[16], float halfWidth, float halfHeight, float depthScale, float depthOffset)
{
    setIdentity(m);
    m[0] = 1.0f / halfWidth;
    m[5] = 1.0f / halfHeight;
    m[10] = depthScale;
    m[14] = depthOffset;
}
} // namespace

TEST_CASE("the frustum of a symmetric perspective projection spans its slopes", "[unit]")
{
    CommonSettings common = makeCommon();
    setPerspective(common.viewToClipMatrix, 0.5f, 2.0f, 1.0f); // tangents 2 and 0.5
    const FrameState state = makeFrameState(common, 1.0f);
    CHECK(state.frustum.x == Approx(-2.0f));
    CHECK(state.frustum.y == Approx(0.5f));
    CHECK(state.frustum.z == Approx(4.0f));
    CHECK(state.frustum.w == Approx(-1.0f));
    CHECK(state.unproject == Approx(2.0f / (60.0f * 2.0f))); // world size of a pixel at z = 1
    CHECK(state.minRectDim == 60.0f);
    CHECK(state.cameraDelta.w == 0.0f);
}

TEST_CASE("off-centre projections shift the frustum", "[unit]")
{
    CommonSettings common = makeCommon();
    // Left-handed, slopes left -1, right 3, bottom -2, top 1.
    float(&m)[16] = common.viewToClipMatrix;
    m[0] = 2.0f / 4.0f, m[8] = -(3.0f - 1.0f) / 4.0f;
    m[5] = 2.0f / 3.0f, m[9] = -(1.0f - 2.0f) / 3.0f;
    SECTION("left-handed") {}
    SECTION("right-handed: the same frustum, with z mirrored")
    {
        for (int row = 0; row < 4; row++) m[8 + row] = -m[8 + row];
        common.worldToViewMatrix[10] = -1.0f;
    }
    const FrameState state = makeFrameState(common, 1.0f);
    CHECK(state.frustum.x == Approx(-1.0f));
    CHECK(state.frustum.y == Approx(1.0f));
    CHECK(state.frustum.z == Approx(4.0f));
    CHECK(state.frustum.w == Approx(-3.0f));
}

TEST_CASE("right-handed views become left-handed ones of the same picture", "[unit]")
{
    CommonSettings left = makeCommon(), right = makeCommon();
    setPerspective(right.viewToClipMatrix, 1.0f, 1.0f, -1.0f);
    setPerspective(right.viewToClipMatrixPrev, 1.0f, 1.0f, -1.0f);
    right.worldToViewMatrix[10] = right.worldToViewMatrixPrev[10] = -1.0f;
    left.motionVectorScale[2] = right.motionVectorScale[2] = 1.0f;
    const FrameState a = makeFrameState(left, 1.0f), b = makeFrameState(right, 1.0f);
    const Point p = {0.3, -0.2, 5.0};
    const Point expected = transform(a.worldToClip, p);
    checkPoint(transform(b.worldToClip, p), expected.x, expected.y, expected.z);
    checkPoint(transform(b.worldToViewPrev, p), 0.3, -0.2, 5.0);
    checkPoint(transform(b.viewToWorld, {0.0, 0.0, 1.0}), 0.0, 0.0, 1.0);
    checkPoint({b.viewDirection.x, b.viewDirection.y, b.viewDirection.z}, 0.0, 0.0, -1.0);
    CHECK(b.frustum.x == Approx(a.frustum.x));
    CHECK(b.frustum.w == Approx(a.frustum.w));
    // IN_VIEWZ has either sign under either camera, so the shaders look at each texel's.
    CHECK(a.motionVectorScale.z == 1.0f);
    CHECK(b.motionVectorScale.z == 1.0f);
}

TEST_CASE("reversed and infinite depth change neither handedness nor frustum", "[unit]")
{
    const float sign = GENERATE(1.0f, -1.0f);
    const std::pair<float, float> depths[] = {{1.001f, -0.1001f}, {-0.001f, 0.1001f}, {0.0f, 0.1f}, {1.0f, -0.1f}};
    for (const auto& [scale, offset] : depths)
    {
        CommonSettings common = makeCommon();
        setPerspective(common.viewToClipMatrix, 1.0f, 1.0f, sign);
        common.viewToClipMatrix[10] = sign * scale;
        common.viewToClipMatrix[14] = offset;
        const Projection projection = makeProjection(common.viewToClipMatrix);
        CHECK(projection.viewZSign == sign);
        CHECK_FALSE(projection.isOrthographic);
        CHECK(projection.frustum[0] == Approx(-1.0));
        CHECK(projection.frustum[1] == Approx(1.0));
        CHECK(projection.yScale == Approx(1.0));
    }
}

TEST_CASE("orthographic projections know their extent and which way they look", "[unit]")
{
    struct Case
    {
        float scale, offset;
        double sign;
    };
    // near 1, far 11: d = (z - 1) / 10, reversed d = (11 - z) / 10, and both with z = -z.
    const Case cases[] = {{0.1f, -0.1f, 1.0}, {-0.1f, 1.1f, 1.0}, {-0.1f, -0.1f, -1.0}, {0.1f, 1.1f, -1.0}};
    for (const Case& c : cases)
    {
        CommonSettings common = makeCommon();
        setOrthographic(common.viewToClipMatrix, 10.0f, 6.0f, c.scale, c.offset);
        CHECK(makeProjection(common.viewToClipMatrix).viewZSign == c.sign);
        common.worldToViewMatrix[10] = static_cast<float>(c.sign);
        const FrameState state = makeFrameState(common, 1.0f);
        CHECK(state.cameraDelta.w == 1.0f);
        CHECK(state.frustum.x == Approx(-10.0f));
        CHECK(state.frustum.y == Approx(6.0f));
        CHECK(state.frustum.z == Approx(20.0f));
        CHECK(state.frustum.w == Approx(-12.0f));
        CHECK(state.unproject == Approx(12.0f / 60.0f)); // of a pixel at any depth
        checkPoint({state.viewDirection.x, state.viewDirection.y, state.viewDirection.z}, 0.0, 0.0, -1.0);
    }
}

TEST_CASE("world matrices have their origin at the current camera", "[unit]")
{
    CommonSettings common = makeCommon();
    setLookAlongX(common.worldToViewMatrix);
    setCameraPosition(common.worldToViewMatrix, 10.0f, 2.0f, -3.0f);
    setCameraPosition(common.worldToViewMatrixPrev, 9.0f, 2.5f, -7.0f);
    const FrameState state = makeFrameState(common, 1.0f);
    checkPoint({state.cameraDelta.x, state.cameraDelta.y, state.cameraDelta.z}, -1.0, 0.5, -4.0);
    checkPoint(transform(state.viewToWorld, {0.0, 0.0, 5.0}), 5.0, 0.0, 0.0); // forward is +x
    checkPoint({state.viewDirection.x, state.viewDirection.y, state.viewDirection.z}, -1.0, 0.0, 0.0);
    checkPoint(transform(state.worldToClip, {4.0, 1.0, 0.0}), 0.0, 0.25, (1.001 * 4.0 - 0.1001) / 4.0);
    // The previous camera looks along +z from its own place: the point 2 ahead of it, 1 to the right.
    const Point relative = {-1.0 + 1.0, 0.5, -4.0 + 2.0};
    checkPoint(transform(state.worldToViewPrev, relative), 1.0, 0.0, 2.0);
    checkPoint(transform(state.viewToWorldPrev, {1.0, 0.0, 2.0}), relative.x, relative.y, relative.z);
    checkPoint(transform(state.worldToClipPrev, relative), 0.5, 0.0, (1.001 * 2.0 - 0.1001) / 2.0);
}

TEST_CASE("far from the origin the given camera delta keeps its precision", "[unit]")
{
    CommonSettings common = makeCommon();
    common.cameraDelta[0] = -0.001;
    common.cameraDelta[2] = 0.0002;
    const FrameState near = [&]
    {
        CommonSettings c = common;
        c.isCameraDeltaAvailable = true;
        return makeFrameState(c, 1.0f);
    }();
    setCameraPosition(common.worldToViewMatrix, 1e5f, 50.0f, -1e5f);
    setCameraPosition(common.worldToViewMatrixPrev, 1e5f, 50.0f, -1e5f);
    const FrameState lost = makeFrameState(common, 1.0f);
    CHECK(lost.cameraDelta.x == 0.0f); // what 32-bit matrices have left of a millimetre
    common.isCameraDeltaAvailable = true;
    const FrameState far = makeFrameState(common, 1.0f);
    for (int i = 0; i < 16; i++)
    {
        CHECK(far.worldToViewPrev.columns[i] == near.worldToViewPrev.columns[i]);
        CHECK(far.worldToClipPrev.columns[i] == near.worldToClipPrev.columns[i]);
        CHECK(far.viewToWorldPrev.columns[i] == near.viewToWorldPrev.columns[i]);
        CHECK(far.worldToClip.columns[i] == near.worldToClip.columns[i]);
    }
    CHECK(far.cameraDelta.x == -0.001f);
}

TEST_CASE("a delta that 32-bit matrices still hold survives at 100,000 units", "[unit]")
{
    CommonSettings common = makeCommon();
    setLookAlongX(common.worldToViewMatrix);
    setLookAlongX(common.worldToViewMatrixPrev);
    setCameraPosition(common.worldToViewMatrix, 100000.0f, 0.0f, 100000.0f);
    setCameraPosition(common.worldToViewMatrixPrev, 100000.0f, 0.0f, 99999.75f);
    const FrameState state = makeFrameState(common, 1.0f);
    CHECK(state.cameraDelta.z == -0.25f);
    CHECK(state.cameraDelta.x == 0.0f);
}

TEST_CASE("the scale of motion vectors follows their kind", "[unit]")
{
    CommonSettings common = makeCommon();
    common.motionVectorScale[0] = 0.5f;
    common.viewZScale = 8.0f;
    CHECK(makeFrameState(common, 1.0f).motionVectorScale.z == 0.0f);
    common.motionVectorScale[2] = 1.0f;
    CHECK(makeFrameState(common, 1.0f).motionVectorScale.z == 8.0f); // IN_VIEWZ is stored divided by 8
    common.isMotionVectorInWorldSpace = true;
    CHECK(makeFrameState(common, 1.0f).motionVectorScale.z == 1.0f);
    CHECK(makeFrameState(common, 1.0f).motionVectorScale.w == 1.0f);
    common.motionVectorScale[2] = 0.0f;
    CHECK(makeFrameState(common, 1.0f).motionVectorScale.z == 0.5f); // the default does not drop the third axis
    common.motionVectorScale[0] = common.motionVectorScale[1] = 0.0f;
    CHECK(makeFrameState(common, 1.0f).motionVectorScale.z == 0.0f); // a static scene
}

TEST_CASE("radii scale with the root of the height, jitter is measured on its worse axis", "[unit]")
{
    CommonSettings common = makeCommon();
    common.resourceSize[1] = common.resourceSizePrev[1] = 120;
    common.rectSize[1] = 90;
    common.cameraJitter[1] = 0.25f;
    common.cameraJitterPrev[1] = -0.125f;
    common.cameraJitter[0] = 0.125f;
    const FrameState state = makeFrameState(common, 1.0f);
    CHECK(state.radiusScale == Approx(std::sqrt(90.0 / 1440.0)));
    CHECK(state.jitterDelta == 0.375f);
}

TEST_CASE("the frame clock is calm in steady state and quick after jumps", "[unit]")
{
    FrameClock clock = tick({}, 0, 1000.0);
    CHECK(clock.smoothed == 0.0); // one time is no difference
    clock = tick(clock, 1, 1016.0);
    CHECK(clock.smoothed == Approx(16.0));
    CHECK(tick(clock, 1, 1030.0).smoothed == Approx(16.0)); // another view of the same frame
    CHECK(tick(clock, 2, 1032.5).smoothed == Approx(16.0 + 0.5 / 32.0));
    CHECK(tick(clock, 2, 1016.0 + 32.0).smoothed == Approx(16.0 + 16.0 * 0.5)); // twice as long: q = 1
    CHECK(tick(clock, 2, 1016.0).smoothed == Approx(16.0));                     // no time has passed
    CHECK(frameRateScale(0.0) == 1.0f);
    CHECK(frameRateScale(50.0) == 1.0f);
    CHECK(frameRateScale(1000.0 / 120.0) == Approx(4.0f));
}

TEST_CASE("the camera's place within a cube of whole units survives large coordinates of either sign", "[unit]")
{
    CommonSettings common = makeCommon();
    setCameraPosition(common.worldToViewMatrix, 1024.25f, -0.75f, -2048.5f);
    const FrameState state = makeFrameState(common, 1.0f);
    CHECK(state.cameraPosition.x == Approx(0.25f));
    CHECK(state.cameraPosition.y == Approx(1023.25f));
    CHECK(state.cameraPosition.z == Approx(1023.5f));
    CHECK(state.cameraPosition.w == 0.0f);
}
