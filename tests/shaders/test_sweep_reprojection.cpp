// Where surfaces and images were, over random input and random cameras.
#include "catch.h"
#include "frames.h"
#include "functions.h"
#include "geometry.h"
#include "lobes.h"
#include "reprojection.h"
#include "sweep.h"

using namespace nrdtest;

namespace
{
constexpr double kRounding = 0x1p-24; // of a float near 1

Mirror mirrorOf(const Arguments& in) { return {toDouble(in.a), toDouble(in.c), toDouble(in.b), in.c[3], in.b[3]}; }

// a = X, hit distance; b = N, curvature; c = Xprev, roughness; d = motion of what is reflected.
Arguments drawMirror(Random& random)
{
    const Vec3d X = random.direction() * random.logarithmic(1e-3, 1e6);
    const double size = glm::length(X);
    Vec3d N = random.normal();
    if (glm::dot(N, X) > 0.0) N = -N;
    const double hitDist = random.oneIn(8) ? (random.coin() ? 0.0 : 65504.0) : size * random.logarithmic(1e-4, 1e2);
    const double sign = random.coin() ? 1.0 : -1.0;
    const double curvature = random.oneIn(4) ? 0.0 : sign * random.logarithmic(1e-4, 10.0) / size;
    const Vec3d Xprev = random.coin() ? X : X + random.direction() * size * random.logarithmic(1e-6, 1e-1);
    return {toVec4(X, hitDist), toVec4(N, curvature), toVec4(Xprev, random.roughness()),
            toVec4(random.direction() * random.logarithmic(1e-4, 1e2))};
}

// Either side of the threshold below which a focus is taken as flat.
bool isAtThreshold(const Arguments& in)
{
    const double depth = 2.0 * std::abs(in.b[3]) * in.a[3];
    return std::abs(std::abs(lensDenominator(mirrorOf(in), in.a[3])) - 1e-3) < 1e-5 * (1.0 + depth);
}

// Factors that multiply the error of the dominant direction: near a focus, and where silhouettes curve away.
double imageCondition(const Arguments& in)
{
    const Mirror m = mirrorOf(in);
    const double denominator = std::abs(lensDenominator(m, in.a[3]));
    const double focus = denominator < 1e-3 ? 1.0 : 1.0 / denominator;
    const double lens = 1.0 + 2.0 * std::abs(m.curvature) * in.a[3] * std::min(focus, 1e3);
    return std::min(focus, 1e3) * lens * (1.0 + glm::length(m.X) * std::max(m.curvature, 0.0));
}

const char* const kImageReason = "the error of the dominant direction and its factor, 5e-6 each, and their roundings";

double imageError(const Arguments& in, const Results& out)
{
    if (isAtThreshold(in)) return 0.0;
    const Mirror m = mirrorOf(in);
    const double size = glm::length(m.X) + glm::length(m.Xprev) + in.a[3] * imageCondition(in);
    return glm::distance(toDouble(out.first), virtualPosition(m, in.a[3])) / size;
}

double imageMotionError(const Arguments& in, const Results& out)
{
    if (isAtThreshold(in)) return 0.0;
    const Vec3d motion = toDouble(in.d);
    return glm::distance(toDouble(out.first), imageMotion(mirrorOf(in), in.a[3], motion)) /
           (glm::length(motion) * imageCondition(in));
}

// a = uv, viewZ; b = X, c = motion: anywhere, also behind either camera.
Arguments drawAnyMotion(Random& random, const Frames& frames)
{
    Arguments in;
    in.h[3] = static_cast<float>(random.below(static_cast<int>(frames.constants.size())));
    const double viewZ = random.logarithmic(1e-3, 1e6);
    in.a = toVec4(random.unit(), random.unit(), viewZ);
    in.b = toVec4(random.direction() * viewZ * random.uniform(1.0, 3.0));
    const bool isWorld = frames.constants[0].motionVectorScale.w != 0.0f;
    in.c = toVec4(random.direction() * random.logarithmic(1e-6, 1.0) * (isWorld ? viewZ : 1.0));
    if (!isWorld) in.c[2] *= static_cast<float>(viewZ);
    return in;
}

glm::dmat4 absolute(const glm::dmat4& m)
{
    glm::dmat4 result;
    for (int i = 0; i < 4; i++) result[i] = glm::abs(m[i]);
    return result;
}

// In ulp of what is summed up; behind the camera or next to its plane every answer is off screen.
double projectionError(const ReprojectionFrame& frame, const Vec3d& X, const glm::dvec2& got,
                       const glm::dvec2& expected)
{
    const glm::dvec4 terms = absolute(frame.worldToClipPrev) * glm::dvec4(glm::abs(X), 1.0);
    const double w = (frame.worldToClipPrev * glm::dvec4(X, 1.0)).w;
    if (std::abs(w) < 1e-5 * terms.w || w <= 1e-8) return 0.0;
    double worst = 0.0;
    for (int i = 0; i < 2; i++)
    {
        const double ndc = std::abs(2.0 * expected[i] - 1.0), size = (terms[i] + ndc * terms.w) / w + 1.0;
        worst = std::max(worst, std::abs(got[i] - expected[i]) / (size * kRounding));
    }
    return worst;
}

double motionError(const Frames& frames, const Arguments& in, const Results& out)
{
    const ReprojectionFrame frame = reprojectionOf(frames.constants[frameOf(in)]);
    const Vec3d X = toDouble(in.b), motion = toDouble(in.c);
    const glm::dvec2 uv(in.a[0], in.a[1]), got(out.first[0], out.first[1]);
    const PreviousPlace expected = followedMotion(frame, uv, in.a[2], X, motion);
    const double size = glm::length(X) + glm::length(Vec3d(frame.viewToWorldPrev[3])) + std::abs(in.c[2]) + in.a[2];
    const double extent = glm::length(frame.frustumPrev) * (1.0 + glm::length(glm::dvec2(motion)));
    const double seenSize = size + extent * (frame.isOrtho ? 1.0 : size);
    const double placeError = glm::distance(toDouble(out.second), expected.X) / (seenSize * kRounding);
    if (frame.motion != MotionKind::World)
        return std::max({placeError, ulps(got.x, expected.uv.x, 1.0 + std::abs(motion.x)),
                         ulps(got.y, expected.uv.y, 1.0 + std::abs(motion.y))});
    return std::max(placeError, projectionError(frame, Vec3d(glm::vec3(X + motion)), got, expected.uv));
}

// A pixel that both cameras see; the surface moves by itself up to a tenth of its distance.
struct Sight
{
    glm::dvec2 uv, uvPrev;
    Vec3d relative, before; // to the current camera in world space, and in the previous view space
};
Sight sightOf(const Frames& frames, const Arguments& in, const Vec3d& motion)
{
    const size_t i = frameOf(in);
    const nrd::shared::vec2 size = frames.constants[i].rectSize;
    Sight sight;
    sight.uv = {(in.a[0] + 0.5) / size.x, (in.a[1] + 0.5) / size.y};
    sight.relative = glm::transpose(frames.now[i].worldToView) * (frames.now[i].rayOf(sight.uv) * double{in.a[2]});
    const Vec3d delta = frames.before[i].position - frames.now[i].position;
    sight.before = frames.before[i].worldToView * (sight.relative + motion - delta);
    sight.uvPrev = frames.before[i].uvOf(sight.before);
    return sight;
}

bool isSeen(const Sight& s)
{
    return s.before.z > 0.05 * glm::length(s.before) && glm::all(glm::greaterThan(s.uvPrev, glm::dvec2(0.0))) &&
           glm::all(glm::lessThan(s.uvPrev, glm::dvec2(1.0)));
}

// What was not seen before is drawn again; d: the object's motion.
Arguments drawSight(Random& random, const Frames& frames)
{
    while (true)
    {
        Arguments in;
        in.h[3] = static_cast<float>(random.below(static_cast<int>(frames.constants.size())));
        const size_t i = frameOf(in);
        const nrd::shared::vec2 size = frames.constants[i].rectSize;
        const double delta = glm::distance(frames.before[i].position, frames.now[i].position);
        in.a = toVec4(random.below(static_cast<int>(size.x)), random.below(static_cast<int>(size.y)),
                      random.logarithmic(std::max(1e-3, 4.0 * delta), 1e6));
        const nrd::shared::vec4 scale = frames.constants[i].motionVectorScale;
        const bool isStatic = scale.z == 0.0f; // 2D motion knows nothing else
        if (!isStatic) in.d = toVec4(random.direction() * random.logarithmic(1e-6, 0.1) * double{in.a[2]});
        const Sight sight = sightOf(frames, in, toDouble(in.d));
        if (!isSeen(sight)) continue;
        in.c = in.d;
        if (scale.w == 0.0f) in.c = toVec4(Vec3d(sight.uvPrev - sight.uv, sight.before.z - in.a[2]));
        return in;
    }
}

// What the application gives is exact, so all that differs is the library's: matrices, and the passes' sums.
struct SightErrors
{
    double angle; // of the direction from the previous camera
    double pixels;
    double place; // of Xprev, relative to its distance
    double depth; // to expect, likewise
};
SightErrors sightErrors(const Frames& frames, const Arguments& in, const Results& out)
{
    const size_t i = frameOf(in);
    const Vec3d motion = toDouble(in.d), delta = frames.before[i].position - frames.now[i].position;
    const Sight sight = sightOf(frames, in, motion);
    const glm::dvec2 got(out.first[0], out.first[1]);
    const nrd::shared::vec2 size = frames.constants[i].rectSize;
    // Positions are fractions of the frustum.
    const double distance = (glm::length(sight.relative) + glm::length(delta) + glm::length(motion)) *
                            (1.0 + glm::length(toDouble(frames.constants[i].frustum)));
    const TrueCamera& before = frames.before[i];
    return {angleBetween(before.rayOf(got), before.rayOf(sight.uvPrev)) * glm::length(sight.before) / distance,
            glm::length((got - sight.uvPrev) * glm::dvec2(size.x, size.y)),
            glm::distance(toDouble(out.second), sight.relative + motion) / distance,
            std::abs(out.first[2] - sight.before.z) / distance};
}

struct Kind
{
    MotionKind motion;
    const char* anywhere;
    const char* seen;
    double bound; // of what is seen, roundings
};
constexpr Kind kKinds[] = {
    {MotionKind::Screen, "motion on screen, static depth", "2D motion, seen by random cameras", 24.0},
    {MotionKind::ScreenWithDepth, "motion on screen and in depth", "2.5D motion, seen by random cameras", 24.0},
    {MotionKind::World, "motion in the world", "world motion, seen by random cameras", 24.0},
};
} // namespace

