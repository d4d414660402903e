// The pure functions of shaders/lib against closed forms; over random input they are swept.
#include "catch.h"
#include "function_runner.h"
#include "functions.h"
#include "random.h"

using namespace nrdtest;
using glm::dvec3;

TEST_CASE("falloffs match their closed forms", "[gpu]")
{
    const float rows[][3] = {{0, 1, 1},        {0.25f, 0.87891f, 0}, {0.5f, 0.5625f, 0.21053f}, {0.75f, 0.19141f, 0},
                             {1, 0, 0.07692f}, {2, 0, 0.02326f}};
    for (const auto& row : rows)
    {
        const Results r = runFunction(FN_FALLOFFS, {Vec4{row[0], 0, 0, 0}});
        CHECK(r.first[0] == Approx(row[1]).margin(1e-5));
        if (row[2] > 0.0f) CHECK(r.first[1] == Approx(row[2]).margin(1e-5));
    }
    for (double angle : {0.0, 0.01, 0.2, 0.5})
    {
        const Results r =
            runFunction(FN_NORMAL_ANGLE, {Vec4{0, 0, 1, 0}, toVec4(std::sin(angle), 0.0, std::cos(angle))});
        CHECK(r.first[0] == Approx(angle).margin(0.006)); // 1 % at half a radian
    }
}

TEST_CASE("a ramp rises, falls, and steps where it has no width", "[gpu]")
{
    CHECK(runFunction(FN_RAMP, {Vec4{0.5f, 1, 0.75f, 0}}).first[0] == Approx(0.5));
    CHECK(runFunction(FN_RAMP, {Vec4{1, 0, 0.25f, 0}}).first[0] == Approx(0.75));
    CHECK(runFunction(FN_RAMP, {Vec4{2, 2, 1, 0}}).first[0] == 0.0f);
    CHECK(runFunction(FN_RAMP, {Vec4{2, 2, 3, 0}}).first[0] == 1.0f);
}

TEST_CASE("the dominant direction turns from mirror to normal", "[gpu]")
{
    const float rows[][3] = {{1, 0, 1},          {0.5f, 0.5f, 0.89286f}, {0.5f, 1, 0},
                             {0.1f, 1, 0.1362f}, {1, 0.3f, 0.9915f},     {1, 0.6f, 0.8277f}};
    for (const auto& row : rows)
        CHECK(runFunction(FN_DOMINANT_FACTOR, {Vec4{row[0], row[1], 0, 0}}).first[0] == Approx(row[2]).margin(1e-4));
}

TEST_CASE("the lobe tangent is the published one", "[gpu]")
{
    CHECK(runFunction(FN_LOBE_TANGENT, {Vec4{1, 0.75f, 0, 0}}).first[0] == Approx(std::sqrt(3.0)).epsilon(1e-4));
    CHECK(runFunction(FN_LOBE_TANGENT, {Vec4{0, 0.75f, 0, 0}}).first[0] == 0.0f);
    CHECK(std::isfinite(runFunction(FN_LOBE_TANGENT, {Vec4{1, 1, 0, 0}}).first[0]));
}

TEST_CASE("a coordinate outside the screen is folded back", "[gpu]")
{
    const float rows[][2] = {{0.25f, 0.25f}, {-0.25f, 0.25f}, {1.25f, 0.75f}, {0.0f, 0.0f}, {1.0f, 0.99999f}};
    for (const auto& row : rows)
        CHECK(runFunction(FN_MIRROR_UV, {Vec4{row[0], row[0], 0, 0}}).first[1] == Approx(row[1]).margin(2e-6));
}

TEST_CASE("the virtual image lies where a thin lens puts it", "[gpu]")
{
    const Vec4 X = {0, 0, 10, 5};
    const auto imageDepth = [&](float curvature) {
        return runFunction(FN_VIRTUAL_POSITION, {X, {0, 0, -1, curvature}, {0, 0, 10, 0}}).first[2];
    };
    CHECK(imageDepth(0.0f) == Approx(15.0).epsilon(1e-5));
    CHECK(imageDepth(0.1f) == Approx(12.5).epsilon(1e-5));
    CHECK(imageDepth(-0.2f) == Approx(5.0).epsilon(1e-4));
    CHECK(imageDepth(-0.1f) == Approx(15.0).epsilon(1e-5)); // at the focus: taken as flat
}

TEST_CASE("the image of what moves moves as its mirror image, smaller in convex and upside down in concave mirrors",
          "[gpu]")
{
    const auto imageMotion = [](float curvature, Vec4 motion)
    {
        const Vec4 X = {0, 0, 10, 5}, N = {0, 0, -1, curvature}, Xprev = {0, 0, 10, 0};
        return toDouble(runFunction(FN_IMAGE_MOTION, {X, N, Xprev, motion}).first);
    };
    CHECK(glm::distance(imageMotion(0.0f, {1, 2, 3, 0}), dvec3(1, 2, -3)) < 1e-4);
    CHECK(glm::distance(imageMotion(0.1f, {1, 2, 3, 0}), dvec3(1, 2, -3) * 0.5) < 1e-4);
    CHECK(glm::distance(imageMotion(-0.2f, {1, 2, 3, 0}), dvec3(1, 2, -3) * -1.0) < 1e-4);
    CHECK(glm::length(imageMotion(-0.1001f, {1, 0, 0, 0})) <= 5.0 + 1e-4); // near the focus
    CHECK(imageMotion(0.1f, {0, 0, 0, 0}) == dvec3(0.0));
}

