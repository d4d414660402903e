// Rules that the settings of two frames tell alone.
#include "check.h"

namespace nrd::doctor
{
namespace
{
class FrameIndexCheck final : public Check
{
public:
    void look(const Frame& frame, const Frame* before) override
    {
        if (!before) return;
        m_same.add(frame.common().frameIndex == before->common().frameIndex);
        m_index = frame.common().frameIndex;
    }

    void report(Reports& reports) const override
    {
        if (m_same.count == 0) return;
        reports.push_back(
            {DoctorRule::FRAME_INDEX, FindingSeverity::FAULT, ResourceType::MAX_NUM, m_same.value(),
             text("frameIndex stood still at %u in %.0f %% of the frames, so that every frame starts over "
                  "with the same noise; count it up by 1 per frame, also where a command buffer is "
                  "recorded once",
                  m_index, 100.0 * m_same.value())});
    }

private:
    Share m_same;
    uint32_t m_index = 0;
};

// Of elements beyond 1 a fraction of them, as floats are rounded.
template <size_t N> double maxDifference(const float (&a)[N], const float (&b)[N])
{
    double result = 0.0;
    for (size_t i = 0; i < N; i++)
        result = std::max(result, std::abs(double(a[i]) - double(b[i])) / std::max(std::abs(double(b[i])), 1.0));
    return result;
}

// A matrix whose "Prev" must be what was given as current a frame ago.
struct MatrixFault
{
    const char* name;
    Share isWrong;
    Share isCurrent; // among the wrong ones: simply the current one again
    double worst = 0.0;

    void add(const float (&current)[16], const float (&previous)[16], const float (&lastCurrent)[16])
    {
        constexpr double kTolerance = 1e-5; // matrices may be computed twice
        const double difference = maxDifference(previous, lastCurrent);
        isWrong.add(difference > kTolerance);
        if (difference <= kTolerance) return;
        worst = std::max(worst, difference);
        isCurrent.add(maxDifference(previous, current) <= 0.01 * difference);
    }

    void report(Reports& reports) const
    {
        if (isWrong.count == 0) return;
        const bool isSame = isCurrent.value() > 0.5;
        reports.push_back(
            {DoctorRule::PREVIOUS_CAMERA, FindingSeverity::FAULT, ResourceType::MAX_NUM, worst,
             isSame ? text("%sPrev equals the current %s while the camera moves (elements changed by up to %.3g): keep "
                           "last frame's matrix and hand it over",
                           name, name, worst)
                    : text("%sPrev is not last frame's %s in %.0f %% of the frames (elements differ by up to %.3g): "
                           "hand over last frame's, bit for bit",
                           name, name, 100.0 * isWrong.value(), worst)});
    }
};

class PreviousCameraCheck final : public Check
{
public:
    void look(const Frame& frame, const Frame* before) override
    {
        if (!before) return;
        const CommonSettings& now = frame.common();
        const CommonSettings& last = before->common();
        m_view.add(now.worldToViewMatrix, now.worldToViewMatrixPrev, last.worldToViewMatrix);
        m_projection.add(now.viewToClipMatrix, now.viewToClipMatrixPrev, last.viewToClipMatrix);
        m_jitter.add(maxDifference(now.cameraJitterPrev, last.cameraJitter) > 1e-4);
        lookAtDelta(now, last);
    }

    void report(Reports& reports) const override
    {
        m_view.report(reports);
        m_projection.report(reports);
        if (m_jitter.count != 0)
            add(reports, m_jitter.value(),
                text("cameraJitterPrev is not last frame's cameraJitter in %.0f %% of the frames",
                     100.0 * m_jitter.value()));
        if (m_deltaWrong.count == 0) return;
        const char* const hint = m_deltaNegated.value() > 0.5 ? "it is current minus previous: negate it"
                                                              : "it must be previous minus current camera position";
        add(reports, m_deltaWrong.value(),
            text("cameraDelta does not fit the matrices in %.0f %% of the frames: %s", 100.0 * m_deltaWrong.value(),
                 hint));
    }

private:
    static void add(Reports& reports, double evidence, std::string sentence)
    {
        reports.push_back({DoctorRule::PREVIOUS_CAMERA, FindingSeverity::FAULT, ResourceType::MAX_NUM, evidence,
                           std::move(sentence)});
    }

