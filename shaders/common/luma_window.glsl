// Means and variances of lumas over windows of 6x6 pixels, a quad of 2x2 and the eight round it. The pixels of a quad
// share theirs, so a group of 8x16 sums up no more than 60 quads and 32 windows.
// Needs CHANNEL_NUM, the number of lumas of a pixel, and gIn_ViewZ.
#ifndef LUMA_WINDOW_GLSL
#define LUMA_WINDOW_GLSL
#include "denoiser.glsl"
#include "history.glsl"

const float kWindowSize = 36.0;
const float kRingSize = 32.0; // without the own quad

const ivec2 kQuads = ivec2(4, 8); // of a group
const int kWindowNum = kQuads.x * kQuads.y;
const ivec2 kQuadArea = kQuads + 2;
const int kQuadNum = kQuadArea.x * kQuadArea.y;

// Mean and sum of the squares of differences from it, since sums of squares have no digits left for a variance on
// bright flat walls, or beside a firefly; and, the same for all channels, how many texels are in range.
shared vec2 sQuads[CHANNEL_NUM][kQuadNum];
shared float sQuadCounts[kQuadNum];
shared vec2 sRings[CHANNEL_NUM][kWindowNum];
shared float sRingCounts[kWindowNum];

struct Spread
{
    float mean;
    float squares;
    float count;
};

Spread join(Spread a, Spread b)
{
    float count = a.count + b.count, way = b.mean - a.mean, share = b.count / max(count, 1.0);
    return Spread(a.mean + share * way, a.squares + b.squares + a.count * share * way * way, count);
}

// A vector over the four texels of a quad for each channel. Texels out of range may hold anything.
struct Quad
{
    vec4 channels[CHANNEL_NUM];
};

// uv: of the middle of the quad, for textureGather.
Quad readQuad(vec2 uv);

// 1 = in range.
vec4 findUsed(ivec2 first)
{
    vec4 isUsed;
    [[unroll]] for (int i = 0; i < 4; i++)
    {
        ivec2 pixel = first + ivec2(i & 1, i >> 1), inside = clampToRect(pixel);
        float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(inside), 0).x);
        isUsed[i] = pixel == inside && isInRange(viewZ) ? 1.0 : 0.0;
    }
    return isUsed;
}

void measureQuad(ivec2 group, int i)
{
    ivec2 first = group + 2 * (ivec2(i % kQuadArea.x, i / kQuadArea.x) - 1);
    vec4 isUsed = findUsed(first);
    Quad quad = readQuad((vec2(first) + 1.0) * g.resourceSizeInv);
    float count = dot(isUsed, vec4(1.0)), share = 1.0 / max(count, 1.0);
    [[unroll]] for (int c = 0; c < CHANNEL_NUM; c++)
    {
        vec4 used = mix(vec4(0.0), quad.channels[c], greaterThan(isUsed, vec4(0.0))); // selected: not NaN
        float mean = dot(used, vec4(share));
        vec4 apart = (used - mean) * isUsed;
        sQuads[c][i] = vec2(mean, dot(apart, apart));
    }
    sQuadCounts[i] = count;
}

Spread quadAt(int channel, int i) { return Spread(sQuads[channel][i].x, sQuads[channel][i].y, sQuadCounts[i]); }

int quadIndex(int window) { return (window / kQuads.x + 1) * kQuadArea.x + window % kQuads.x + 1; }

// The eight quads round a window's own.
void measureRing(int channel, int window)
{
    Spread quads[8];
    float sum = 0.0, count = 0.0;
    [[unroll]] for (int i = 0; i < 8; i++)
    {
        int place = i + i / 4; // skips the fifth
        quads[i] = quadAt(channel, quadIndex(window) + (place / 3 - 1) * kQuadArea.x + place % 3 - 1);
        sum += quads[i].count * quads[i].mean;
        count += quads[i].count;
    }
    float mean = sum / max(count, 1.0), squares = 0.0;
    [[unroll]] for (int i = 0; i < 8; i++)
    {
        float apart = quads[i].mean - mean;
        squares += quads[i].squares + quads[i].count * apart * apart;
    }
    sRings[channel][window] = vec2(mean, squares);
    if (channel == 0) sRingCounts[window] = count;
}

// Has barriers.
void measureWindows(ivec2 group)
{
    for (int i = int(gl_LocalInvocationIndex); i < kQuadNum; i += 128) measureQuad(group, i);
    barrier();
    for (int i = int(gl_LocalInvocationIndex); i < CHANNEL_NUM * kWindowNum; i += 128)
        measureRing(i / kWindowNum, i % kWindowNum);
    barrier();
}

int windowIndex()
{
    ivec2 quad = ivec2(gl_LocalInvocationID.xy) / 2;
    return quad.y * kQuads.x + quad.x;
}

Spread ringOf(int channel)
{
    int i = windowIndex();
    return Spread(sRings[channel][i].x, sRings[channel][i].y, sRingCounts[i]);
}

Spread windowOf(int channel) { return join(ringOf(channel), quadAt(channel, quadIndex(windowIndex()))); }

// What is out of range counts as the centre.
Spread filled(Spread s, float size, float centre) { return join(s, Spread(centre, 0.0, size - s.count)); }

float sigmaOf(Spread s) { return sqrt(s.squares / max(s.count, 1.0)); }

#endif
