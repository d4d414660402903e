// Boards from 5 cm to 50 km away in one picture, at the world's origin and 100 km from it. Positions that far have
// single precision's steps of 8 mm, more than what the camera moves: the application gives its movement in double
// precision.
#include "catch.h"
#include "figures.h"
#include "levels.h"
#include "runners.h"
#include "scenes.h"

using namespace stability;

namespace
{
constexpr int kBoards = 7, kFrames = 8;
constexpr float kNearest = 0.05f; // metres; each board is ten times as far as the one before
constexpr float kStep = -5e-4f;   // metres a frame, half a pixel of the nearest board, into the picture
constexpr double kFar = 1e5;      // metres
constexpr double kAllowed = 5.0;  // % that the error may differ, what the project promises

float distanceOf(int board) { return kNearest * std::pow(10.0f, float(board)); }

int boardAt(glm::vec3 p) { return int(std::round(std::log10(p.z / kNearest))); }

// Side by side in the view, each as wide.
options::Setup makeBoards(nrd::Denoiser denoiser, glm::dvec3 origin)
{
    options::Setup setup = makeSetup(denoiser);
    const float aspect = float(kSize.x) / float(kSize.y), width = 2.0f * aspect * std::tan(0.5f * setup.fovY);
    std::vector<Board> boards;
    for (int i = 0; i < kBoards; i++)
    {
        const float z = distanceOf(i), share = (float(i) + 0.5f) / float(kBoards) - 0.5f;
        // The last one closes the picture, wherever the camera looks past the others.
        const float half = i + 1 < kBoards ? 0.5f * width * z / float(kBoards) : width * z;
        boards.push_back({{share * width * z, 0, z}, {half, 0, 0}, {0, z, 0}});
    }
    showBoards(setup, boards);
    setup.denoisingRange = 2.0f * distanceOf(kBoards - 1);
    setup.projection = options::Projection::Infinite;
    setup.camera = [](int frame) { return lookFrom({kStep * float(frame), 0.0f, 0.0f}, {0, 0, 1}); };
    setup.isAntithetic = true;
    setup.worldOrigin = origin;
    setup.isCameraDeltaGiven = true;
    return setup;
}

// Of each board.
std::vector<Statistics> measureBoards(nrd::Denoiser denoiser, glm::dvec3 origin)
{
    const std::vector<Level> levels = levelsOf(runToLast(makeBoards(denoiser, origin), kFrames), denoiser);
    std::vector<Statistics> boards;
    for (int board = 0; board < kBoards; board++)
    {
        Statistician statistician;
        statistician.add(levels, [board](const Level& l) { return boardAt(l.position) == board; });
        boards.push_back(statistician.statistics());
        CHECK(boards.back().count > 100);
    }
    return boards;
}
} // namespace

TEST_CASE("boards from 5 cm to 50 km away are denoised alike, at the origin and 100 km from it", "[gpu]")
{
    // No worse than the mean of as many frames would be, without any filter; SIGMA's history is as long.
    const double most = 100.0 / std::sqrt(double(kFrames));
    Figure error("5 cm to 50 km in one picture: error of the worst board", "% of the input's", most);
    Figure moved("the same 100 km from the origin: error of a board differs by", "%", kAllowed);
    for (const nrd::Denoiser denoiser : denoisersThat(isDenoiser))
    {
        const std::vector<Statistics> near = measureBoards(denoiser, glm::dvec3(0.0));
        const std::vector<Statistics> far = measureBoards(denoiser, kFar * glm::dvec3(1.0, -1.0, 1.0));
        double worst = 0.0, difference = 0.0;
        for (size_t i = 0; i < near.size(); i++)
        {
            worst = std::max(worst, near[i].error / near[i].noisyError);
            difference = std::max(difference, std::abs(far[i].error / near[i].error - 1.0));
        }
        error.add(denoiser, 100.0 * worst);
        moved.add(denoiser, 100.0 * difference);
    }
}
