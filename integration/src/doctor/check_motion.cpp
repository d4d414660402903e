// Motion vectors under every reading of them: against where the cameras put surfaces that stand still, which are taken
// to be the most, and for what moves by itself against the last frame's depths. The reading that fits is named.
#include "check.h"
#include "motion_candidates.h"

namespace nrd::doctor
{
namespace
{
constexpr double kClearly = 0.25;     // how much smaller the error of a better reading is
constexpr size_t kLeastSamples = 300; // in a frame
constexpr size_t kLeastMoving = 60;

// Errors of all readings, each a number per frame.
struct Scores
{
    std::vector<Series> errors;

    void add(const std::vector<double>& values)
    {
        errors.resize(values.size());
        for (size_t i = 0; i < values.size(); i++) errors[i].add(values[i]);
    }
    double given() const { return errors.empty() ? std::nan("") : errors[0].value(); }
    /// The earliest of those that fit best.
    size_t best(double tie) const
    {
        double least = given();
        for (const Series& error : errors) least = std::min(least, error.value());
        for (size_t i = 0; i < errors.size(); i++)
            if (errors[i].value() <= 1.2 * least + tie) return i;
        return 0;
    }
};

class MotionCheck final : public Check
{
public:
    void look(const Frame& frame, const Frame* before) override
    {
        if (!before || !frame.input().motion) return;
        if (!m_candidates.empty() && isSaidToBeWorldSpace() != frame.common().isMotionVectorInWorldSpace) return;
        m_candidates = motionCandidates(frame);
        const MotionQuery query = {frame, *before, frame.cameraOf(*before)};
        lookAtStill(query);
        lookAtMoving(query);
    }

    void report(Reports& reports) const override
    {
        if (m_candidates.empty()) return;
        const size_t best = m_still.best(kTiePixels);
        const double fit = best == 0 ? 0.0 : m_still.errors[best].value();
        const bool isJitter = m_candidates[best].jitter != 0.0;
        // A reading must tell where the camera's motion took the pixels: one that shrinks all vectors to nothing only
        // fits as long as most of the picture stays in place.
        const bool isTelling = isJitter || fit < kClearly * m_way.value();
        if (best != 0 && isTelling && m_still.given() > kLeastPixels && fit < kClearly * m_still.given())
        {
            const std::string cure = isJitter ? "holds the jitter's change; compute it with matrices without jitter"
                                              : describe(m_candidates[best], isSaidToBeWorldSpace());
            reports.push_back({isJitter ? DoctorRule::JITTER_IN_MOTION : DoctorRule::MOTION, FindingSeverity::FAULT,
                               ResourceType::IN_MV, m_still.given(),
                               text("IN_MV is off by %.2f pixels where the scene stands still and %s (then it fits to "
                                    "%.2f pixels)",
                                    m_still.given(), cure.c_str(), fit)});
            return;
        }
        reportMoving(reports);
    }

private:
    static constexpr double kLeastPixels = 0.1;
    static constexpr double kTiePixels = 0.02;
    static constexpr double kZero = 1e-6;         // of the screen
    static constexpr double kMostMismatch = 0.05; // of a depth: all larger ones are another surface
    static constexpr double kLeastMismatch = 0.004;

    bool isSaidToBeWorldSpace() const { return m_candidates[0].isWorldSpace; }

    void lookAtStill(const MotionQuery& query)
    {
        std::vector<std::vector<double>> errors(m_candidates.size());
        std::vector<double> ways;
        forSamples(query.frame,
                   [&](int x, int y)
                   {
                       const Camera::Pixel still = query.still(x, y);
                       const Camera::Pixel here = {query.frame.sampleU(x), query.frame.sampleV(y), 0.0};
                       if (isFinite({still.u, still.v, still.z})) ways.push_back(query.pixelsBetween(still, here));
                       const bool isZero = length(query.vector(x, y)) < kZero;
                       for (size_t i = 0; i < m_candidates.size(); i++)
                       {
                           // In world units a motion on screen is next to nothing, which fits what stands still.
                           const bool isMistaken = m_candidates[i].isWorldSpace && !isSaidToBeWorldSpace() && !isZero;
                           const Camera::Pixel moved = isMistaken ? here : query.moved(m_candidates[i], x, y);
                           const double error = query.pixelsBetween(moved, still);
                           if (std::isfinite(error)) errors[i].push_back(error);
                       }
                   });
        if (errors[0].size() < kLeastSamples) return;
        std::vector<double> medians;
        for (std::vector<double>& values : errors) medians.push_back(median(std::move(values)));
        m_still.add(medians);
        m_way.add(median(std::move(ways)));
    }

