#include "overlay_model.h"
#include "catch.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace quality
{
OverlayPixel overlayPixel(int x, int y, int width, int height)
{
    const glm::ivec2 size(width, height);
    const glm::ivec2 centre = (2 * glm::ivec2(x, y) + 1) * 2; // times 4 / 2: four cells, half pixels
    const glm::ivec2 cell = centre / size, source = centre % size;
    OverlayPixel pixel;
    pixel.view = cell.y * 4 + cell.x;
    pixel.uv = glm::dvec2(source) / glm::dvec2(size);
    pixel.inView = source / 4;
    pixel.source = static_cast<size_t>(source.y) * static_cast<size_t>(width) + static_cast<size_t>(source.x);
    return pixel;
}

glm::u8vec4 toBytes(glm::dvec3 color)
{
    const glm::dvec3 bytes = glm::clamp(color, 0.0, 1.0) * 255.0 + 0.5;
    return glm::u8vec4(glm::u8vec3(bytes), 255);
}

glm::u8vec4 rainbowBytes(double share)
{
    const double t = 3.5 - 3.0 * std::clamp(share, 0.0, 1.0);
    return toBytes(1.5 - glm::abs(t - glm::dvec3(3.0, 2.0, 1.0)));
}

std::vector<glm::dvec3> worldPositions(const Guides& guides, int width, int height)
{
    const glm::dmat4 viewToWorld = glm::inverse(glm::dmat4(guides.camera.worldToView));
    const glm::dmat4 clipToView = glm::inverse(glm::dmat4(guides.camera.viewToClip));
    std::vector<glm::dvec3> positions;
    for (int y = 0; y < height; y++)
    {
        for (int x = 0; x < width; x++)
        {
            const glm::dvec2 uv = (glm::dvec2(x, y) + 0.5) / glm::dvec2(width, height);
            const glm::dvec4 target = clipToView * glm::dvec4(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, 0.5, 1.0);
            const glm::dvec3 ray = glm::dvec3(target) / target.z; // z = 1
            const double viewZ = guides.viewZ[positions.size()];
            positions.push_back(glm::dvec3(viewToWorld * glm::dvec4(ray * viewZ, 1.0)));
        }
    }
    return positions;
}

glm::dvec2 screenPosition(const Camera& camera, glm::dvec3 position, int width, int height)
{
    const glm::dvec4 clip =
        glm::dmat4(camera.viewToClip) * (glm::dmat4(camera.worldToView) * glm::dvec4(position, 1.0));
    return (glm::dvec2(0.5, -0.5) * glm::dvec2(clip) / clip.w + 0.5) * glm::dvec2(width, height);
}

Comparison compareView(const Harness& harness, int view, int tolerance, const ExpectedColor& expected)
{
    Comparison result;
    for (int y = 0; y < harness.height(); y++)
    {
        for (int x = 0; x < harness.width(); x++)
        {
            const OverlayPixel pixel = overlayPixel(x, y, harness.width(), harness.height());
            if (pixel.view != view) continue;
            const glm::u8vec4 a = harness.overlay()[static_cast<size_t>(y * harness.width() + x)], b = expected(pixel);
            int worst = 0;
            for (int c = 0; c < 4; c++) worst = std::max(worst, std::abs(int(a[c]) - int(b[c])));
            result.compared++;
            result.different += worst > tolerance ? 1 : 0;
            result.worst = std::max(result.worst, worst);
        }
    }
    return result;
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

bool isSky(const Frame& frame, size_t i) { return !(std::abs(frame.guides.viewZ[i]) < kDenoisingRange); }

Frame makeOverlayFrame(int index, float speed, int width, int height)
{
    const size_t count = static_cast<size_t>(width) * static_cast<size_t>(height);
    const Signal constant(count, glm::vec4(1.0f, 0.0f, 0.0f, 0.37f));
    return {renderGuides(makeCamera(index, speed, width, height), width, height), constant, constant};
}

void runOverlay(Harness& harness, int frames, float speed, const std::function<void(Frame&)>& change)
{
    for (int i = 0; i < frames; i++)
    {
        Frame frame = makeOverlayFrame(i, speed, harness.width(), harness.height());
        const bool isLast = i + 1 == frames;
        if (isLast && change) change(frame);
        harness.denoise(frame, [=](nrd::CommonSettings& common) { common.enableValidation = isLast; });
    }
}

ExpectedColor onSurfaces(const Frame& frame, std::function<glm::u8vec4(size_t)> color)
{
    return [&frame, color](const OverlayPixel& p) { return isSky(frame, p.source) ? kOverlayBlack : color(p.source); };
}
} // namespace quality
