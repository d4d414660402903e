// Cuts that the application did not announce, as far as the matrices show them.
#include "fixture.h"
#include "frame_state.h"
#include <cmath>
#include <cstring>

using namespace test;

namespace
{
constexpr double kDegree = 3.14159265358979323846 / 180.0;

void turn(float (&matrix)[16], double degrees) // about the vertical axis
{
    setIdentity(matrix);
    matrix[0] = matrix[10] = static_cast<float>(std::cos(degrees * kDegree));
    matrix[8] = static_cast<float>(std::sin(degrees * kDegree));
    matrix[2] = -matrix[8];
}

struct Film
{
    InstancePtr instance = makeInstance({kReblurBoth});
    CommonSettings common = makeCommon();

    // The view of the last frame becomes the previous one, as an application that forgets about cuts would have it.
    bool isCutAt(double degrees)
    {
        std::memcpy(common.worldToViewMatrixPrev, common.worldToViewMatrix, sizeof(common.worldToViewMatrix));
        turn(common.worldToViewMatrix, degrees);
        return request();
    }
    bool request()
    {
        common.frameIndex++;
        return reblurConstants(requestFrame(*instance, common)).isHistoryReset == 1;
    }
};
} // namespace

TEST_CASE("a pan of 90 degrees a second is no cut at any frame rate a picture is watched at", "[unit]")
{
    for (double framesPerSecond : {240.0, 60.0, 30.0, 10.0, 4.0})
    {
        INFO(framesPerSecond << " frames per second");
        Film film;
        film.isCutAt(0.0);
        for (int frame = 1; frame < 20; frame++) CHECK_FALSE(film.isCutAt(frame * 90.0 / framesPerSecond));
    }
}

TEST_CASE("a camera that looks elsewhere has been cut, once", "[unit]")
{
    Film film;
    film.isCutAt(0.0);
    CHECK(film.isCutAt(120.0));
    CHECK_FALSE(film.isCutAt(121.0));
    film.common.enableCutDetection = false;
    CHECK_FALSE(film.isCutAt(0.0));
}

TEST_CASE("a previous view that was never the last frame's betrays a cut", "[unit]")
{
    Film film;
    film.isCutAt(0.0);
    turn(film.common.worldToViewMatrix, 60.0);
    turn(film.common.worldToViewMatrixPrev, 60.0); // as if the camera had stood there
    CHECK(film.request());
    CHECK_FALSE(film.request());
}

TEST_CASE("the overlap of views is that of their frusta", "[unit]")
{
    CommonSettings common = makeCommon(); // 90 degrees wide
    CHECK(findViewOverlap(common) == 1.0);
    turn(common.worldToViewMatrix, 180.0);
    CHECK(findViewOverlap(common) == 0.0);
    turn(common.worldToViewMatrix, 45.0);
    const double half = findViewOverlap(common);
    CHECK(half > 0.3);
    CHECK(half < 0.6);
    CHECK(angleBetween(common.worldToViewMatrix, common.worldToViewMatrixPrev) == Approx(45.0).margin(0.01));
}

TEST_CASE("a denoiser of half the resolution has half of everything in pixels", "[unit]")
{
    const DenoiserDesc denoisers[] = {{0, kReblurBoth, 1}, {1, kReblurBoth, 2}};
    InstanceCreationDesc desc;
    desc.denoisers = denoisers;
    desc.denoisersNum = 2;
    Instance* raw = nullptr;
    REQUIRE(CreateInstance(desc, raw) == Result::SUCCESS);
    const InstancePtr instance(raw);
    CommonSettings common = makeCommon();
    common.resourceSize[0] = common.resourceSizePrev[0] = 101;
    common.rectSize[0] = common.rectSizePrev[0] = 99;
    common.rectOrigin[0] = 2;
    common.cameraJitter[0] = 0.25f;
    const std::vector<DispatchDesc> dispatches = requestFrame(*instance, common, {1});
    const DispatchDesc* blur = findPass(dispatches, "Blur");
    REQUIRE(blur);
    CHECK(blur->gridWidth == 7);  // 50 pixels in groups of 8
    CHECK(blur->gridHeight == 2); // 30 pixels in groups of 16
    const shared::DenoiserConstants g = reblurConstants(dispatches);
    CHECK(g.rectSize.x == 50.0f);
    CHECK(g.rectOrigin.x == 1);
    CHECK(g.resourceSizeInv.x == Approx(1.0f / 51.0f));
    const InstanceDesc& described = GetInstanceDesc(*instance);
    for (uint32_t i = 0; i < blur->resourcesNum; i++)
    {
        const ResourceDesc& r = blur->resources[i];
        if (r.type == ResourceType::PERMANENT_POOL) CHECK(described.permanentPool[r.indexInPool].downsampleFactor == 2);
    }
}

TEST_CASE("a divisor that is none is refused", "[unit]")
{
    for (uint32_t divisor : {0u, 9u})
    {
        Messages messages;
        const DenoiserDesc denoiser = {0, kReblurBoth, divisor};
        InstanceCreationDesc desc;
        desc.denoisers = &denoiser;
        desc.denoisersNum = 1;
        desc.messageSink = messages.sink();
        Instance* instance = nullptr;
        CHECK(CreateInstance(desc, instance) == Result::INVALID_ARGUMENT);
        REQUIRE(messages.texts.size() == 1);
        CHECK_THAT(messages.texts[0], containing("resolutionDivisor"));
    }
}
