// Where the views of the overlay lie, what they are called, and the colours they speak in.
#ifndef VALIDATION_VIEWS_GLSL
#define VALIDATION_VIEWS_GLSL
#include "spatial_filter.glsl"
#include "text.glsl"

const int kGridSize = 4;
const int kViewWorld = 0, kViewRoughness = 1, kViewDepth = 2, kViewMotion = 3, kViewNormal = 4;
const int kViewVirtualAmount = 7, kViewDiffuseLength = 8, kViewSpecularLength = 11;
const int kViewDiffuseHitDist = 12, kViewSpecularHitDist = 15;

const vec4 kNothing = vec4(0.0);
const vec4 kBlack = vec4(0.0, 0.0, 0.0, 1.0); // sky, where there is nothing to show
const vec4 kRed = vec4(1.0, 0.0, 0.0, 1.0);
const vec4 kMagenta = vec4(1.0, 0.0, 1.0, 1.0); // a value that must not occur

// One cell of the grid, as one of its pixels sees it.
struct View
{
    int index;
    ivec2 pixel;  // from the cell's top left corner
    vec2 size;    // pixels
    vec2 uv;      // in the cell
    ivec2 source; // the pixel of the rectangle that is shown here
};

View makeView(ivec2 pixel)
{
    // In whole numbers: a pixel's centre often falls on the border between two source pixels.
    ivec2 size = ivec2(g.rectSize);
    ivec2 centre = pixel * kGridSize + kGridSize / 2; // in source pixels, the cells side by side
    ivec2 cell = centre / size;
    View v;
    v.index = cell.y * kGridSize + cell.x;
    v.source = centre - cell * size;
    v.pixel = v.source / kGridSize;
    v.uv = vec2(v.source) * g.rectSizeInv;
    v.size = g.rectSize / float(kGridSize);
    return v;
}

uint[kLabelLength] labelOf(int view)
{
    switch (view)
    {
    case kViewWorld: return uint[](kW, kO, kR, kL, kD, kBlank, kU, kN, kI, kT, kS, kBlank);
    case kViewRoughness: return uint[](kR, kO, kU, kG, kH, kN, kE, kS, kS, kBlank, kBlank, kBlank);
    case kViewDepth: return uint[](kD, kE, kP, kT, kH, kBlank, kBlank, kBlank, kBlank, kBlank, kBlank, kBlank);
    case kViewMotion: return uint[](kM, kO, kT, kI, kO, kN, kBlank, kE, kR, kR, kO, kR);
    case kViewNormal: return uint[](kN, kO, kR, kM, kA, kL, kS, kBlank, kBlank, kBlank, kBlank, kBlank);
    case kViewVirtualAmount: return uint[](kV, kI, kR, kT, kU, kA, kL, kBlank, kBlank, kBlank, kBlank, kBlank);
    case kViewDiffuseLength: return uint[](kD, kI, kF, kF, kBlank, kF, kR, kA, kM, kE, kS, kBlank);
    case kViewSpecularLength: return uint[](kS, kP, kE, kC, kBlank, kF, kR, kA, kM, kE, kS, kBlank);
    case kViewDiffuseHitDist: return uint[](kD, kI, kF, kF, kBlank, kH, kI, kT, kD, kI, kS, kT);
    }
    return uint[](kS, kP, kE, kC, kBlank, kH, kI, kT, kD, kI, kS, kT);
}

// Screen pixels per texel of the font; 0 = the cell is too small for text.
int textScale(View v)
{
    return min(int(v.size.x) / ((kLabelLength + 1) * kAdvance), int(v.size.y) / 45);
}

// White on black; texels is the size of the box.
void drawInk(bool isInk, ivec2 texel, ivec2 texels, inout vec4 color)
{
    bool isBox = all(greaterThanEqual(texel, ivec2(-1))) && all(lessThanEqual(texel, texels));
    if (isBox) color = isInk ? vec4(1.0) : kBlack;
}

void drawLabel(View v, inout vec4 color)
{
    int scale = textScale(v);
    if (scale == 0) return;
    uint label[kLabelLength] = labelOf(v.index);
    ivec2 texel = v.pixel / scale - 1;
    drawInk(isLabelInk(label, texel), texel, ivec2(labelLength(label) * kAdvance - 1, kGlyphSize.y), color);
}

// topLeft: pixels of the cell.
void drawNumber(View v, uint number, ivec2 topLeft, inout vec4 color)
{
    int scale = textScale(v);
    if (scale == 0) return;
    ivec2 texel = ivec2(floor(vec2(v.pixel - topLeft) / float(scale)));
    drawInk(isNumberInk(number, texel), texel, ivec2(number >= 10u ? 7 : 3, kGlyphSize.y), color);
}

// Red at 0 over yellow, green and cyan to blue at 1.
vec3 rainbow(float share)
{
    float t = mix(3.5, 0.5, saturate(share));
    return clamp(1.5 - abs(t - vec3(3.0, 2.0, 1.0)), 0.0, 1.0);
}

// What must lie in [0; 1].
vec4 greyOf(float x) { return NRD_IsFinite(x) && x >= 0.0 && x <= 1.0 ? vec4(vec3(x), 1.0) : kMagenta; }

//----------------------------------------------------------------------------------------------------------------------
// Two squares in the corners of the first view; p is in [-1; 1]

const float kDotRadius = 0.09;
const float kKernelStep = 1.5707963 * 10368889.0 / 16777216.0; // the kernels turn by this from frame to frame
const int kKernelFrameNum = 8;

// The square is a pixel: this frame's sample white, last frame's grey.
vec3 jitterColor(vec2 p)
{
    if (distance(p, 2.0 * g.cameraJitter.xy) < kDotRadius) return vec3(1.0);
    if (distance(p, 2.0 * g.cameraJitter.zw) < kDotRadius) return vec3(0.5);
    return min(abs(p.x), abs(p.y)) < 0.02 ? vec3(0.25) : vec3(0.0);
}

// The taps of the blur: this frame's white, the seven before it ever darker.
vec3 kernelColor(vec2 p)
{
    for (int age = 0; age < kKernelFrameNum; age++)
    {
        float angle = -kKernelStep * float(age);
        vec4 turn = vec4(cos(angle), sin(angle), -sin(angle), cos(angle));
        for (int i = 0; i < 8; i++)
        {
            vec2 tap = 0.85 * rotateTap(g.rotatorBlur, rotateTap(turn, kTaps[i].xy));
            if (distance(p, tap) >= kDotRadius) continue;
            return age == 0 ? vec3(1.0) : vec3(0.0, 0.5, 1.0) * (1.0 - 0.1 * float(age));
        }
    }
    return vec3(0.0);
}

void drawMiniViews(View v, inout vec4 color)
{
    const float kMargin = 0.05;
    float side = 0.4 * min(v.size.x, v.size.y);
    vec2 fromCorner = vec2(min(v.uv.x, 1.0 - v.uv.x), 1.0 - v.uv.y) * v.size - kMargin * side;
    if (any(lessThan(fromCorner, vec2(0.0))) || any(greaterThan(fromCorner, vec2(side)))) return;
    vec2 p = 2.0 * fromCorner / side - 1.0;
    bool isLeft = v.uv.x < 0.5;
    vec2 upright = vec2(isLeft ? p.x : -p.x, -p.y);
    color = vec4(isLeft ? jitterColor(upright) : kernelColor(upright), 1.0);
    if (max(abs(p.x), abs(p.y)) > 0.96) color = vec4(vec3(0.5), 1.0);
}

#endif
