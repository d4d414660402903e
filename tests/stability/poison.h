// What a renderer's images should not hold, and where it may turn up.
#pragma once
#include <measures.h>
#include <options.h>
#include <span>
#include <string>

namespace stability
{
struct Poison
{
    const char* name;
    float value;
};

std::span<const Poison> poisons(); // NaN, infinities, negatives, denormals and the largest half float

// An image, or its last channel alone.
struct Target
{
    nrd::ResourceType slot;
    bool isHitDistOnly;
};

std::string nameOf(const Target& target);
std::vector<Target> targetsOf(const options::Frame& frame);

// Everything that a denoiser can read is there and stored as floats, so that all of it can be poisoned.
options::Setup makeOpenSetup(nrd::Denoiser denoiser, glm::ivec2 size);
std::unique_ptr<options::Runner> makeOpenRunner(nrd::Denoiser denoiser);

void poisonTexel(options::Frame& frame, const Target& target, glm::ivec2 pixel, float value);

// The first output or history that holds what is no number, or "".
std::string findUnsound(const options::Result& result, std::span<const options::Runner::History> histories);
} // namespace stability
