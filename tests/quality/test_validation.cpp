// Every view of the validation overlay against what it must show, pixel by pixel.
#include "catch.h"
#include "overlay_model.h"
#include <cmath>
#include <limits>

using namespace quality;

namespace
{
// Cells of 32 x 18 pixels: no text, and each of their pixels shows one that wrote its virtual amount.
constexpr int kWidth = 128, kHeight = 72;
constexpr size_t kCount = size_t(kWidth) * kHeight;
constexpr glm::u8vec4 kPoison(12, 34, 56, 78);

void enable(nrd::CommonSettings& common) { common.enableValidation = true; }

bool isSky(const Frame& frame, size_t i) { return !(std::abs(frame.guides.viewZ[i]) < kDenoisingRange); }

Frame makeFrame(int index, float speed, int width = kWidth, int height = kHeight)
{
    const size_t count = static_cast<size_t>(width) * static_cast<size_t>(height);
    const Signal constant(count, glm::vec4(1.0f, 0.0f, 0.0f, 0.37f));
    return {renderGuides(makeCamera(index, speed, width, height), width, height), constant, constant};
}

// The last of several frames; earlier ones run without the overlay, which must not matter.
void run(Harness& harness, int frames, float speed, const std::function<void(Frame&)>& change = {})
{
    for (int i = 0; i < frames; i++)
    {
        Frame frame = makeFrame(i, speed, harness.width(), harness.height());
        const bool isLast = i + 1 == frames;
        if (isLast && change) change(frame);
        harness.denoise(frame, [=](nrd::CommonSettings& common) { common.enableValidation = isLast; });
    }
}

void requireView(const Harness& harness, int view, int tolerance, const ExpectedColor& expected)
{
    const Comparison c = compareView(harness, view, tolerance, expected);
    INFO("view " << view << ": " << c.different << " of " << c.compared << " pixels differ, worst by " << c.worst);
    CHECK(c.compared > 0);
    CHECK(c.different == 0);
}

void requireNothing(const Harness& harness, int view)
{
    requireView(harness, view, 0, [](const OverlayPixel&) { return kOverlayNothing; });
}

// Black in the sky, elsewhere as the function of the source pixel says.
ExpectedColor onSurfaces(const Frame& frame, std::function<glm::u8vec4(size_t)> color)
{
    return [&frame, color](const OverlayPixel& p) { return isSky(frame, p.source) ? kOverlayBlack : color(p.source); };
}
} // namespace

TEST_CASE("the guides are shown as they are", "[gpu]")
{
    Harness harness(kWidth, kHeight);
    run(harness, 3, 0.05f);
    const Frame frame = makeFrame(2, 0.05f);
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
        Harness harness(kWidth, kHeight);
        Frame frame;
        const auto change = [&](Frame& last)
        {
            for (float& z : last.guides.viewZ) z *= sign;
            for (size_t i = 0; i < kCount; i += 7) last.guides.viewZ[i] = nan;
            frame = last;
        };
        run(harness, 2, 0.0f, change);
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
    Harness harness(kWidth, kHeight);
    run(harness, 3, 0.3f);
    const Frame frame = makeFrame(2, 0.3f);
    const std::vector<glm::dvec3> positions = worldPositions(frame.guides, kWidth, kHeight);
    size_t compared = 0, different = 0;
    for (int y = 0; y < kHeight / 4; y++)
    {
        for (int x = 0; x < kWidth / 4; x++)
        {
            const OverlayPixel p = overlayPixel(x, y, kWidth, kHeight);
            if (p.view != kWorld || isSky(frame, p.source) || p.uv.y > 0.5) continue; // below: the two small squares
            const glm::u8vec4 shown = harness.overlay()[static_cast<size_t>(y * kWidth + x)];
            for (int c = 0; c < 3; c++)
            {
                // 0 and 1 are neighbours.
                const double error = shown[c] / 255.0 - positions[p.source][c];
                different += std::abs(error - std::round(error)) > 1.5 / 255.0 ? 1 : 0;
            }
            compared++;
        }
    }
    CHECK(compared > 50);
    CHECK(different == 0);
}