    // Pixels that by their vectors move on their own, if those are read as said.
    void lookAtMoving(const MotionQuery& query)
    {
        std::vector<double> sums(m_candidates.size(), 0.0);
        size_t count = 0;
        forSamples(query.frame,
                   [&](int x, int y)
                   {
                       const double way = query.pixelsBetween(query.moved(m_candidates[0], x, y), query.still(x, y));
                       if (!(way > 1.0)) return;
                       for (size_t i = 0; i < m_candidates.size(); i++)
                           sums[i] +=
                               std::min(query.before.depthMismatch(query.moved(m_candidates[i], x, y)), kMostMismatch);
                       count++;
                   });
        if (count < kLeastMoving) return;
        for (double& sum : sums) sum /= static_cast<double>(count);
        m_moving.add(sums);
    }

    void reportMoving(Reports& reports) const
    {
        const size_t best = m_moving.best(0.0);
        if (best == 0 || m_candidates[best].jitter != 0.0 || m_moving.given() < kLeastMismatch) return;
        const double fit = m_moving.errors[best].value();
        if (!(fit < kClearly * m_moving.given())) return;
        reports.push_back({DoctorRule::MOTION, FindingSeverity::FAULT, ResourceType::IN_MV, m_moving.given(),
                           text("IN_MV of what moves leads to other depths in the last frame (off by %.2f %% in the "
                                "mean) and %s (then %.2f %%)",
                                100.0 * m_moving.given(), describe(m_candidates[best], isSaidToBeWorldSpace()).c_str(),
                                100.0 * fit)});
    }

    std::vector<MotionCandidate> m_candidates; // of the latest frame; their order never changes
    Scores m_still;                            // median distance in pixels
    Series m_way;                              // median pixels that the camera moves what stands still
    Scores m_moving;                           // mean mismatch of depths
};

// The third component on screen: what IN_VIEWZ stored in the last frame, minus what it stores now.
class MotionDepthCheck final : public Check
{
public:
    void look(const Frame& frame, const Frame* before) override
    {
        const CommonSettings& common = frame.common();
        if (!before || !frame.input().motion) return;
        if (common.isMotionVectorInWorldSpace || common.motionVectorScale[2] == 0.0f) return;
        const MotionQuery query = {frame, *before, frame.cameraOf(*before)};
        std::vector<double> errors[kFactorCount];
        forSamples(frame,
                   [&](int x, int y)
                   {
                       const double z = frame.viewZ(x, y);
                       const double stored = double(*frame.guide(frame.input().viewZ, x, y));
                       const double toPositive = std::copysign(double(common.viewZScale), stored);
                       const double given = query.vector(x, y).z * toPositive;
                       const double expected = query.still(x, y).z - z;
                       for (size_t i = 0; i < kFactorCount; i++)
                           if (std::isfinite(given)) errors[i].push_back(std::abs(kFactors[i] * given - expected) / z);
                   });
        if (errors[0].size() < kLeastSamples) return;
        std::vector<double> medians;
        for (std::vector<double>& values : errors) medians.push_back(median(std::move(values)));
        m_scores.add(medians);
    }

    void report(Reports& reports) const override
    {
        const size_t best = m_scores.best(0.0);
        if (best == 0 || m_scores.given() < kLeastError) return;
        const double fit = m_scores.errors[best].value();
        if (!(fit < kClearly * m_scores.given())) return;
        const char* const cure = kFactors[best] == 0.0
                                     ? "is no difference of IN_VIEWZ; set motionVectorScale[2] = 0"
                                     : "looks like current - previous; multiply motionVectorScale[2] by -1";
        reports.push_back({DoctorRule::MOTION_DEPTH, FindingSeverity::FAULT, ResourceType::IN_MV, m_scores.given(),
                           text("IN_MV.z is off by %.2f %% of the depth where the scene stands still and %s (then "
                                "%.2f %%)",
                                100.0 * m_scores.given(), cure, 100.0 * fit)});
    }

private:
    static constexpr double kFactors[] = {1.0, -1.0, 0.0};
    static constexpr size_t kFactorCount = std::size(kFactors);
    static constexpr double kLeastError = 1e-3;
    Scores m_scores; // median error as a fraction of the depth
};
} // namespace

void addMotionChecks(Checks& checks)
{
    checks.push_back(std::make_unique<MotionCheck>());
    checks.push_back(std::make_unique<MotionDepthCheck>());
}
} // namespace nrd::doctor
