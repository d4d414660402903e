// Means and deviations of rows of five texels, of which a group of 8x16 makes those of its 5x5 windows: of PAIR_NUM pairs
// of lumas, the first of which are not negative. Needs gIn_ViewZ and what readLumas() reads.
#ifndef LUMA_ROWS_GLSL
#define LUMA_ROWS_GLSL
#include "luma_window.glsl"

const uint kInvalidTexel = 0xBC00BC00u; // kInvalid, twice

// A group may hold only a small share of a multiprocessor's shared memory, or too few of them run side by side to hide
// latencies. So all is kept as half floats, like the lumas themselves.
shared uint sTexels[PAIR_NUM][kHalo.y][kHalo.x];
// Of the valid ones of five texels of a row, the first of which is at this place.
shared uint sMeans[PAIR_NUM][kHalo.y][8];
shared uint sDeviations[PAIR_NUM][kHalo.y][8];

void readLumas(ivec2 pixel, out vec2 lumas[PAIR_NUM]);

// Unrolled and without a branch, so that all reads are under way at once; the last texel is loaded repeatedly.
void loadTexels(ivec2 group)
{
    const int kNum = kHalo.x * kHalo.y;
    [[unroll]] for (int first = 0; first < kNum; first += 128)
    {
        int i = min(first + int(gl_LocalInvocationIndex), kNum - 1);
        ivec2 local = ivec2(i % kHalo.x, i / kHalo.x);
        ivec2 pixel = group + local - kRadius;
        ivec2 inside = clampToRect(pixel);
        float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(inside), 0).x);
        bool isUsed = pixel == inside && isInRange(viewZ);
        vec2 lumas[PAIR_NUM];
        readLumas(inside, lumas);
        [[unroll]] for (int pair = 0; pair < PAIR_NUM; pair++)
            sTexels[pair][local.y][local.x] = isUsed ? packHalf2x16(lumas[pair]) : kInvalidTexel;
    }
}

bool isValidTexel(ivec2 at) { return sTexels[0][at.y][at.x] != kInvalidTexel; }

vec2 texelAt(int pair, ivec2 at) { return unpackHalf2x16(sTexels[pair][at.y][at.x]); }

// Lumas and deviations have no signs: three of them hold the number of valid texels.
uint countInSignsOfMeans(uint count) { return (count & 1u) << 15 | (count & 2u) << 30; }
uint countInSignsOfDeviations(uint count) { return (count & 4u) << 13; }

float rowCount(ivec2 at)
{
    uint means = sMeans[0][at.y][at.x], deviations = sDeviations[0][at.y][at.x];
    return float((means >> 15 & 1u) | (means >> 30 & 2u) | (deviations >> 13 & 4u));
}

vec2 rowMean(int pair, ivec2 at)
{
    vec2 mean = unpackHalf2x16(sMeans[pair][at.y][at.x]);
    return pair == 0 ? abs(mean) : mean;
}

// Of five texels; sum of the squares of differences from the mean.
vec2 rowSquares(int pair, ivec2 at)
{
    vec2 deviation = unpackHalf2x16(sDeviations[pair][at.y][at.x]);
    return 5.0 * deviation * deviation;
}

// Differences from the row's own mean: sums of squares have no digits left for a variance on bright flat walls, or
// beside a firefly.
void measureRow(ivec2 first)
{
    float isUsed[5], count = 0.0;
    [[unroll]] for (int x = 0; x < 5; x++)
    {
        isUsed[x] = isValidTexel(first + ivec2(x, 0)) ? 1.0 : 0.0;
        count += isUsed[x];
    }
    [[unroll]] for (int pair = 0; pair < PAIR_NUM; pair++)
    {
        vec2 lumas[5], mean = vec2(0.0), squares = vec2(0.0);
        [[unroll]] for (int x = 0; x < 5; x++)
        {
            lumas[x] = texelAt(pair, first + ivec2(x, 0));
            mean += isUsed[x] * lumas[x];
        }
        mean /= max(count, 1.0);
        [[unroll]] for (int x = 0; x < 5; x++) squares += isUsed[x] * (lumas[x] - mean) * (lumas[x] - mean);
        uint signs = pair == 0 ? uint(count) : 0u;
        sMeans[pair][first.y][first.x] = packHalf2x16(mean) | countInSignsOfMeans(signs);
        sDeviations[pair][first.y][first.x] = packHalf2x16(sqrt(squares / 5.0)) | countInSignsOfDeviations(signs);
    }
}

// Has barriers.
void measureRows(ivec2 group)
{
    loadTexels(group);
    barrier();
    for (int i = int(gl_LocalInvocationIndex); i < 8 * kHalo.y; i += 128) measureRow(ivec2(i % 8, i / 8));
    barrier();
}

struct Spread
{
    vec2 mean;
    vec2 sigma;
};

#endif
