// Frames of a capture as the doctor gets them: packed as the front end packs, open for faults to be put in.
#pragma once
#include "capture.h"
#include <nrd/doctor.h>
#include <set>

namespace test
{
using Texels = std::vector<float>; // 4 per pixel

struct FrameInputs
{
    nrd::CommonSettings common;
    nrd::NormalEncoding normalEncoding = nrd::NormalEncoding::R10_G10_B10_A2_UNORM;
    nrd::HitDistanceParameters hitDistanceParameters;
    Texels viewZ, motion, normalRoughness, diffuse, specular;
    Texels diffuseFactor, specularFactor, specularDirection;
    // What they were packed from; .w of `guides` is roughness.
    Texels guides, diffuseSignal, specularSignal; // .xyz radiance, .w hit distance
    size_t width = 0, height = 0;

    size_t pixelCount() const { return width * height; }
    nrd::DoctorFrame view() const;
    /// Packs guides and signals anew.
    void pack();
};

std::vector<FrameInputs> readInputs(const std::filesystem::path& folder, size_t first, size_t count);

/// World-space motion becomes what a renderer stores on screen: uv and depth of the last frame minus this one's.
void toScreenMotion(std::vector<FrameInputs>& frames);

/// An image of the frame's size in a larger one, with its corner at (x; y) and NaN around it.
Texels enlarge(const Texels& image, const FrameInputs& frame, size_t width, size_t height, size_t x, size_t y);

/// As an image of half floats keeps them; values in their normal range.
void roundToHalf(Texels& texels);

struct Diagnosis
{
    struct Entry
    {
        nrd::DoctorRule rule;
        nrd::ResourceType slot;
        std::string text;
    };
    std::vector<Entry> entries;

    std::string text() const; // all sentences
    bool has(nrd::DoctorRule rule) const;
};
Diagnosis diagnose(const std::vector<FrameInputs>& frames);
} // namespace test
