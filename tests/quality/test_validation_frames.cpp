// The validation overlay over resets, rectangles, variants and sizes: written where and when it should be.
#include "catch.h"
#include "overlay_model.h"
#include <cmath>
#include <string_view>

using namespace quality;

namespace
{
constexpr glm::u8vec4 kPoison(12, 34, 56, 78);

struct VariantRow
{
    nrd::Denoiser denoiser;
    bool hasDiffuse, hasSpecular;
};

constexpr VariantRow kVariants[] = {
    {nrd::Denoiser::REBLUR_DIFFUSE, true, false},
    {nrd::Denoiser::REBLUR_DIFFUSE_OCCLUSION, true, false},
    {nrd::Denoiser::REBLUR_DIFFUSE_SH, true, false},
    {nrd::Denoiser::REBLUR_SPECULAR, false, true},
    {nrd::Denoiser::REBLUR_SPECULAR_OCCLUSION, false, true},
    {nrd::Denoiser::REBLUR_SPECULAR_SH, false, true},
    {nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR, true, true},
    {nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR_OCCLUSION, true, true},
    {nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR_SH, true, true},
    {nrd::Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION, true, false},
};
} // namespace

TEST_CASE("after a reset the overlay is all 0", "[gpu]")
{
    Harness harness(kOverlayWidth, kOverlayHeight);
    for (int i = 0; i < 4; i++)
    {
        const bool isReset = i == 0 || i == 2;
        harness.poisonOverlay(kPoison);
        harness.denoise(makeOverlayFrame(i, 0.02f),
                        [&](nrd::CommonSettings& common)
                        {
                            common.enableValidation = true;
                            if (i == 2) common.accumulationMode = nrd::AccumulationMode::RESTART;
                        });
        size_t nothing = 0;
        for (const glm::u8vec4& v : harness.overlay()) nothing += v == kOverlayNothing ? 1 : 0;
        CHECK((nothing == kOverlayCount) == isReset);
    }
}

TEST_CASE("the overlay stays inside the rectangle and shows guides from its origin", "[gpu]")
{
    constexpr int kRectWidth = 64, kRectHeight = 40, kOriginX = 8, kOriginY = 4;
    Harness harness(kOverlayWidth, kOverlayHeight);
    const Frame frame = makeOverlayFrame(0, 0.0f);
    harness.poisonOverlay(kPoison);
    for (int i = 0; i < 2; i++)
        harness.denoise(frame,
                        [&](nrd::CommonSettings& common)
                        {
                            common.enableValidation = true;
                            common.rectSize[0] = common.rectSizePrev[0] = kRectWidth;
                            common.rectSize[1] = common.rectSizePrev[1] = kRectHeight;
                            common.rectOrigin[0] = kOriginX;
                            common.rectOrigin[1] = kOriginY;
                        });
    size_t wrong = 0, compared = 0;
    for (int y = 0; y < kOverlayHeight; y++)
    {
        for (int x = 0; x < kOverlayWidth; x++)
        {
            const glm::u8vec4 shown = harness.overlay()[static_cast<size_t>(y * kOverlayWidth + x)];
            const bool isInside = x < kRectWidth && y < kRectHeight;
            wrong += isInside == (shown == kPoison) ? 1 : 0;
            const OverlayPixel p = overlayPixel(x, y, kRectWidth, kRectHeight);
            if (!isInside || p.view != kRoughness) continue;
            const size_t row = p.source / kRectWidth + kOriginY, column = p.source % kRectWidth + kOriginX;
            const size_t guide = row * kOverlayWidth + column;
            const glm::u8vec4 expected =
                isSky(frame, guide) ? kOverlayBlack : toBytes(glm::dvec3(frame.guides.roughness[guide]));
            wrong += std::abs(int(shown.r) - int(expected.r)) > 1 ? 1 : 0;
            compared++;
        }
    }
    CHECK(compared == kRectWidth * kRectHeight / 16);
    CHECK(wrong == 0);
}

TEST_CASE("every denoiser shows the lobes it has", "[gpu]")
{
    for (const VariantRow& row : kVariants)
    {
        INFO(nrd::toString(row.denoiser));
        Harness harness(kOverlayWidth, kOverlayHeight, {}, row.denoiser);
        Frame frame;
        for (int i = 0; i < 4; i++)
        {
            frame = makeOverlayFrame(i, 0.0f);
            frame.diffuse.assign(kOverlayCount, glm::vec4(0.25f, 0.0f, 0.0f, 0.25f)); // occlusion is in the first
            frame.specular.assign(kOverlayCount, glm::vec4(0.75f, 0.0f, 0.0f, 0.75f));
            harness.denoise(frame, [](nrd::CommonSettings& common) { common.enableValidation = true; });
        }
        const auto grey = [&](double h) { return onSurfaces(frame, [=](size_t) { return toBytes(glm::dvec3(h)); }); };
        const bool isRelax = std::string_view(nrd::toString(row.denoiser)).starts_with("RELAX");
        const double longest =
            isRelax ? nrd::RelaxSettings().diffuseMaxAccumulatedFrameNum : nrd::ReblurSettings().maxAccumulatedFrameNum;
        const auto length = [&](const OverlayPixel& p)
        {
            if (p.inView.y >= kLegendTop) return rainbowBytes(p.uv.x);
            return isSky(frame, p.source) ? kOverlayBlack : rainbowBytes(3.0 / longest);
        };
        const ExpectedColor nothing = [](const OverlayPixel&) { return kOverlayNothing; };
        requireView(harness, kDiffuseHitDist, 1, row.hasDiffuse ? grey(0.25) : nothing);
        requireView(harness, kSpecularHitDist, 1, row.hasSpecular ? grey(0.75) : nothing);
        requireView(harness, kDiffuseLength, 1, row.hasDiffuse ? ExpectedColor(length) : nothing);
        requireView(harness, kSpecularLength, 1, row.hasSpecular ? ExpectedColor(length) : nothing);
        requireView(harness, kVirtualAmount, 0, row.hasSpecular ? grey(0.0) : nothing);
        requireView(harness, kMotion, 0, grey(0.0));
    }
}

TEST_CASE("where only the input is shown there is no history, but the guides are", "[gpu]")
{
    Harness harness(kOverlayWidth, kOverlayHeight);
    const Frame frame = makeOverlayFrame(0, 0.0f);
    for (int i = 0; i < 2; i++)
        harness.denoise(frame,
                        [&](nrd::CommonSettings& common)
                        {
                            common.enableValidation = true;
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
        runOverlay(harness, 3, 0.0f);
        const Frame frame = makeOverlayFrame(0, 0.0f, size[0], size[1]);
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
    Harness with(kOverlayWidth, kOverlayHeight), without(kOverlayWidth, kOverlayHeight);
    for (int i = 0; i < 6; i++)
    {
        const Frame frame = makeOverlayFrame(i, 0.04f);
        with.denoise(frame, [](nrd::CommonSettings& common) { common.enableValidation = true; });
        without.denoise(frame);
    }
    CHECK(with.diffuse() == without.diffuse());
    CHECK(with.specular() == without.specular());
}
