// Every view of the validation overlay against what it must show, pixel by pixel.
#include "catch.h"
#include "overlay_model.h"
#include <cmath>
#include <limits>

using namespace quality;

TEST_CASE("the guides are shown as they are", "[gpu]")
{
    Harness harness(kOverlayWidth, kOverlayHeight);
    runOverlay(harness, 3, 0.05f);
    const Frame frame = makeOverlayFrame(2, 0.05f);
    requireView(harness, kRoughness, 1,
                onSurfaces(frame, [&](size_t i) { return toBytes(glm::dvec3(frame.guides.roughness[i])); }));
    requireView(harness, kNormals, 2,
                onSurfaces(frame, [&](size_t i) { return toBytes(0.5 * glm::dvec3(frame.guides.normals[i]) + 0.5); }));
    for (const int view : {5, 6, 9, 10, 13, 14}) requireNothing(harness, view);
}

TEST_CASE("depth is green before the camera, blue where it is stored negative, red beyond the range", "[gpu]")
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float sign : {1.0f, -1.0f})
    {
        Harness harness(kOverlayWidth, kOverlayHeight);
        Frame frame;
        const auto change = [&](Frame& last)
        {
            for (float& z : last.guides.viewZ) z *= sign;
            for (size_t i = 0; i < kOverlayCount; i += 7) last.guides.viewZ[i] = nan;
            frame = last;
        };
        runOverlay(harness, 2, 0.0f, change);
        requireView(harness, kDepth, 1,
                    [&](const OverlayPixel& p)
                    {
                        if (isSky(frame, p.source)) return kOverlayRed;
                        const double z = std::abs(frame.guides.viewZ[p.source]), share = std::sqrt(z / (z + 30.0));
                        return toBytes(sign > 0.0f ? glm::dvec3(0.0, share, 0.0) : glm::dvec3(0.0, 0.0, share));
                    });
    }
}

TEST_CASE("world positions keep their place in the grid of units, however far from the origin", "[gpu]")
{
    Harness harness(kOverlayWidth, kOverlayHeight);
    runOverlay(harness, 3, 0.3f);
    const Frame frame = makeOverlayFrame(2, 0.3f);
    const std::vector<glm::dvec3> positions = worldPositions(frame.guides, kOverlayWidth, kOverlayHeight);
    size_t compared = 0, different = 0, flickering = 0;
    for (int y = 0; y < kOverlayHeight / 4; y++)
    {
        for (int x = 0; x < kOverlayWidth / 4; x++)
        {
            const OverlayPixel p = overlayPixel(x, y, kOverlayWidth, kOverlayHeight);
            if (p.view != kWorld || isSky(frame, p.source) || p.uv.y > 0.5) continue; // below: the two small squares
            const glm::u8vec4 shown = harness.overlay()[static_cast<size_t>(y * kOverlayWidth + x)];
            for (int c = 0; c < 3; c++)
            {
                // 0 and 1 are neighbours.
                const double error = shown[c] / 255.0 - positions[p.source][c];
                different += std::abs(error - std::round(error)) > 1.5 / 255.0 ? 1 : 0;
                // The floor lies at a whole number and must not flicker.
                const bool isFloor = frame.guides.normals[p.source].y == 1.0f && c == 1;
                flickering += isFloor && shown[c] > 1 ? 1 : 0;
            }
            compared++;
        }
    }
    CHECK(compared > 50);
    CHECK(different == 0);
    CHECK(flickering == 0);
}

TEST_CASE("the motion of a static scene is no error, whatever the camera does", "[gpu]")
{
    for (const float speed : {0.0f, 0.02f})
    {
        Harness harness(kOverlayWidth, kOverlayHeight);
        runOverlay(harness, 3, speed);
        const Frame frame = makeOverlayFrame(2, speed);
        const Camera previous = makeCamera(1, speed, kOverlayWidth, kOverlayHeight);
        const std::vector<glm::dvec3> positions = worldPositions(frame.guides, kOverlayWidth, kOverlayHeight);
        requireView(harness, kMotion, 0,
                    onSurfaces(frame,
                               [&](size_t i)
                               {
                                   const glm::dvec2 at =
                                       screenPosition(previous, positions[i], kOverlayWidth, kOverlayHeight);
                                   const bool isInside =
                                       at.x >= 0 && at.y >= 0 && at.x < kOverlayWidth && at.y < kOverlayHeight;
                                   return toBytes({0.0, 0.0, isInside ? 0.0 : 1.0});
                               }));
    }
}