TEST_CASE("the motion of a static scene is no error, whatever the camera does", "[gpu]")
{
    for (const float speed : {0.0f, 0.02f})
    {
        Harness harness(kWidth, kHeight);
        run(harness, 3, speed);
        const Frame frame = makeFrame(2, speed);
        const Camera previous = makeCamera(1, speed, kWidth, kHeight);
        const std::vector<glm::dvec3> positions = worldPositions(frame.guides, kWidth, kHeight);
        requireView(harness, kMotion, 0,
                    onSurfaces(frame,
                               [&](size_t i)
                               {
                                   const glm::dvec2 at = screenPosition(previous, positions[i], kWidth, kHeight);
                                   const bool isInside = at.x >= 0 && at.y >= 0 && at.x < kWidth && at.y < kHeight;
                                   return toBytes({0.0, 0.0, isInside ? 0.0 : 1.0});
                               }));
    }
}

TEST_CASE("wrong motion is shown in pixels, blue where it leads off the screen", "[gpu]")
{
    Harness harness(kWidth, kHeight);
    Frame frame;
    const auto fault = [](size_t i)
    {
        const size_t x = i % kWidth;
        if (x > kWidth / 2) return glm::vec3(0.0f); // right half: correct
        return x < kWidth / 4 ? glm::vec3(500.0f, 0.0f, 0.0f) : glm::vec3(0.03125f, -0.0625f, 0.0f);
    };
    run(harness, 2, 0.0f,
        [&](Frame& last)
        {
            for (size_t i = 0; i < kCount; i++) last.motion.push_back(fault(i));
            frame = last;
        });
    const Camera& camera = frame.guides.camera;
    const std::vector<glm::dvec3> positions = worldPositions(frame.guides, kWidth, kHeight);
    size_t partial = 0;
    const auto expected = [&](size_t i)
    {
        const glm::dvec2 at = screenPosition(camera, positions[i] + glm::dvec3(fault(i)), kWidth, kHeight);
        const glm::dvec2 error = glm::abs(at - screenPosition(camera, positions[i], kWidth, kHeight));
        const bool isInside = at.x >= 0 && at.y >= 0 && at.x < kWidth && at.y < kHeight;
        partial += error.x > 0.1 && error.x < 0.9 ? 1 : 0;
        return toBytes({error.x, error.y, isInside ? 0.0 : 1.0});
    };
    requireView(harness, kMotion, 2, onSurfaces(frame, expected));
    CHECK(partial > 10);
}

TEST_CASE("history lengths run through the rainbow, over a legend", "[gpu]")
{
    const int n = GENERATE(1, 4, 11);
    nrd::ReblurSettings settings;
    settings.maxAccumulatedFrameNum = 9;
    Harness harness(kWidth, kHeight, settings);
    run(harness, n + 1, 0.0f); // the first frame has no history
    const Frame frame = makeFrame(0, 0.0f);
    const auto expected = [&](const OverlayPixel& p)
    {
        if (p.inView.y >= 17) return rainbowBytes(p.uv.x); // the last 5 % of 18 lines
        return isSky(frame, p.source) ? kOverlayBlack : rainbowBytes(std::min(n, 9) / 9.0);
    };
    requireView(harness, kDiffuseLength, 1, expected);
    requireView(harness, kSpecularLength, 1, expected);
}

TEST_CASE("less than one frame of history is checkered", "[gpu]")
{
    nrd::ReblurSettings settings;
    settings.maxAccumulatedFrameNum = settings.maxFastAccumulatedFrameNum = settings.historyFixFrameNum = 0;
    Harness harness(kWidth, kHeight, settings);
    run(harness, 3, 0.0f);
    const Frame frame = makeFrame(0, 0.0f);
    const auto expected = [&](const OverlayPixel& p)
    {
        if (p.inView.y >= 17) return rainbowBytes(p.uv.x);
        const bool isDark = (p.inView.x / 4 + p.inView.y / 4) % 2 == 1;
        return isDark || isSky(frame, p.source) ? kOverlayBlack : kOverlayRed;
    };
    requireView(harness, kDiffuseLength, 0, expected);
    requireView(harness, kSpecularLength, 0, expected);
}

TEST_CASE("hit distances are grey, red at 0, magenta where they cannot be", "[gpu]")
{
    Harness harness(kWidth, kHeight);
    Frame frame;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float values[] = {0.0f, 0.25f, 1.0f, 1.25f, -0.5f, nan};
    const auto change = [&](Frame& last)
    {
        for (size_t i = 0; i < kCount; i++) last.diffuse[i].w = values[(i / 4) % 6];
        for (size_t i = 0; i < kCount; i++) last.specular[i].w = values[(i / 4 + 3) % 6];
        frame = last;
    };
    run(harness, 2, 0.0f, change);
    const auto color = [](float h)
    {
        if (h == 0.0f) return kOverlayRed;
        return h > 0.0f && h <= 1.0f ? toBytes(glm::dvec3(h)) : kOverlayMagenta;
    };
    requireView(harness, kDiffuseHitDist, 1, onSurfaces(frame, [&](size_t i) { return color(frame.diffuse[i].w); }));
    requireView(harness, kSpecularHitDist, 1, onSurfaces(frame, [&](size_t i) { return color(frame.specular[i].w); }));
}

