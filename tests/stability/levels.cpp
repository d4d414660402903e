#include "levels.h"
#include <cmath>

namespace stability
{
namespace
{
using Slot = nrd::ResourceType;

constexpr float kOcclusion = 0.4f; // that of a mean of 1

bool isLevel(Slot output) { return output != Slot::OUT_DIFF_SH1 && output != Slot::OUT_SPEC_SH1; }

float levelOf(Slot output, glm::vec4 v, bool isRelax)
{
    switch (output)
    {
    case Slot::OUT_DIFF_RADIANCE_HITDIST:
    case Slot::OUT_SPEC_RADIANCE_HITDIST:
        return isRelax ? 0.25f * (v.x + v.z) + 0.5f * v.y : v.x; // RGB, or its Y
    case Slot::OUT_DIFF_HITDIST:
    case Slot::OUT_SPEC_HITDIST:
        return v.x / kOcclusion;
    case Slot::OUT_DIFF_DIRECTION_HITDIST:
        return v.w / kOcclusion;
    case Slot::OUT_SHADOW_TRANSLUCENCY:
        return v.x * v.x; // stored as its root
    default:
        return v.x;
    }
}

double square(double x) { return x * x; }
} // namespace

std::vector<Level> levelsOf(const options::Result& result, nrd::Denoiser denoiser)
{
    const options::Frame& frame = result.frame;
    const bool isRelax = options::isRelax(denoiser);
    std::vector<Level> levels;
    for (const auto& [slot, plane] : result.outputs)
    {
        if (!isLevel(slot)) continue;
        for (int y = 0; y < frame.rect.y; y++)
        {
            for (int x = 0; x < frame.rect.x; x++)
            {
                if (!frame.isInRange(x, y)) continue;
                const size_t pixel = frame.pixel(x, y);
                const auto level = [&, output = slot](glm::vec4 v) { return double(levelOf(output, v, isRelax)); };
                levels.push_back({slot,
                                  {x, y},
                                  options::worldPosition(frame, x, y),
                                  level(plane[frame.texel(x, y)]),
                                  level(frame.noisy.at(slot)[pixel]),
                                  level(frame.means.at(slot)[pixel])});
            }
        }
    }
    return levels;
}

void Statistician::add(const std::vector<Level>& levels, const IsCounted& isCounted)
{
    for (const Level& level : levels)
    {
        if (isCounted && !isCounted(level)) continue;
        m_sums.denoised += level.denoised;
        m_sums.noisy += level.noisy;
        m_sums.truth += level.truth;
        m_sums.error += square(level.denoised - level.truth);
        m_sums.noisyError += square(level.noisy - level.truth);
        m_sums.count++;
    }
}

Statistics Statistician::statistics() const
{
    const double count = double(std::max<size_t>(m_sums.count, 1));
    return {m_sums.denoised / count,
            m_sums.noisy / count,
            m_sums.truth / count,
            std::sqrt(m_sums.error / count),
            std::sqrt(m_sums.noisyError / count),
            m_sums.count};
}
} // namespace stability
