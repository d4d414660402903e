// Fills a pixel of a short history from a sparse 5x5, in which taps that already have history count for more.
// Needs gIn_Length.
#ifndef SPARSE_FILL_GLSL
#define SPARSE_FILL_GLSL
#include "spatial_filter.glsl"

// What a tap is compared with.
struct Fill
{
    Pixel p;
    Lobe lobe;
    bool isSpecular;
    Weights w;
    float hitDist; // normalised; REBLUR's
    int stride;    // pixels between taps
};

struct FillSum
{
    Signal signal;
    float weight;
};

// Of one tap, by guides and signals: the family's.
float fillWeight(Fill f, ivec2 offset, ivec2 pixel, Signal value);

void addFillTap(inout FillSum sum, Fill f, texture2D t, texture2D second, ivec2 offset)
{
    ivec2 pixel = mirrorPixel(ivec2(f.p.position) + offset * f.stride);
    Signal value = readSignal(t, second, pixel);
    vec2 n = unpackLengths(texelFetch(gIn_Length, pixel, 0).xy);
    float weight = fillWeight(f, offset, pixel, value);
    weight *= offset != ivec2(0) ? 1.0 + n[f.isSpecular ? kSpecularChannel : 0] : 0.0;
    sum.signal = addWeighted(sum.signal, value, weight);
    sum.weight += weight > 0.0 ? weight : 0.0; // not NaN
}

Signal fillSparsely(Fill f, texture2D t, texture2D second, Signal centre, float n)
{
    FillSum sum = FillSum(scaled(centre, 1.0 + n), 1.0 + n);
    if (kIsSoftware)
    {
        // A processor runs through the body of a loop once even where there is nothing to fill.
        [[dont_unroll]] for (int i = 0; i < 25; i++) addFillTap(sum, f, t, second, ivec2(i % 5, i / 5) - 2);
    }
    else
    {
        // Row by row, without a branch round a read, so that those of a row are under way at once.
        [[dont_unroll]] for (int y = -2; y <= 2; y++)
        [[unroll]] for (int x = -2; x <= 2; x++) addFillTap(sum, f, t, second, ivec2(x, y));
    }
    return scaled(sum.signal, 1.0 / sum.weight);
}

#endif