TEST_CASE("wrong motion is shown in pixels, blue where it leads off the screen", "[gpu]")
{
    Harness harness(kOverlayWidth, kOverlayHeight);
    Frame frame;
    const auto fault = [](size_t i)
    {
        const size_t x = i % kOverlayWidth;
        if (x > kOverlayWidth / 2) return glm::vec3(0.0f); // right half: correct
        return x < kOverlayWidth / 4 ? glm::vec3(500.0f, 0.0f, 0.0f) : glm::vec3(0.03125f, -0.0625f, 0.0f);
    };
    runOverlay(harness, 2, 0.0f,
               [&](Frame& last)
               {
                   for (size_t i = 0; i < kOverlayCount; i++) last.motion.push_back(fault(i));
                   frame = last;
               });
    const Camera& camera = frame.guides.camera;
    const std::vector<glm::dvec3> positions = worldPositions(frame.guides, kOverlayWidth, kOverlayHeight);
    size_t partial = 0;
    const auto expected = [&](size_t i)
    {
        const glm::dvec2 at =
            screenPosition(camera, positions[i] + glm::dvec3(fault(i)), kOverlayWidth, kOverlayHeight);
        const glm::dvec2 error = glm::abs(at - screenPosition(camera, positions[i], kOverlayWidth, kOverlayHeight));
        const bool isInside = at.x >= 0 && at.y >= 0 && at.x < kOverlayWidth && at.y < kOverlayHeight;
        partial += error.x > 0.1 && error.x < 0.9 ? 1 : 0;
        return toBytes({error.x, error.y, isInside ? 0.0 : 1.0});
    };
    requireView(harness, kMotion, 2, onSurfaces(frame, expected));
    CHECK(partial > 10);
}

TEST_CASE("motion on the screen is held against the same expectation", "[gpu]")
{
    Harness harness(kOverlayWidth, kOverlayHeight);
    for (int i = 0; i < 2; i++)
    {
        Frame frame = makeOverlayFrame(0, 0.0f);
        frame.motion.assign(kOverlayCount, i == 0 ? glm::vec3(0.0f) : glm::vec3(0.5f, -0.25f, 0.0f)); // pixels
        harness.denoise(frame,
                        [](nrd::CommonSettings& common)
                        {
                            common.enableValidation = true;
                            common.isMotionVectorInWorldSpace = false;
                            common.motionVectorScale[0] = 1.0f / kOverlayWidth;
                            common.motionVectorScale[1] = 1.0f / kOverlayHeight;
                            common.motionVectorScale[2] = 0.0f;
                        });
    }
    const Frame frame = makeOverlayFrame(0, 0.0f);
    requireView(harness, kMotion, 1, onSurfaces(frame, [](size_t) { return toBytes({0.5, 0.25, 0.0}); }));
}

TEST_CASE("history lengths run through the rainbow, over a legend", "[gpu]")
{
    const int n = GENERATE(1, 4, 11);
    nrd::ReblurSettings settings;
    settings.maxAccumulatedFrameNum = 9;
    Harness harness(kOverlayWidth, kOverlayHeight, settings);
    runOverlay(harness, n + 1, 0.0f); // the first frame has no history
    const Frame frame = makeOverlayFrame(0, 0.0f);
    const auto expected = [&](const OverlayPixel& p)
    {
        if (p.inView.y >= kLegendTop) return rainbowBytes(p.uv.x); // the last 5 % of 18 lines
        return isSky(frame, p.source) ? kOverlayBlack : rainbowBytes(std::min(n, 9) / 9.0);
    };
    requireView(harness, kDiffuseLength, 1, expected);
    requireView(harness, kSpecularLength, 1, expected);
}

TEST_CASE("less than one frame of history is checkered", "[gpu]")
{
    nrd::ReblurSettings settings;
    settings.maxAccumulatedFrameNum = settings.maxFastAccumulatedFrameNum = settings.historyFixFrameNum = 0;
    Harness harness(kOverlayWidth, kOverlayHeight, settings);
    runOverlay(harness, 3, 0.0f);
    const Frame frame = makeOverlayFrame(0, 0.0f);
    const auto expected = [&](const OverlayPixel& p)
    {
        if (p.inView.y >= kLegendTop) return rainbowBytes(p.uv.x);
        const bool isDark = (p.inView.x / 4 + p.inView.y / 4) % 2 == 1;
        return isDark || isSky(frame, p.source) ? kOverlayBlack : kOverlayRed;
    };
    requireView(harness, kDiffuseLength, 0, expected);
    requireView(harness, kSpecularLength, 0, expected);
}

TEST_CASE("hit distances are grey, red at 0, magenta where they cannot be", "[gpu]")
{
    Harness harness(kOverlayWidth, kOverlayHeight);
    Frame frame;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float values[] = {0.0f, 0.25f, 1.0f, 1.25f, -0.5f, nan};
    const auto change = [&](Frame& last)
    {
        for (size_t i = 0; i < kOverlayCount; i++) last.diffuse[i].w = values[(i / 4) % 6];
        for (size_t i = 0; i < kOverlayCount; i++) last.specular[i].w = values[(i / 4 + 3) % 6];
        for (size_t i = 0; i < kOverlayCount / 2; i++) last.specular[i].y = i / 4 % 2 == 0 ? 0.0f : nan;
        frame = last;
    };
    runOverlay(harness, 2, 0.0f, change);
    const auto color = [](float h)
    {
        if (h == 0.0f) return kOverlayRed;
        return h > 0.0f && h <= 1.0f ? toBytes(glm::dvec3(h)) : kOverlayMagenta;
    };
    requireView(harness, kDiffuseHitDist, 1, onSurfaces(frame, [&](size_t i) { return color(frame.diffuse[i].w); }));
    requireView(harness, kSpecularHitDist, 1,
                onSurfaces(frame,
                           [&](size_t i)
                           {
                               const glm::vec4 v = frame.specular[i];
                               return std::isnan(v.y) ? kOverlayMagenta : color(v.w);
                           }));
}

