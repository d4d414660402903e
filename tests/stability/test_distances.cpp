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
constexpr float kStep = 2e-4f;    // metres a frame, a fifth of a pixel of the nearest board
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

std::vector<Level> lastLevels(nrd::Denoiser denoiser, glm::dvec3 origin)
{
    return levelsOf(runToLast(makeBoards(denoiser, origin), kFrames), denoiser);
}

// % of the noisy input's, of the board where it is largest.
double worstBoard(const std::vector<Level>& levels)
{
    double worst = 0.0;
    for (int board = 0; board < kBoards; board++)
    {
        Statistician statistician;
        statistician.add(levels, [board](const Level& l) { return boardAt(l.position) == board; });
        const Statistics s = statistician.statistics();
        CHECK(s.count > 100);
        worst = std::max(worst, 100.0 * s.error / s.noisyError);
    }
    return worst;
}

double errorOf(const std::vector<Level>& levels)
{
    Statistician statistician;
    statistician.add(levels);
    return statistician.statistics().error;
}
} // namespace

TEST_CASE("boards from 5 cm to 50 km away are denoised alike, at the origin and 100 km from it", "[gpu]")
{
    // No worse than the mean of as many frames would be, without any filter; SIGMA's history is as long.
    const double most = 100.0 / std::sqrt(double(kFrames));
    Figure error("5 cm to 50 km in one picture: error of the worst board", "% of the input's", most);
    Figure moved("the same 100 km from the origin: error differs by", "%", kAllowed);
    for (const nrd::Denoiser denoiser : denoisersThat(isDenoiser))
    {
        const std::vector<Level> near = lastLevels(denoiser, glm::dvec3(0.0));
        const std::vector<Level> far = lastLevels(denoiser, kFar * glm::dvec3(1.0, -1.0, 1.0));
        error.add(denoiser, worstBoard(near));
        moved.add(denoiser, 100.0 * std::abs(errorOf(far) / errorOf(near) - 1.0));
    }
}
