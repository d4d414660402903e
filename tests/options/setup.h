// What an option changes: the instance, the settings, the camera and the inputs of a run of any denoiser.
#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <nrd/nrd.h>
#include <optional>
#include <scene.h>
#include <vector>

namespace options
{
enum class Projection : uint8_t
{
    Perspective,
    Reversed,
    Infinite,
    ReversedInfinite,
    Orthographic
};

enum class MotionKind : uint8_t
{
    World,   // of the scene, not of the camera
    Screen,  // 2D
    Screen25 // with the difference of depths
};

enum class Family : uint8_t
{
    Reblur,
    Relax,
    Sigma,
    Reference
};

// Towards a light, as the front end packs it.
struct LightRay
{
    float penumbra = 65504.0f;
    glm::vec4 translucency{1.0f};
};

struct Frame;

struct Setup
{
    nrd::Denoiser denoiser = nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR;
    nrd::NormalEncoding normalEncoding = nrd::NormalEncoding::R10_G10_B10_A2_UNORM;
    nrd::RoughnessEncoding roughnessEncoding = nrd::RoughnessEncoding::LINEAR;
    uint32_t resolutionDivisor = 1;                  // 1 or 2
    nrd::FullSize fullSize = nrd::FullSize::NOTHING; // with a divisor of 2
    bool hasHistory = true;                          // false: of SIGMA only
    nrd::ReblurSettings settings;                    // of REBLUR
    nrd::RelaxSettings relaxSettings;                // of RELAX
    nrd::SigmaSettings sigmaSettings;                // of SIGMA
    nrd::ReferenceSettings referenceSettings;        // of REFERENCE

    glm::ivec2 size{127, 63}; // resource, pixels
    glm::ivec2 rect{127, 63};
    glm::ivec2 origin{0};
    bool isRectVarying = false;   // dynamic resolution: another rectangle each frame, at most `rect`
    bool hasLargeFormats = false; // otherwise the least formats that serve

    Projection projection = Projection::Perspective;
    float fovY = 1.0f;          // radians, of perspectives
    bool isRightHanded = false; // view space looks along -Z, depths are negative
    float viewZFactor = 1.0f;   // what IN_VIEWZ holds per unit of depth
    bool hasHalfViewZ = false;
    float unitsPerMeter = 1.0f;
    float denoisingRange = quality::kDenoisingRange; // metres
    glm::dvec3 worldOrigin{0.0};                     // metres, where the scene and the camera stand in the world
    bool isCameraDeltaGiven = false;                 // in double precision, whatever the matrices have lost

    MotionKind motion = MotionKind::World;
    float motionFactor = 1.0f;     // what IN_MV holds per unit, or per pixel
    glm::vec3 sceneVelocity{0.0f}; // metres a frame; the camera goes along
    float speed = 0.05f;           // of quality::makeCamera()
    bool isJittered = false;

    float mean = 1.0f;          // luma of the signals; of shadows and occlusion a factor to the visible share
    unsigned seed = 0;          // of the noise
    bool isAntithetic = false;  // odd frames are the opposite of those before: two of them have no noise together
    bool isHalfMissing = false; // half of the pixels have no sample of a lobe; the others count twice
    bool isBroken = false;      // one sample in sixteen is no number
    std::optional<float> confidence, thresholdMix;
    bool hasMaterials = false; // ID 1 right of the world's x = 0

    std::function<void(nrd::CommonSettings&, int frame)> changeCommon;
    std::function<quality::Camera(int frame)> camera; // in place of quality::makeCamera()
    std::function<quality::Guides(const quality::Camera&, glm::ivec2 size, int frame)> scene;
    // In place of `mean`, from positions in metres.
    std::function<float(glm::vec3 position, glm::ivec2 pixel, int frame)> meanAt;
    std::function<float(glm::vec3 position, glm::ivec2 pixel, int frame)> hitDistAt; // metres; half a penumbra's width
    std::function<glm::vec3(glm::vec3 position, glm::ivec2 pixel, int frame)> motionAt;           // metres, world space
    std::function<glm::vec3(glm::vec3 position, glm::ivec2 pixel, int frame)> reflectionMotionAt; // in IN_SPEC_MV
    // RELAX: RGB and hit distance in place of the noisy samples. REFERENCE: the signal.
    std::function<glm::vec4(glm::ivec2 pixel, int frame)> sampleAt;
    // SIGMA: in place of a shadow's edge down the middle, from positions in metres; no means then.
    std::function<LightRay(glm::vec3 position, glm::ivec2 pixel, int frame)> rayAt;
    std::function<void(Frame&, int frame)> changeInputs; // last of all
    bool isInPlace = false;                              // REFERENCE: one image is input and output

    // What REBLUR and RELAX have, in whichever of them is used.
    template <class Change> void changeSettings(Change&& change)
    {
        change(settings);
        change(relaxSettings);
    }
};

Family familyOf(nrd::Denoiser denoiser);
inline bool isRelax(nrd::Denoiser denoiser) { return familyOf(denoiser) == Family::Relax; }
nrd::CheckerboardMode checkerboardOf(const Setup& setup);
void setCheckerboard(Setup& setup, nrd::CheckerboardMode mode); // of every family that has it

// A frame's camera, and its matrices as the application hands them over.
struct View
{
    quality::Camera camera; // left-handed, metres, without jitter
    glm::vec2 jitter{0.0f}; // pixels
    glm::mat4 viewToClip{1.0f};
    glm::mat4 worldToView{1.0f};
};

uint32_t guideDivisor(const Setup& setup);
glm::ivec2 rectOf(const Setup& setup, int frame);   // of the full resolution
glm::ivec2 pixelsOf(const Setup& setup, int frame); // of the guides
View makeView(const Setup& setup, int frame);
quality::Guides renderView(const Setup& setup, const View& view, int frame);
nrd::CommonSettings makeCommon(const Setup& setup, int frame, bool isFirst);

inline int divideUp(int a, uint32_t b) { return (a + static_cast<int>(b) - 1) / static_cast<int>(b); }
} // namespace options