TEST_CASE("the virtual amount is 0 at rest, and high where a mirror is passed by", "[gpu]")
{
    Harness still(kWidth, kHeight);
    run(still, 6, 0.0f);
    const Frame frame = makeFrame(0, 0.0f);
    requireView(still, kVirtualAmount, 0, onSurfaces(frame, [](size_t) { return kOverlayBlack; }));

    Harness moving(kWidth, kHeight);
    run(moving, 12, 0.03f);
    const Frame last = makeFrame(11, 0.03f);
    size_t mirrors = 0, high = 0;
    const auto countMirrors = [&](int x, int y)
    {
        const OverlayPixel p = overlayPixel(x, y, kWidth, kHeight);
        if (p.view != kVirtualAmount || isSky(last, p.source) || last.guides.roughness[p.source] > 0.05f) return;
        mirrors++;
        high += moving.overlay()[static_cast<size_t>(y * kWidth + x)].r > 127 ? 1 : 0;
    };
    for (int y = 0; y < kHeight; y++)
        for (int x = 0; x < kWidth; x++) countMirrors(x, y);
    INFO(high << " of " << mirrors << " mirror pixels");
    CHECK(mirrors > 10);
    CHECK(2 * high > mirrors);
}

TEST_CASE("after a reset the overlay is all 0", "[gpu]")
{
    Harness harness(kWidth, kHeight);
    for (int i = 0; i < 4; i++)
    {
        const bool isReset = i == 0 || i == 2;
        harness.poisonOverlay(kPoison);
        harness.denoise(makeFrame(i, 0.02f),
                        [&](nrd::CommonSettings& common)
                        {
                            enable(common);
                            if (i == 2) common.accumulationMode = nrd::AccumulationMode::RESTART;
                        });
        size_t nothing = 0;
        for (const glm::u8vec4& v : harness.overlay()) nothing += v == kOverlayNothing ? 1 : 0;
        CHECK((nothing == kCount) == isReset);
    }
}

TEST_CASE("the overlay stays inside the rectangle and shows guides from its origin", "[gpu]")
{
    constexpr int kRectWidth = 64, kRectHeight = 40, kOriginX = 8, kOriginY = 4;
    Harness harness(kWidth, kHeight);
    const Frame frame = makeFrame(0, 0.0f);
    harness.poisonOverlay(kPoison);
    for (int i = 0; i < 2; i++)
        harness.denoise(frame,
                        [&](nrd::CommonSettings& common)
                        {
                            enable(common);
                            common.rectSize[0] = common.rectSizePrev[0] = kRectWidth;
                            common.rectSize[1] = common.rectSizePrev[1] = kRectHeight;
                            common.rectOrigin[0] = kOriginX;
                            common.rectOrigin[1] = kOriginY;
                        });
    size_t wrong = 0, compared = 0;
    for (int y = 0; y < kHeight; y++)
    {
        for (int x = 0; x < kWidth; x++)
        {
            const glm::u8vec4 shown = harness.overlay()[static_cast<size_t>(y * kWidth + x)];
            const bool isInside = x < kRectWidth && y < kRectHeight;
            wrong += isInside == (shown == kPoison) ? 1 : 0;
            const OverlayPixel p = overlayPixel(x, y, kRectWidth, kRectHeight);
            if (!isInside || p.view != kRoughness) continue;
            const size_t row = p.source / kRectWidth + kOriginY, column = p.source % kRectWidth + kOriginX;
            const size_t guide = row * kWidth + column;
            const glm::u8vec4 expected =
                isSky(frame, guide) ? kOverlayBlack : toBytes(glm::dvec3(frame.guides.roughness[guide]));
            wrong += std::abs(int(shown.r) - int(expected.r)) > 1 ? 1 : 0;
            compared++;
        }
    }
    CHECK(compared == kRectWidth * kRectHeight / 16);
    CHECK(wrong == 0);
}

