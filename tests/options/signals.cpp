#include "signals.h"
#include "catch.h"
#include <random>

namespace options
{
namespace
{
using Slot = nrd::ResourceType;

constexpr float kHitDistMean = 0.35f, kOcclusionMean = 0.4f;
const glm::vec3 kDirectionMean(0.3f, 0.8f, 0.3f); // of two with equal chance

// What a path through a pixel found.
struct Sample
{
    float luma = 0.0f;      // 0 or twice the mean
    float hitDist = 0.0f;   // [0.2; 0.5)
    float occlusion = 0.0f; // 0.2 or 0.6, exact in 8 bits
    glm::vec3 direction{0.0f};
};

class SampleSource
{
public:
    SampleSource(const Setup& setup, bool isSpecular, int frameIndex)
        : m_setup(setup), m_noise(noiseOf(setup, frameIndex)), m_rng(2 * m_noise.seed + (isSpecular ? 1 : 0))
    {
    }

    Sample next(float mean)
    {
        Sample s;
        s.luma = flip() ? 2.0f * mean : 0.0f;
        s.hitDist = 0.2f + 0.3f * unit();
        s.occlusion = std::min((flip() ? 0.6f : 0.2f) * mean, 1.0f);
        s.direction = flip() ? glm::vec3(0.6f, 0.8f, 0.0f) : glm::vec3(0.0f, 0.8f, 0.6f);
        const bool isMissing = flip();
        if (!m_setup.isHalfMissing) return s;
        // Divided by the chance to be there.
        return isMissing ? Sample{} : Sample{2.0f * s.luma, s.hitDist, s.occlusion, s.direction};
    }

private:
    float unit() { return static_cast<float>(m_rng() >> 8) * (1.0f / 16777216.0f); }
    bool flip() { return (unit() < 0.5f) != m_noise.isOpposite; }

