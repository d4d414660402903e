#include "frames.h"
#include "denoisers/relax.h"
#include "expand.h"
#include "frame_state.h"
#include "valid_settings.h"
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace nrdtest
{
namespace
{
constexpr size_t kFrameCount = 1024;

glm::dmat3 rotationAbout(const Vec3d& axis, double angle)
{
    return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, axis));
}

void copy(const glm::dmat4& from, float (&to)[16])
{
    for (int i = 0; i < 16; i++) to[i] = static_cast<float>(glm::value_ptr(from)[i]);
}

// The view space of half of the applications looks along -z.
glm::dmat4 projectionOf(const TrueCamera& camera, double zSign)
{
    glm::dmat4 m(0.0);
    m[0][0] = camera.scale.x;
    m[1][1] = camera.scale.y;
    m[2][2] = camera.isOrtho ? zSign * 1e-4 : 0.0; // infinite and reversed, if perspective
    m[2][3] = camera.isOrtho ? 0.0 : zSign;
    m[3][2] = camera.isOrtho ? 0.0 : 0.1;
    m[3][3] = camera.isOrtho ? 1.0 : 0.0;
    return m;
}

glm::dmat4 worldToViewOf(const TrueCamera& camera, double zSign)
{
    glm::dmat4 m(camera.worldToView);
    m[3] = glm::dvec4(-(camera.worldToView * camera.position), 1.0);
    for (int i = 0; i < 4; i++) m[i][2] *= zSign;
    return m;
}

struct Pair
{
    TrueCamera now, before;
};

Pair drawCameras(Random& random, const FrameRange& range, const glm::dvec2& size)
{
    Pair pair;
    const double slope = std::tan(0.5 * random.uniform(range.minFov, range.maxFov) * kPi / 180.0);
    // Scales as single precision holds them: they are what the application gives.
    const glm::dvec2 scale = glm::dvec2(glm::vec2(std::max(size.x, size.y) / size / slope));
    pair.now = {rotationAbout(random.direction(), random.uniform(0.0, kPi)),
                random.direction() * random.logarithmic(1e-2, 1e6), scale, range.hasOrtho && random.oneIn(4)};
    pair.before = pair.now;
    if (random.oneIn(4)) return pair;
    pair.before.position += random.direction() * random.logarithmic(1e-5, 1e3);
    pair.before.worldToView =
        rotationAbout(random.direction(), random.logarithmic(1e-6, 0.5 * kPi)) * pair.before.worldToView;
    return pair;
}

nrd::CommonSettings settingsOf(const Pair& pair, const glm::dvec2& size, MotionKind motion, double zSign)
{
    nrd::CommonSettings common = test::makeCommon();
    copy(projectionOf(pair.now, zSign), common.viewToClipMatrix);
    copy(projectionOf(pair.before, zSign), common.viewToClipMatrixPrev);
    copy(worldToViewOf(pair.now, zSign), common.worldToViewMatrix);
    copy(worldToViewOf(pair.before, zSign), common.worldToViewMatrixPrev);
    for (auto target : {&common.resourceSize, &common.resourceSizePrev, &common.rectSize, &common.rectSizePrev})
        for (int i = 0; i < 2; i++) (*target)[i] = static_cast<uint16_t>(size[i]);
    const Vec3d delta = pair.before.position - pair.now.position;
    for (int i = 0; i < 3; i++) common.cameraDelta[i] = delta[i];
    common.isCameraDeltaAvailable = true;
    common.isMotionVectorInWorldSpace = motion == MotionKind::World;
    common.motionVectorScale[2] = motion == MotionKind::Screen ? 0.0f : 1.0f;
    common.denoisingRange = 1e7f;
    return common;
}

