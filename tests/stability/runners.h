// The denoisers, and one runner for each of them in the whole program: its pipelines cost more than its frames.
#pragma once
#include <functional>
#include <measures.h>
#include <options.h>

namespace stability
{
constexpr glm::ivec2 kSize{64, 48};

using Filter = std::function<bool(nrd::Denoiser)>;
bool isAny(nrd::Denoiser denoiser);
bool isDenoiser(nrd::Denoiser denoiser); // all but REFERENCE, which averages and filters nothing
bool hasSpecular(nrd::Denoiser denoiser);
using options::isWidest;

std::vector<nrd::Denoiser> denoisersThat(const Filter& filter);
std::vector<nrd::Denoiser> someThat(const Filter& filter); // in the short form only the widest

options::Runner& runnerOf(nrd::Denoiser denoiser);

// Images that store what they are given; nothing moves.
options::Setup makeSetup(nrd::Denoiser denoiser);

// Frames of a fresh instance, one after another. No output may hold anything but numbers.
using Look = std::function<void(int frame, const options::Result& result)>;
void run(const options::Setup& setup, int frameCount, const Look& look);
options::Result runToLast(const options::Setup& setup, int frameCount);
} // namespace stability
