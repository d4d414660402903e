// One number a pixel, whatever the denoiser's outputs hold: luma, occlusion or visibility, as a share of what a mean of
// 1 gives.
#pragma once
#include <functional>
#include <measures.h>

namespace stability
{
struct Level
{
    nrd::ResourceType output;
    glm::ivec2 pixel;
    glm::vec3 position; // metres
    double denoised, noisy, truth;
};

// Every pixel in range, of every output that is no direction.
std::vector<Level> levelsOf(const options::Result& result, nrd::Denoiser denoiser);

// Means, and root mean square distances from the truth.
struct Statistics
{
    double denoised = 0.0, noisy = 0.0, truth = 0.0;
    double error = 0.0, noisyError = 0.0;
    size_t count = 0;
};

using IsCounted = std::function<bool(const Level& level)>;

// Over as many frames as one likes.
class Statistician
{
public:
    void add(const std::vector<Level>& levels, const IsCounted& isCounted = {});
    Statistics statistics() const;

private:
    Statistics m_sums;
};
} // namespace stability
