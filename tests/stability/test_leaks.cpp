// Light that gets where none is: through a wall of 1 cm, and between what the camera carries and what is behind it.
// What is dark has no noise, so that all it shows has leaked.
#include "catch.h"
#include "figures.h"
#include "levels.h"
#include "runners.h"
#include "scenes.h"

using namespace stability;

namespace
{
constexpr double kMostLeaked = 0.5; // % of the light beside it, what the project promises
constexpr float kThickness = 0.01f; // metres, of walls
constexpr float kWide = 1e3f;       // metres, more than is seen

// A scene with a part that is dark, from the frame on that is measured.
struct Leak
{
    const char* name;
    void (*apply)(options::Setup& setup);
    bool (*isDark)(glm::vec3 position);
    int firstFrame, frameCount;
};

// The wall's end is straight ahead; it goes left, and towards the camera by the angle. Behind it, as far as the room is
// deep, is a lit wall parallel to it, so that no normal tells them apart.
template <int Distance, int Degrees> struct Partition
{
    static constexpr float kRoom = 1.0f; // metres

    static glm::vec3 along()
    {
        const float angle = glm::radians(float(Degrees));
        return {-std::cos(angle), 0.0f, -std::sin(angle)};
    }
    static glm::vec3 back() { return {along().z, 0.0f, -along().x}; } // away from the camera
    static glm::vec3 end() { return {0.0f, 0.0f, float(Distance)}; }
    static bool isDark(glm::vec3 p) { return glm::dot(p - end(), back()) < 0.5f * kRoom; }

    static void apply(options::Setup& setup)
    {
        const glm::vec3 up(0.0f, kWide, 0.0f);
        showBoards(setup, {Board{end() + along() * kWide, along() * kWide, up},
                           Board{end() + back() * kRoom, along() * kWide, up}});
        setup.camera = [](int frame) { return lookFrom({0.01f * float(frame), 0.0f, 0.0f}, {0, 0, 1}); };
        setup.meanAt = [](glm::vec3 p, glm::ivec2, int) { return isDark(p) ? 0.0f : 1.0f; };
    }
};

// A cut would forget everything, and with it what is to be rejected.
void forbidCuts(options::Setup& setup)
{
    setup.changeCommon = [](nrd::CommonSettings& common, int) { common.enableCutDetection = false; };
}

// The camera slips past the wall's end into the dark room: what it sees then stands a centimetre from what it saw.
constexpr int kSlip = 5;

void slipPast(options::Setup& setup)
{
    const glm::vec3 up(0.0f, kWide, 0.0f), along(0.0f, 0.0f, kWide);
    const glm::vec3 end(0.0f, 0.0f, 1.0f), side(0.5f * kThickness, 0.0f, 0.0f);
    showBoards(setup, {Board{end + along + side, along, up}, Board{end + along - side, along, up}, Board{end, side, up},
                       Board{{4, 0, 0}, along, up}, Board{{-4, 0, 0}, along, up}});
    setup.camera = [](int frame) { return lookFrom({0.1f * (float(kSlip - frame) - 0.5f), 0.0f, 0.0f}, {0, 0, 1}); };
    setup.meanAt = [](glm::vec3 p, glm::ivec2, int) { return p.x < 0.0f ? 0.0f : 1.0f; };
    forbidCuts(setup);
}

const Leak kWalls[] = {
    {"wall 1 m away", Partition<1, 0>::apply, Partition<1, 0>::isDark, 0, 6},
    {"wall 4 m away, at 60 degrees", Partition<4, 60>::apply, Partition<4, 60>::isDark, 0, 6},
    {"wall 16 m away, at 85 degrees", Partition<16, 85>::apply, Partition<16, 85>::isDark, 0, 6},
    {"past the end of the wall", slipPast, [](glm::vec3 p) { return p.x < 0.0f; }, kSlip, kSlip + 2},
};

// Carried half a metre in front of the camera, which goes sideways in front of a wall.
constexpr float kStrafe = 0.3f;             // metres a frame
constexpr float kHeld = 0.5f, kWall = 4.0f; // metres away
const glm::vec3 kHand(0.15f, 0.0f, kHeld);  // where its centre is held
constexpr float kHalfSize = 0.15f;          // metres
bool isHeld(glm::vec3 p) { return p.z < 2.0f * kHeld; }
glm::vec3 cameraAt(int frame) { return {kStrafe * float(frame), 0.0f, 0.0f}; }

template <bool IsHeldLit> void strafe(options::Setup& setup)
{
    setup.camera = [](int frame) { return lookFrom(cameraAt(frame), {0, 0, 1}); };
    showBoards(setup,
               [](int frame) -> std::vector<Board>
               {
                   const glm::vec3 right(kHalfSize, 0, 0), up(0, kHalfSize, 0);
                   return {{cameraAt(frame) + kHand, right, up}, {{0, 0, kWall}, {kWide, 0, 0}, {0, kWide, 0}}};
               });
    setup.meanAt = [](glm::vec3 p, glm::ivec2, int) { return isHeld(p) == IsHeldLit ? 1.0f : 0.0f; };
    setup.motionAt = [](glm::vec3 p, glm::ivec2, int frame)
    { return isHeld(p) ? cameraAt(frame - 1) - cameraAt(frame) : glm::vec3(0.0f); };
    forbidCuts(setup);
}

// Of the wall only the height that the object sweeps.
bool isSweptWall(glm::vec3 p) { return !isHeld(p) && std::abs(p.y) < kHalfSize * kWall / kHeld; }

const Leak kCarried[] = {
    {"carried object, dark under a fast strafe", strafe<false>, isHeld, 2, 8},
    {"wall behind a carried object that is lit", strafe<true>, isSweptWall, 2, 8},
};

double leakOf(nrd::Denoiser denoiser, const Leak& leak)
{
    options::Setup setup = makeSetup(denoiser);
    leak.apply(setup);
    Statistician dark;
    run(setup, leak.frameCount,
        [&](int frame, const options::Result& result)
        {
            if (frame >= leak.firstFrame)
                dark.add(levelsOf(result, denoiser), [&](const Level& l) { return leak.isDark(l.position); });
        });
    CHECK(dark.statistics().count > 1000);
    return 100.0 * dark.statistics().denoised;
}

void checkLeaks(std::span<const Leak> leaks)
{
    for (const Leak& leak : leaks)
    {
        Figure figure(std::string(leak.name) + ": luminance leaked into the dark", "%", kMostLeaked);
        for (const nrd::Denoiser denoiser : denoisersThat(isAny)) figure.add(denoiser, leakOf(denoiser, leak));
    }
}
} // namespace

TEST_CASE("no light gets through a thin wall", "[gpu]") { checkLeaks(kWalls); }
TEST_CASE("what the camera carries takes no light from what it passes, and leaves none on it", "[gpu]")
{
    checkLeaks(kCarried);
}