TEST_CASE("the virtual amount is 0 at rest, and high where a mirror is passed by", "[gpu]")
{
    Harness still(kOverlayWidth, kOverlayHeight);
    runOverlay(still, 6, 0.0f);
    const Frame frame = makeOverlayFrame(0, 0.0f);
    requireView(still, kVirtualAmount, 0, onSurfaces(frame, [](size_t) { return kOverlayBlack; }));

    Harness moving(kOverlayWidth, kOverlayHeight);
    runOverlay(moving, 12, 0.03f);
    const Frame last = makeOverlayFrame(11, 0.03f);
    size_t mirrors = 0, high = 0;
    const auto countMirrors = [&](int x, int y)
    {
        const OverlayPixel p = overlayPixel(x, y, kOverlayWidth, kOverlayHeight);
        if (p.view != kVirtualAmount || isSky(last, p.source) || last.guides.roughness[p.source] > 0.05f) return;
        mirrors++;
        high += moving.overlay()[static_cast<size_t>(y * kOverlayWidth + x)].r > 127 ? 1 : 0;
    };
    for (int y = 0; y < kOverlayHeight; y++)
        for (int x = 0; x < kOverlayWidth; x++) countMirrors(x, y);
    INFO(high << " of " << mirrors << " mirror pixels");
    CHECK(mirrors > 10);
    CHECK(2 * high > mirrors);
}

TEST_CASE("the first view says how the samples and the kernels lie", "[gpu]")
{
    constexpr int kLarge = 320; // cells of 80 x 80, squares of 32 pixels with a margin of 1.6
    Harness harness(kLarge, kLarge);
    const Frame frame = makeOverlayFrame(0, 0.0f, kLarge, kLarge);
    for (int i = 0; i < 2; i++)
        harness.denoise(frame,
                        [&](nrd::CommonSettings& common)
                        {
                            common.enableValidation = true;
                            common.cameraJitter[0] = 0.25f;
                            common.cameraJitter[1] = -0.375f;
                            common.cameraJitterPrev[0] = -0.25f;
                        });
    const auto at = [&](double x, double y, bool isLeft) // in [-1; 1] of a square, y down
    {
        const double column = isLeft ? 1.6 + 16.0 * (x + 1.0) : 80.0 - 1.6 - 16.0 * (1.0 - x);
        const double row = 80.0 - 1.6 - 16.0 * (1.0 - y);
        return harness.overlay()[static_cast<size_t>(int(row) * kLarge + int(column))];
    };
    CHECK(at(0.5, -0.75, true) == glm::u8vec4(255));
    CHECK(std::abs(int(at(-0.5, 0.0, true).x) - 127.5) < 1.0); // half way between two steps, devices round either way
    CHECK(at(0.5, 0.5, true) == kOverlayBlack);
    const double angle = std::fmod(std::sqrt(1.0 / 3.0) + 10368889.0 / 16777216.0, 1.0) * 1.5707963; // of frame 1
    CHECK(at(0.85 * std::cos(angle), 0.85 * std::sin(angle), false) == glm::u8vec4(255));
    CHECK(at(-0.85 * std::sin(angle), 0.85 * std::cos(angle), false) == glm::u8vec4(255));
    CHECK(at(0.0, 0.0, false) == kOverlayBlack);
}

TEST_CASE("views that are large enough are labelled", "[gpu]")
{
    constexpr int kLargeWidth = 208, kLargeHeight = 180; // cells of 52 x 45: text at one pixel a dot
    Harness harness(kLargeWidth, kLargeHeight);
    runOverlay(harness, 2, 0.0f);
    // "DE" of "DEPTH" at the third cell's corner, one pixel of margin.
    const char* const kText[] = {"##. ###", "#.# #..", "#.# ##.", "#.# #..", "##. ###"};
    for (int y = 0; y < 5; y++)
    {
        for (int x = 0; x < 7; x++)
        {
            const size_t i = static_cast<size_t>((y + 1) * kLargeWidth + 104 + x + 1);
            INFO("dot " << x << ", " << y);
            CHECK(harness.overlay()[i] == (kText[y][x] == '#' ? glm::u8vec4(255) : kOverlayBlack));
        }
    }
}
