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

// The camera slips past the wall's end into the dark room: what it sees then stands a centimetre from what it saw.
constexpr int kSlip = 5;

void slipPast(options::Setup& setup)
{
    const glm::vec3 up(0.0f, kWide, 0.0f), along(0.0f, 0.0f, kWide);
    const glm::vec3 near(0.0f, 0.0f, kWide + 1.0f), side(0.5f * kThickness, 0.0f, 0.0f);
    showBoards(setup, {Board{near + side, along, up}, Board{near - side, along, up}, Board{{4, 0, 0}, along, up},
                       Board{{-4, 0, 0}, along, up}});
    setup.camera = [](int frame) { return lookFrom({0.1f * (float(kSlip - frame) - 0.5f), 0.0f, 0.0f}, {0, 0, 1}); };
    setup.meanAt = [](glm::vec3 p, glm::ivec2, int) { return p.x < 0.0f ? 0.0f : 1.0f; };
}

const Leak kWalls[] = {
    {"wall 1 m away", Partition<1, 0>::apply, Partition<1, 0>::isDark, 0, 6},
    {"wall 4 m away, at 60 degrees", Partition<4, 60>::apply, Partition<4, 60>::isDark, 0, 6},
    {"wall 16 m away, at 85 degrees", Partition<16, 85>::apply, Partition<16, 85>::isDark, 0, 6},
    {"past the end of the wall", slipPast, [](glm::vec3 p) { return p.x < 0.0f; }, kSlip, kSlip + 2},
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