    void lookAtDelta(const CommonSettings& now, const CommonSettings& last)
    {
        if (!now.isCameraDeltaAvailable) return;
        const Vec3 position = cameraPosition(now.worldToViewMatrix);
        const Vec3 expected = cameraPosition(last.worldToViewMatrix) - position;
        const Vec3 given = {now.cameraDelta[0], now.cameraDelta[1], now.cameraDelta[2]};
        // Far from the origin the matrices have lost what cameraDelta still knows.
        const double tolerance = 1e-3 * length(expected) + 1e-5 * length(position) + 1e-6;
        const bool isWrong = length(given - expected) > tolerance;
        m_deltaWrong.add(isWrong);
        if (isWrong) m_deltaNegated.add(length(given + expected) <= tolerance);
    }

    MatrixFault m_view = {"worldToViewMatrix", {}, {}};
    MatrixFault m_projection = {"viewToClipMatrix", {}, {}};
    Share m_jitter;
    Share m_deltaWrong;
    Share m_deltaNegated; // among the wrong ones
};

// A jittered projection moves its principal point by a pixel or less, to and fro; a lens shift that is animated goes
// on.
class MatrixJitterCheck final : public Check
{
public:
    void look(const Frame& frame, const Frame* before) override
    {
        if (!before) return;
        const Vec3 shift = principalPoint(frame) - principalPoint(*before);
        const Vec3 jitter = jitterOf(frame) - jitterOf(*before);
        const double way = length(shift);
        const bool isSmall = way > kLeast && way < kMost;
        m_small.add(isSmall);
        if (!isSmall) return;
        m_way += way;
        m_net = m_net + shift;
        // The point moves with the sample or against it, whichever way the application jitters.
        m_asJitter.add(std::min(length(shift - jitter), length(shift + jitter)) < 0.1 * way);
    }

    void report(Reports& reports) const override
    {
        if (m_small.count == 0 || m_small.value() < 0.5) return;
        const bool isToAndFro = m_small.count >= kLeastSteps && length(m_net) < 0.5 * m_way;
        if (m_asJitter.value() < 0.5 && !isToAndFro) return;
        const double step = m_way / static_cast<double>(m_small.count);
        reports.push_back({DoctorRule::JITTER_IN_MATRIX, FindingSeverity::FAULT, ResourceType::MAX_NUM, step,
                           text("viewToClipMatrix moves by %.2f pixels from frame to frame, as jitter does: hand over "
                                "the projection without jitter, and the jitter in cameraJitter",
                                step)});
    }

private:
    static constexpr double kLeast = 0.01; // pixels
    static constexpr double kMost = 2.0;   // pixels; jitter spans one in each direction
    static constexpr uint64_t kLeastSteps = 3;

    // Both in pixels, y downwards.
    static Vec3 principalPoint(const Frame& frame)
    {
        return {0.5 * frame.width() * frame.camera().principalX(), -0.5 * frame.height() * frame.camera().principalY()};
    }
    static Vec3 jitterOf(const Frame& frame)
    {
        return {double(frame.common().cameraJitter[0]), double(frame.common().cameraJitter[1])};
    }

    Share m_small;
    Share m_asJitter; // among the small ones
    double m_way = 0.0;
    Vec3 m_net;
};
} // namespace

void addSettingsChecks(Checks& checks)
{
    checks.push_back(std::make_unique<FrameIndexCheck>());
    checks.push_back(std::make_unique<PreviousCameraCheck>());
    checks.push_back(std::make_unique<MatrixJitterCheck>());
}
} // namespace nrd::doctor