nrd::shared::DenoiserConstants constantsOf(const nrd::CommonSettings& common)
{
    const nrd::FamilySettings settings = nrd::RelaxSettings{};
    const nrd::FrameState state = nrd::makeFrameState(common, 1.0f);
    const nrd::VariantOfFamily which = nrd::findVariant(nrd::Denoiser::RELAX_DIFFUSE_SPECULAR);
    const nrd::RequestHistory history;
    const nrd::Variant& variant = which.family->variants[which.variant];
    return nrd::makeRelaxConstants({common, common, settings, state, history, variant, false, 1, 1});
}
} // namespace

Frames drawFrames(const FrameRange& range, MotionKind motion)
{
    Random random(static_cast<uint64_t>(motion) + 99);
    Frames frames;
    for (size_t i = 0; i < kFrameCount; i++)
    {
        const glm::dvec2 size(1 + random.below(range.maxSize), 1 + random.below(range.maxSize));
        const Pair pair = drawCameras(random, range, size);
        frames.constants.push_back(constantsOf(settingsOf(pair, size, motion, random.coin() ? 1.0 : -1.0)));
        frames.now.push_back(pair.now);
        frames.before.push_back(pair.before);
    }
    return frames;
}

Arguments drawNeighbours(Random& random, const Frames& frames)
{
    constexpr int kReach = 32;
    Arguments in;
    in.h[3] = static_cast<float>(random.below(static_cast<int>(frames.constants.size())));
    const nrd::shared::vec2 size = frames.constants[frameOf(in)].rectSize;
    const int width = static_cast<int>(size.x), height = static_cast<int>(size.y);
    const int x = random.below(width), y = random.below(height);
    const auto near = [&](int place, int end)
    { return std::clamp(place + random.below(2 * kReach + 1) - kReach, 0, end - 1); };
    const double viewZ = random.logarithmic(1e-3, 1e6);
    const double slip = random.coin() ? 0.0 : random.uniform(-1.0, 1.0) * random.logarithmic(1e-6, 1.0);
    in.a = toVec4(x, y, viewZ);
    in.c = toVec4(near(x, width), near(y, height), viewZ * (1.0 + slip));
    return in;
}

double extentScale(const Frames& frames, size_t frame, double viewZ) { return frames.now[frame].isOrtho ? 1.0 : viewZ; }

Vec3d viewOfPixel(const Frames& frames, size_t frame, const Vec4& pixel)
{
    const nrd::shared::vec2 size = frames.constants[frame].rectSize;
    const Vec3d ray = frames.now[frame].rayOf({(pixel[0] + 0.5) / size.x, (pixel[1] + 0.5) / size.y});
    const double scale = extentScale(frames, frame, pixel[2]);
    return {ray.x * scale, ray.y * scale, pixel[2]};
}

double sizeOf(const Frames& frames, const Arguments& neighbours)
{
    const size_t frame = frameOf(neighbours);
    const double extent = glm::length(toDouble(frames.constants[frame].frustum));
    double size = 0.0;
    for (const Vec4& pixel : {neighbours.a, neighbours.c})
        size += glm::length(viewOfPixel(frames, frame, pixel)) + extent * extentScale(frames, frame, pixel[2]);
    return size;
}

glm::dvec4 toDouble(const nrd::shared::vec4& v) { return {v.x, v.y, v.z, v.w}; }
glm::dmat4 toDouble(const nrd::shared::mat4& m) { return glm::dmat4(glm::make_mat4(m.columns)); }

ReprojectionFrame reprojectionOf(const nrd::shared::DenoiserConstants& g)
{
    const MotionKind motion = g.motionVectorScale.w != 0.0f   ? MotionKind::World
                              : g.motionVectorScale.z != 0.0f ? MotionKind::ScreenWithDepth
                                                              : MotionKind::Screen;
    return {toDouble(g.worldToClipPrev),
            toDouble(g.worldToViewPrev),
            toDouble(g.viewToWorldPrev),
            toDouble(g.frustumPrev),
            motion,
            g.cameraDelta.w != 0.0f};
}
} // namespace nrdtest
