// What a long session does to an integration: chosen at random from a fixed seed.
#pragma once
#include <nrd/integration.h>
#include <random>
#include <vector>

namespace faults
{
class Dice
{
public:
    explicit Dice(uint32_t seed) : m_random(seed) {}
    uint32_t below(uint32_t end) { return static_cast<uint32_t>(m_random() % end); } // the same with any library
    bool once(uint32_t times) { return below(times) == 0; }                          // in so many
    float share() { return static_cast<float>(below(1025)) / 1024.0f; }

private:
    std::mt19937 m_random;
};

/// Other settings of one denoiser; they are valid.
nrd::Result changeSettings(Dice& dice, nrd::NrdIntegration& integration, nrd::Identifier identifier,
                           nrd::Denoiser denoiser);
} // namespace faults
