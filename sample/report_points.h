// What nrd-report measures of a denoiser: named settings, and which denoisers can be compared with each other.
#pragma once
#include "capture.h"
#include "replay_settings.h"
#include "resolution.h"

namespace sample::report
{
// One place on the plot.
struct Point
{
    std::string name;
    nrd::Quality preset = nrd::Quality::BALANCED;
    std::vector<Assignment> settings; // on top of the preset
    Resolution resolution = {};
};

// The presets, then the settings that matter most to speed, one changed at a time.
std::vector<Point> pointsOf(Family family);

// "NAME: key=value key=value", on top of `preset`. Throws SettingError.
Point parsePoint(const std::string& text, nrd::Quality preset);

// Whether the family has all the settings of the point. Throws SettingError for a value that its setting does not take.
bool hasSettings(Family family, const Point& point);

// Whether the capture has all that the denoiser reads with default settings.
bool fits(const Capture& capture, const ReplayDenoiser& denoiser);

// What of the picture the denoiser denoises, as "diffuse-specular": only within such a group do errors compare, since
// the rest of a composed picture is taken from the reference.
std::string groupOf(const ReplayDenoiser& denoiser);
} // namespace sample::report
