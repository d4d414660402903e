// The panel: what a user sees and turns. It writes the viewer's state, and wishes that the program fulfils.
#pragma once
#include "window/recorder.h"

namespace sample
{
/// What the viewer alone cannot do; whoever fulfils a wish empties it.
struct Wishes
{
    std::optional<std::string> scene;          // file or name of a built-in one
    std::optional<std::filesystem::path> file; // scene or environment, as dropped
    std::optional<std::filesystem::path> picture, buffer, windowPicture;
    std::optional<std::filesystem::path> capture, sequence, test; // empty path: end it
    std::optional<bool> fullscreen;
    float renderScale = 1.0f; // rendered pixels per pixel of the window, [0.1; 2]
};

struct PanelInput
{
    Viewer& viewer;
    Wishes& wishes;
    const Recorder& recorder;
    const std::optional<PickedPixel>& picked;
};

void drawPanel(const PanelInput& input);

// Its parts, each a heading.
void drawDenoiserPart(Viewer& viewer);
void drawSettingsPart(Viewer& viewer);
void drawViewPart(Viewer& viewer);
void drawScenePart(Viewer& viewer, Wishes& wishes);
void drawTracingPart(Viewer& viewer);
void drawFiguresPart(Viewer& viewer, const std::optional<PickedPixel>& picked);
void drawFilesPart(const PanelInput& input);

/// In the middle of the window, while something loads.
void drawProgress(const std::string& what, double seconds);
} // namespace sample