TEST_CASE("images over random mirrors are where double precision has them", "[gpu][sweep]")
{
    check({"virtual position, near a focus too", "of the distances and their condition", 1.2e-5, kImageReason,
           FN_VIRTUAL_POSITION, drawMirror, imageError});
    check({"motion of an image, near a focus too", "of the motion and its condition", 1.2e-5, kImageReason,
           FN_IMAGE_MOTION, drawMirror, imageMotionError});
}

TEST_CASE("reprojection over random cameras and motion agrees with double precision", "[gpu][sweep]")
{
    for (const Kind& kind : kKinds)
    {
        const Frames frames = drawFrames({.hasOrtho = true}, kind.motion);
        check({kind.anywhere, "roundings of what is summed up", 12.0, "five sums and products twice, 2.5 of a division",
               FN_FOLLOW_MOTION, [&](Random& random) { return drawAnyMotion(random, frames); },
               [&](const Arguments& in, const Results& out) { return motionError(frames, in, out); }},
              frames.constants);
    }
}

TEST_CASE("what two random cameras see is found where it was", "[gpu][sweep]")
{
    for (const Kind& kind : kKinds)
    {
        const Frames frames = drawFrames({}, kind.motion);
        check({kind.seen, "roundings of the frustum's size, as angle, place and depth", kind.bound,
               "matrices rounded, three of them, of three products and sums", FN_REPROJECT,
               [&](Random& random) { return drawSight(random, frames); },
               [&](const Arguments& in, const Results& out)
               {
                   const SightErrors e = sightErrors(frames, in, out);
                   return std::max({e.angle, e.place, e.depth}) / kRounding;
               }},
              frames.constants);
    }
}

TEST_CASE("at usual fields of view the error of a reprojection is far below a pixel", "[gpu][sweep]")
{
    const Frames frames = drawFrames({.minFov = 20.0, .maxFov = 120.0, .maxSize = 4096}, MotionKind::World);
    check({"world motion, 20 to 120 degrees, up to 4096 pixels", "pixels", 0.02,
           "24 roundings of the distance, a pixel of 8.5e-5 radians", FN_REPROJECT,
           [&](Random& random) { return drawSight(random, frames); },
           [&](const Arguments& in, const Results& out) { return sightErrors(frames, in, out).pixels; }},
          frames.constants);
}
