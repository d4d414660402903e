// What the overlay must show, computed here: where each view lies, which pixel it shows, and in which colour; and the
// frames on which it is tried.
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
void requireView(const Harness& harness, int view, int tolerance, const ExpectedColor& expected);
void requireNothing(const Harness& harness, int view);

// Cells of 32 x 18 pixels: no text, and each of their pixels shows one that wrote its virtual amount.
constexpr int kOverlayWidth = 128, kOverlayHeight = 72;
constexpr size_t kOverlayCount = size_t(kOverlayWidth) * kOverlayHeight;
constexpr int kLegendTop = 17; // line of a cell at which the last 5 % begin

bool isSky(const Frame& frame, size_t i);
Frame makeOverlayFrame(int index, float speed, int width = kOverlayWidth, int height = kOverlayHeight);

// The last of several frames alone has the overlay, and may be changed.
void runOverlay(Harness& harness, int frames, float speed, const std::function<void(Frame&)>& change = {});

// Black in the sky, elsewhere as the function of the source pixel says.
ExpectedColor onSurfaces(const Frame& frame, std::function<glm::u8vec4(size_t)> color);
} // namespace quality
