#include "window/panel.h"

#include "shaders/view_modes.h"
#include "window/views.h"

#include <cmath>
#include <imgui.h>

namespace sample
{
namespace
{
constexpr const char* kTones[] = {"x / (1 + x)", "filmic", "clamped"};

void drawMessage(Viewer& viewer)
{
    if (viewer.message().empty()) return;
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.5f, 0.4f, 1.0f));
    ImGui::TextWrapped("%s", viewer.message().c_str());
    ImGui::PopStyleColor();
    if (ImGui::SmallButton("Understood")) viewer.setMessage("");
}

bool hasRange(uint32_t mode)
{
    return mode == VIEW_W || mode == VIEW_X || mode == VIEW_DEPTH || mode == VIEW_MOTION || mode == VIEW_DIFFERENCE;
}

void drawTime(ViewerState& state)
{
    if (ImGui::Button(state.isPaused ? "Go on" : "Pause")) state.isPaused = !state.isPaused;
    ImGui::SameLine();
    if (ImGui::Button("Step")) state.isPaused = true, state.steps = 1;
    ImGui::SameLine();
    if (ImGui::Button("Restart history")) state.isRestarted = true;
}
} // namespace

void drawViewPart(Viewer& viewer)
{
    if (!ImGui::CollapsingHeader("View", ImGuiTreeNodeFlags_DefaultOpen)) return;
    ViewerState& state = viewer.state;
    if (ImGui::BeginCombo("shown", views()[state.view].name))
    {
        for (size_t i = 0; i < views().size(); ++i)
            if (ImGui::Selectable(views()[i].name, i == state.view)) state.view = i;
        ImGui::EndCombo();
    }
    if (!viewer.viewedImage()) ImGui::TextDisabled("not there with this denoiser or scene");
    const uint32_t mode = views()[state.view].mode;
    const bool isLight = mode == VIEW_LIGHT || mode == VIEW_DIFFERENCE || mode == VIEW_OVERLAY;
    if (isLight)
    {
        ImGui::SliderFloat("exposure", &state.exposure, -8.0f, 8.0f, "%+.1f EV");
        int tone = int(state.tone);
        if (ImGui::Combo("tone mapping", &tone, kTones, int(std::size(kTones)))) state.tone = uint32_t(tone);
    }
    if (hasRange(mode))
        ImGui::SliderFloat("range", &state.range, 0.01f, 100.0f, "x %.2f", ImGuiSliderFlags_Logarithmic);
    ImGui::Checkbox("reference while the camera rests", &state.hasReference);
    int samples = int(state.referenceSamples);
    if (state.hasReference && ImGui::SliderInt("samples per frame", &samples, 1, 16))
        state.referenceSamples = uint32_t(samples);
}

void drawFilesPart(const PanelInput& input)
{
    if (!ImGui::CollapsingHeader("Pictures and recordings")) return;
    Wishes& wishes = input.wishes;
    if (ImGui::Button("Picture")) wishes.picture = "picture.png";
    ImGui::SameLine();
    if (ImGui::Button("Linear EXR")) wishes.buffer = "buffer.exr";
    ImGui::SameLine();
    if (ImGui::Button("Window")) wishes.windowPicture = "window.png";
    const bool isCapturing = input.recorder.isCapturing(), isSequencing = input.recorder.isSequencing();
    if (ImGui::Button(isCapturing ? "End the capture" : "Record a capture"))
        wishes.capture = isCapturing ? "" : "capture";
    ImGui::SameLine();
    if (ImGui::Button(isSequencing ? "End the sequence" : "Record a sequence"))
        wishes.sequence = isSequencing ? "" : "sequence";
    const bool isTesting = input.recorder.isTesting();
    if (ImGui::Button(isTesting ? "End the test" : "Record a test")) wishes.test = isTesting ? "" : "tests";
    if (isCapturing) ImGui::Text("%u frames", input.recorder.capturedFrames());
}

void drawPanel(const PanelInput& input)
{
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos(ImVec2(8.0f, 8.0f), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize(ImVec2(390.0f, io.DisplaySize.y - 16.0f), ImGuiCond_FirstUseEver);
    if (ImGui::Begin("nrd-sample"))
    {
        ImGui::PushItemWidth(ImGui::GetWindowWidth() * 0.45f);
        ImGui::Text("%u x %u, %.1f ms per frame", input.viewer.options().width, input.viewer.options().height,
                    1000.0 * double(io.DeltaTime));
        drawMessage(input.viewer);
        drawTime(input.viewer.state);
        drawDenoiserPart(input.viewer);
        drawViewPart(input.viewer);
        drawFiguresPart(input.viewer, input.picked);
        drawSettingsPart(input.viewer);
        drawScenePart(input.viewer, input.wishes);
        drawTracingPart(input.viewer);
        drawFilesPart(input);
        ImGui::PopItemWidth();
    }
    ImGui::End();
}

void drawProgress(const std::string& what, double seconds)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.5f * size.x, 0.5f * size.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::Begin("progress", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::Text("%s", what.c_str());
    // How long it takes nobody knows: the bar goes to and fro.
    ImGui::ProgressBar(float(0.5 - 0.5 * std::cos(2.0 * seconds)), ImVec2(260.0f, 0.0f), "");
    ImGui::Text("%.1f s", seconds);
    ImGui::End();
}
} // namespace sample