TEST_CASE("a denoiser of one lobe shows that lobe", "[gpu]")
{
    for (const bool isDiffuse : {true, false})
    {
        Harness harness(kWidth, kHeight, {},
                        isDiffuse ? nrd::Denoiser::REBLUR_DIFFUSE : nrd::Denoiser::REBLUR_SPECULAR);
        Frame frame;
        const auto change = [&](Frame& last)
        {
            for (glm::vec4& v : last.diffuse) v.w = 0.25f;
            for (glm::vec4& v : last.specular) v.w = 0.75f;
            frame = last;
        };
        run(harness, 4, 0.0f, change);
        const auto grey = onSurfaces(frame, [&](size_t) { return toBytes(glm::dvec3(isDiffuse ? 0.25 : 0.75)); });
        const auto length = [&](const OverlayPixel& p)
        {
            if (p.inView.y >= 17) return rainbowBytes(p.uv.x);
            return isSky(frame, p.source) ? kOverlayBlack : rainbowBytes(3.0 / 30.0);
        };
        requireView(harness, isDiffuse ? kDiffuseHitDist : kSpecularHitDist, 1, grey);
        requireView(harness, isDiffuse ? kDiffuseLength : kSpecularLength, 1, length);
        requireNothing(harness, isDiffuse ? kSpecularHitDist : kDiffuseHitDist);
        requireNothing(harness, isDiffuse ? kSpecularLength : kDiffuseLength);
        if (isDiffuse) requireNothing(harness, kVirtualAmount);
        requireView(harness, kMotion, 0, onSurfaces(frame, [](size_t) { return kOverlayBlack; }));
    }
}

TEST_CASE("where only the input is shown there is no history, but the guides are", "[gpu]")
{
    Harness harness(kWidth, kHeight);
    const Frame frame = makeFrame(0, 0.0f);
    for (int i = 0; i < 2; i++)
        harness.denoise(frame,
                        [&](nrd::CommonSettings& common)
                        {
                            enable(common);
                            common.splitScreen = i == 1 ? 1.0f : 0.0f;
                        });
    for (const int view : {kVirtualAmount, kDiffuseLength, kSpecularLength}) requireNothing(harness, view);
    requireView(harness, kRoughness, 1,
                onSurfaces(frame, [&](size_t i) { return toBytes(glm::dvec3(frame.guides.roughness[i])); }));
}

TEST_CASE("the overlay works at odd sizes", "[gpu]")
{
    const int sizes[][2] = {{1, 1}, {2, 5}, {3, 3}, {17, 9}, {67, 35}};
    for (const auto& size : sizes)
    {
        Harness harness(size[0], size[1]);
        run(harness, 3, 0.0f);
        const Frame frame = makeFrame(0, 0.0f, size[0], size[1]);
        const bool hasAmount =
            size[0] > 2 && size[1] > 2; // one pixel of 4x4, the third from the left and top, tells it
        for (int y = 0; y < size[1]; y++)
        {
            for (int x = 0; x < size[0]; x++)
            {
                const OverlayPixel p = overlayPixel(x, y, size[0], size[1]);
                const bool isGap = p.view == 5 || p.view == 6 || p.view == 9 || p.view == 10 || p.view == 13 ||
                                   p.view == 14 || (p.view == kVirtualAmount && !hasAmount);
                const glm::u8vec4 shown = harness.overlay()[static_cast<size_t>(y * size[0] + x)];
                INFO(size[0] << " x " << size[1] << " at " << x << ", " << y);
                CHECK(int(shown.a) == (isGap ? 0 : 255));
                if (p.view != kDepth) continue;
                CHECK((shown == kOverlayRed) == isSky(frame, p.source));
            }
        }
    }
}

TEST_CASE("the overlay changes nothing of what is denoised", "[gpu]")
{
    Harness with(kWidth, kHeight), without(kWidth, kHeight);
    for (int i = 0; i < 6; i++)
    {
        const Frame frame = makeFrame(i, 0.04f);
        with.denoise(frame, enable);
        without.denoise(frame);
    }
    CHECK(with.diffuse() == without.diffuse());
    CHECK(with.specular() == without.specular());
}

TEST_CASE("the first view says how the samples and the kernels lie", "[gpu]")
{
    constexpr int kLarge = 320; // cells of 80 x 80, squares of 32 pixels with a margin of 1.6
    Harness harness(kLarge, kLarge);
    const Frame frame = makeFrame(0, 0.0f, kLarge, kLarge);
    for (int i = 0; i < 2; i++)
        harness.denoise(frame,
                        [&](nrd::CommonSettings& common)
                        {
                            enable(common);
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
    CHECK(at(-0.5, 0.0, true) == toBytes(glm::dvec3(0.5)));
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
    run(harness, 2, 0.0f);
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
