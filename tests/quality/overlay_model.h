// What the overlay must show, computed here: where each view lies, which pixel it shows, and in which colour.
#pragma once
#include "harness.h"
#include <functional>

namespace quality
{
enum OverlayView
{
    kWorld = 0,
    kRoughness = 1,
    kDepth = 2,
    kMotion = 3,
    kNormals = 4,
    kVirtualAmount = 7,
    kDiffuseLength = 8,
    kSpecularLength = 11,
    kDiffuseHitDist = 12,
    kSpecularHitDist = 15
};

constexpr glm::u8vec4 kOverlayNothing(0, 0, 0, 0), kOverlayBlack(0, 0, 0, 255), kOverlayRed(255, 0, 0, 255);
constexpr glm::u8vec4 kOverlayMagenta(255, 0, 255, 255);

// A pixel of the overlay and what it belongs to.
struct OverlayPixel
{
    int view = 0;
    glm::ivec2 inView{0}; // from the view's top left corner
    glm::dvec2 uv{0.0};   // in the view
    size_t source = 0;    // index of the pixel it shows, in a picture of the rectangle's size
};
OverlayPixel overlayPixel(int x, int y, int width, int height);

glm::u8vec4 toBytes(glm::dvec3 color); // opaque
glm::u8vec4 rainbowBytes(double share);

// World position of each pixel.
std::vector<glm::dvec3> worldPositions(const Guides& guides, int width, int height);
// Pixels on the screen of a camera; y down.
glm::dvec2 screenPosition(const Camera& camera, glm::dvec3 position, int width, int height);

using ExpectedColor = std::function<glm::u8vec4(const OverlayPixel&)>;

struct Comparison
{
    size_t compared = 0;
    size_t different = 0; // by more than the tolerance in any channel
    int worst = 0;
};
Comparison compareView(const Harness& harness, int view, int tolerance, const ExpectedColor& expected);
} // namespace quality
