// What it costs and how good it is: times by pass, memory by pool, error, and the picked pixel.
#include "window/panel.h"

#include <algorithm>
#include <cfloat>
#include <cstdio>
#include <cstring>
#include <imgui.h>

namespace sample
{
namespace
{
constexpr double kMiB = 1024.0 * 1024.0;

// As a share of all that is traced and denoised.
void drawTime(const nrd::PassTime& pass, float total)
{
    char text[48];
    std::snprintf(text, sizeof(text), "%.3f ms", double(pass.milliseconds));
    const char* dash = std::strstr(pass.name, " - "); // the denoiser's name stands above already
    ImGui::ProgressBar(pass.milliseconds / std::max(total, 1e-6f), ImVec2(150.0f, 0.0f), text);
    ImGui::SameLine();
    ImGui::TextUnformatted(dash ? dash + 3 : pass.name);
}

void drawTimes(Viewer& viewer)
{
    const nrd::Timings timings = viewer.side(0).timings();
    const std::vector<nrd::PassTime>& tracing = viewer.renderer().tracingTimes();
    float total = timings.totalMilliseconds;
    for (const nrd::PassTime& pass : tracing) total += pass.milliseconds;
    for (const nrd::PassTime& pass : tracing) drawTime(pass, total);
    if (timings.passesNum == 0) return;
    char text[48];
    std::snprintf(text, sizeof(text), "%.3f ms of A", double(timings.totalMilliseconds));
    const std::vector<float>& times = viewer.frameTimes();
    ImGui::PlotLines("##times", times.data(), int(times.size()), 0, text, 0.0f, FLT_MAX,
                     ImVec2(ImGui::GetContentRegionAvail().x, 60.0f));
    for (uint32_t i = 0; i < timings.passesNum; ++i) drawTime(timings.passes[i], total);
}

void drawMemory(Viewer& viewer)
{
    for (size_t i = 0; i < (viewer.state.isCompared ? 2u : 1u); ++i)
    {
        const nrd::MemoryStatistics memory = viewer.side(i).memory();
        ImGui::Text("%s: %.1f MiB permanent, %.1f transient, %.1f in all", i == 0 ? "A" : "B",
                    double(memory.permanent) / kMiB, double(memory.transient) / kMiB, double(memory.total) / kMiB);
    }
}

void drawErrors(Viewer& viewer)
{
    if (!viewer.state.hasReference) return;
    ImGui::Text("reference: %u samples per pixel", viewer.reference().sampleCount());
    if (viewer.isMoving()) ImGui::TextDisabled("starts anew each frame: pause, or stop the animation");
    for (size_t i = 0; i < viewer.errors().size(); ++i)
        if (viewer.errors()[i]) ImGui::Text("%s: PSNR %.2f dB", i == 0 ? "A" : "B", *viewer.errors()[i]);
}

void drawPicked(const PickedPixel& p)
{
    ImGui::Text("pixel %d, %d", p.pixel.x, p.pixel.y);
    ImGui::Text("viewZ %.4f  roughness %.3f  material %.0f", double(p.viewZ), double(p.normalRoughness.w),
                double(p.motionMaterial.w));
    const auto vector = [](const char* name, const glm::vec4& v)
    { ImGui::Text("%s %.4f %.4f %.4f", name, double(v.x), double(v.y), double(v.z)); };
    vector("normal  ", p.normalRoughness);
    vector("motion  ", p.motionMaterial);
    vector("noisy   ", p.noisy);
    vector("denoised", p.denoised);
    constexpr const char* kNames[] = {"diffuse", "specular"};
    for (size_t i = 0; i < 2; ++i)
        if (p.historyLength[i]) ImGui::Text("%s history: %.1f frames", kNames[i], double(*p.historyLength[i]));
}
} // namespace

void drawFiguresPart(Viewer& viewer, const std::optional<PickedPixel>& picked)
{
    if (!ImGui::CollapsingHeader("Figures", ImGuiTreeNodeFlags_DefaultOpen)) return;
    drawErrors(viewer);
    if (picked)
        drawPicked(*picked);
    else
        ImGui::TextDisabled("Ctrl + click picks a pixel");
    drawMemory(viewer);
    drawTimes(viewer);
}
} // namespace sample