TEST_CASE("the curvature of a sphere is one over its radius", "[gpu]")
{
    for (double radius : {0.5, 2.0, 40.0})
    {
        const dvec3 N = glm::normalize(dvec3(1, 2, -2)), other = glm::normalize(N + dvec3(0.01, 0, 0.005));
        const Results convex =
            runFunction(FN_CURVATURE, {toVec4(N * radius), toVec4(N), toVec4(other * radius), toVec4(other)});
        CHECK(convex.first[0] == Approx(1.0 / radius).epsilon(1e-2));
        const Results concave =
            runFunction(FN_CURVATURE, {toVec4(N * radius), toVec4(-N), toVec4(other * radius), toVec4(-other)});
        CHECK(concave.first[0] == Approx(-1.0 / radius).epsilon(1e-2));
    }
    CHECK(
        runFunction(FN_CURVATURE, {Vec4{1, 1, 1, 0}, Vec4{0, 0, 1, 0}, Vec4{1, 1, 1, 0}, Vec4{0, 1, 0, 0}}).first[0] ==
        0.0f);
}

TEST_CASE("what lies behind the camera is off screen, and orthographic views know no slope", "[gpu]")
{
    const Results behind =
        runFunction(FN_PROJECT, {Vec4{0, 0, -1, 0}, Vec4{1, 0, 0, 0}, Vec4{0, 1, 0, 0}, Vec4{0, 0, 1, 0}});
    CHECK(behind.first[0] == -1.0f); // off screen
    const Results ortho = runFunction(FN_RECONSTRUCT, {Vec4{0.75f, 0.25f, 7, 1}, Vec4{-2, 1, 4, -2}});
    CHECK(ortho.first[0] == 1.0f);
    CHECK(ortho.first[1] == 0.5f);
    CHECK(ortho.first[2] == 7.0f);
}

TEST_CASE("a footprint's weights are bilinear", "[gpu]")
{
    const Results r = runFunction(FN_FOOTPRINT, {Vec4{10.75f, 3.0f, 0, 0}});
    CHECK(r.second[0] == 10.0f);
    CHECK(r.second[1] == 2.0f);
    const float expected[] = {0.375f, 0.125f, 0.375f, 0.125f};
    for (int i = 0; i < 4; i++) CHECK(r.first[i] == Approx(expected[i]).margin(1e-6));
    CHECK(runFunction(FN_FOOTPRINT, {Vec4{0.25f, 0.25f, 0, 0}}).second[0] == -1.0f);
}

TEST_CASE("Catmull-Rom weights sum to one and reproduce a linear function", "[gpu]")
{
    Random random(6);
    std::vector<Arguments> in;
    for (int i = 0; i < 1000; i++) in.push_back({toVec4(random.uniform(2, 60), random.uniform(2, 60))});
    const std::vector<Results> out = runFunction(FN_CATMULL_ROM, in);
    for (size_t i = 0; i < in.size(); i++)
    {
        CHECK(out[i].second[0] == Approx(1.0).epsilon(1e-5));
        // Without its corners the filter is slightly off linear between texels.
        CHECK(out[i].first[0] == Approx(in[i].a[0]).margin(0.03));
        CHECK(out[i].first[1] == Approx(in[i].a[1]).margin(0.03));
    }
}

TEST_CASE("custom bilinear weights ignore invalid texels and give 0 without a valid one", "[gpu]")
{
    CHECK(runFunction(FN_CUSTOM_BILINEAR, {Vec4{1, 2, 3, 4}, Vec4{0.25f, 0, 0, 0.25f}}).first[0] == Approx(2.5));
    CHECK(runFunction(FN_CUSTOM_BILINEAR, {Vec4{1, 2, 3, 4}, Vec4{2e-5f, 2e-5f, 2e-5f, 2e-5f}}).first[0] == 0.0f);
}

TEST_CASE("an axis that is only read and written stays what it is, whatever trifle the reads are off", "[gpu]")
{
    Random random(8);
    std::vector<Arguments> once, often;
    for (int i = 0; i < 4096; i++)
    {
        const Vec4 axis = toVec4(random.direction() * std::min(random.uniform(0.0, 2.0), 1.0), 1e-5);
        once.push_back({axis, {1, float(i), 0, 0}});
        often.push_back({axis, {500, float(i), 0, 0}});
    }
    const std::vector<Results> first = runFunction(FN_AXIS_CODE, once), last = runFunction(FN_AXIS_CODE, often);
    double worst = 0.0;
    for (size_t i = 0; i < first.size(); i++)
        worst = std::max(worst, glm::distance(toDouble(first[i].first), toDouble(last[i].first)));
    CHECK(worst < 1e-3);
}

TEST_CASE("an axis between two steps is met on average", "[gpu]")
{
    for (const double share : {0.02, 0.3, 0.5, 0.9})
    {
        std::vector<Arguments> in;
        const dvec3 axis = dvec3(100.0 + share, -200.0 - share, 50.0 + share) / 511.0;
        for (int i = 0; i < 16384; i++) in.push_back({toVec4(axis), {1, float(i), 0, 0}});
        dvec3 sum(0.0);
        for (const Results& r : runFunction(FN_AXIS_CODE, in)) sum += toDouble(r.first);
        const dvec3 difference = sum / 16384.0 - (axis * 511.0 + 512.0);
        CHECK(glm::length(difference) < 0.02); // three deviations of such a mean
    }
}