    const Setup& m_setup;
    Noise m_noise;
    std::mt19937 m_rng;
};

constexpr float kMetersPerHitDist = 4.0f; // RELAX has lengths where REBLUR has shares of one

glm::vec4 radiance(float luma, float hitDist) { return {luma, 0.1f * luma, -0.05f * luma, hitDist}; }

glm::vec3 toRgb(glm::vec3 yCoCg)
{
    return {yCoCg.x - yCoCg.z + yCoCg.y, yCoCg.x + yCoCg.z, yCoCg.x - yCoCg.z - yCoCg.y};
}

glm::vec3 toYCoCg(glm::vec3 rgb)
{
    return {0.25f * (rgb.x + rgb.z) + 0.5f * rgb.y, 0.5f * (rgb.x - rgb.z), 0.5f * rgb.y - 0.25f * (rgb.x + rgb.z)};
}

struct Kind
{
    Slot output;
    bool isSpecular;
};

Kind kindOf(Slot input)
{
    switch (input)
    {
    case Slot::IN_DIFF_RADIANCE_HITDIST:
        return {Slot::OUT_DIFF_RADIANCE_HITDIST, false};
    case Slot::IN_SPEC_RADIANCE_HITDIST:
        return {Slot::OUT_SPEC_RADIANCE_HITDIST, true};
    case Slot::IN_DIFF_HITDIST:
        return {Slot::OUT_DIFF_HITDIST, false};
    case Slot::IN_SPEC_HITDIST:
        return {Slot::OUT_SPEC_HITDIST, true};
    case Slot::IN_DIFF_DIRECTION_HITDIST:
        return {Slot::OUT_DIFF_DIRECTION_HITDIST, false};
    case Slot::IN_DIFF_SH0:
        return {Slot::OUT_DIFF_SH0, false};
    case Slot::IN_DIFF_SH1:
        return {Slot::OUT_DIFF_SH1, false};
    case Slot::IN_SPEC_SH0:
        return {Slot::OUT_SPEC_SH0, true};
    case Slot::IN_SPEC_SH1:
        return {Slot::OUT_SPEC_SH1, true};
    case Slot::IN_SIGNAL:
        return {Slot::OUT_SIGNAL, false};
    default:
        FAIL("no signal: " << nrd::toString(input));
        return {};
    }
}

bool isDirections(Slot input) { return input == Slot::IN_DIFF_SH1 || input == Slot::IN_SPEC_SH1; }

glm::vec4 encodeRelax(Slot input, const Sample& s, const Setup& setup)
{
    if (isDirections(input)) return {s.direction * s.luma, 0.0f};
    const glm::vec4 value = radiance(s.luma, s.hitDist * kMetersPerHitDist * setup.unitsPerMeter);
    return {toRgb(value), value.w};
}

// Of the same light from everywhere above.
glm::vec4 encodeGiven(Slot input, glm::vec4 given)
{
    return isDirections(input) ? glm::vec4(kDirectionMean * toYCoCg(given).x, 0.0f) : given;
}

// RELAX takes RGB, and its spherical harmonics come out as Y, Co, Cg.
glm::vec4 asOutput(Slot input, glm::vec4 value, const Setup& setup)
{
    const bool isSh0 = input == Slot::IN_DIFF_SH0 || input == Slot::IN_SPEC_SH0;
    return isRelax(setup.denoiser) && isSh0 ? glm::vec4(toYCoCg(value), value.w) : value;
}

glm::vec4 encode(Slot input, const Sample& s, const Setup& setup)
{
    if (isRelax(setup.denoiser)) return encodeRelax(input, s, setup);
    if (input == Slot::IN_DIFF_HITDIST || input == Slot::IN_SPEC_HITDIST) return glm::vec4(s.occlusion, 0, 0, 0);
    if (input == Slot::IN_DIFF_DIRECTION_HITDIST) return {s.direction * s.occlusion, s.occlusion};
    if (isDirections(input)) return {s.direction * s.luma, 0.0f};
    return radiance(s.luma, s.hitDist);
}
// In the units of a sample's.
float storedHitDist(const Setup& setup, const Frame& frame, glm::ivec2 pixel, int frameIndex, bool isSpecular)
{
    const float meters = setup.hitDistAt(worldPosition(frame, pixel.x, pixel.y), pixel, frameIndex);
    if (isRelax(setup.denoiser)) return meters / kMetersPerHitDist;
    const size_t i = frame.pixel(pixel.x, pixel.y);
    return quality::normalizeHitDist(meters, frame.guides.viewZ[i], isSpecular ? frame.guides.roughness[i] : 1.0f);
}
} // namespace

float meanOf(const Setup& setup, const Frame& frame, glm::ivec2 pixel, int frameIndex)
{
    if (!setup.meanAt) return setup.mean;
    return setup.meanAt(worldPosition(frame, pixel.x, pixel.y), pixel, frameIndex);
}

Noise noiseOf(const Setup& setup, int frameIndex)
{
    constexpr unsigned kSeedStride = 1u << 20; // frames of one seed and the next
    const bool isOpposite = setup.isAntithetic && (frameIndex & 1) != 0;
    return {setup.seed * kSeedStride + static_cast<unsigned>(isOpposite ? frameIndex - 1 : frameIndex), isOpposite};
}

glm::vec4 asStored(rhi::Format format, glm::vec4 value)
{
    uint8_t texel[16] = {};
    test::encodeTexel(format, value, texel);
    return test::decodeTexel(format, texel);
}

Plane packSamples(const Setup& setup, const Frame& frame, Slot slot, int frameIndex, bool isSpecular,
                  const Plane& samples)
{
    const nrd::CheckerboardMode mode = checkerboardOf(setup);
    const glm::vec4 poison = poisonOf(frame.formats.at(slot));
    Plane plane(static_cast<size_t>(frame.size.x * frame.size.y), poison);
    for (int y = 0; y < frame.rect.y; y++)
    {
        for (int x = 0; x < frame.rect.x; x++)
        {
            if (!hasData(mode, isSpecular, {x, y}, frameIndex) || !frame.isInRange(x, y)) continue;
            const bool isPacked = mode != nrd::CheckerboardMode::OFF;
            const bool isBroken = setup.isBroken && (x * 7 + y * 3 + frameIndex) % 16 == 0;
            plane[frame.texel(isPacked ? x / 2 : x, y)] = isBroken ? poison : samples[frame.pixel(x, y)];
        }
    }
    return plane;
}

bool hasData(nrd::CheckerboardMode mode, bool isSpecular, glm::ivec2 pixel, int frameIndex)
{
    if (mode == nrd::CheckerboardMode::OFF) return true;
    const bool isBlack = ((pixel.x + pixel.y + frameIndex) & 1) == 0;
    return isBlack == ((mode == nrd::CheckerboardMode::BLACK) != isSpecular);
}

void addSignal(const Setup& setup, Frame& frame, Slot slot, int frameIndex)
{
    const Kind kind = kindOf(slot);
    Plane& noisy = frame.noisy[kind.output];
    Plane& means = frame.means[kind.output];
    SampleSource source(setup, kind.isSpecular, frameIndex);
    Plane samples;
    for (int y = 0; y < frame.rect.y; y++)
    {
        for (int x = 0; x < frame.rect.x; x++)
        {
            const float mean = meanOf(setup, frame, {x, y}, frameIndex);
            Sample sample = source.next(mean);
            if (setup.hitDistAt) sample.hitDist = storedHitDist(setup, frame, {x, y}, frameIndex, kind.isSpecular);
            const glm::vec4 value =
                setup.sampleAt ? encodeGiven(slot, setup.sampleAt({x, y}, frameIndex)) : encode(slot, sample, setup);
            const Sample truth = {mean, kHitDistMean, std::min(kOcclusionMean * mean, 1.0f), kDirectionMean};
            samples.push_back(asStored(frame.formats.at(slot), value));
            noisy.push_back(asOutput(slot, samples.back(), setup));
            means.push_back(asOutput(slot, encode(slot, truth, setup), setup));
        }
    }
    frame.inputs[slot] = packSamples(setup, frame, slot, frameIndex, kind.isSpecular, samples);
}
} // namespace options
