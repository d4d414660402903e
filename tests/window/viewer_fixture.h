// Viewers of built-in scenes without a window, and what they show.
#pragma once
#include "window/viewer.h"

#include <string>

namespace test
{
constexpr double kFrame = 1.0 / 60.0; // seconds

sample::Options optionsFor(const char* scene, const char* denoiser); // 32 x 20 pixels
sample::Viewer makeViewer(const char* scene, const char* denoiser,
                          sample::FirstPicture first = sample::FirstPicture::Denoised);
// The picture as bytes.
std::string show(sample::Viewer& viewer);
} // namespace test
