// Rules about single values: what is not a number, what cannot be, and pixels that hold no surface.
#include "check.h"

namespace nrd::doctor
{
namespace
{
struct Slot
{
    ResourceType type;
    const float* DoctorFrame::*image;
    int componentCount;
    bool isGuide; // moved by rectOrigin, and must be finite everywhere in range
};
constexpr Slot kSlots[] = {
    {ResourceType::IN_VIEWZ, &DoctorFrame::viewZ, 1, true},
    {ResourceType::IN_MV, &DoctorFrame::motion, 3, true},
    {ResourceType::IN_NORMAL_ROUGHNESS, &DoctorFrame::normalRoughness, 4, true},
    {ResourceType::IN_DIFF_RADIANCE_HITDIST, &DoctorFrame::diffuse, 4, false},
    {ResourceType::IN_SPEC_RADIANCE_HITDIST, &DoctorFrame::specular, 4, false},
};
constexpr size_t kSlotCount = std::size(kSlots);
constexpr size_t kFirstSignal = 3;

const float* texelOf(const Frame& frame, const Slot& slot, int x, int y)
{
    const float* image = frame.input().*slot.image;
    if (!image) return nullptr;
    return slot.isGuide ? frame.guide(image, x, y) : frame.signal(image, x, y);
}

class FiniteCheck final : public Check
{
public:
    void look(const Frame& frame, const Frame*) override
    {
        for (int y = 0; y < frame.height(); y++)
            for (int x = 0; x < frame.width(); x++) lookAtPixel(frame, x, y);
    }

    void report(Reports& reports) const override
    {
        for (size_t i = 0; i < kSlotCount; i++)
        {
            const Count& count = m_counts[i];
            if (count.pixels == 0) continue;
            const char* const advice = kSlots[i].type == ResourceType::IN_VIEWZ
                                           ? "sky takes any finite value beyond denoisingRange"
                                       : kSlots[i].isGuide ? "guides must be finite wherever there is a surface"
                                                           : "drop the path that made it before averaging and packing";
            reports.push_back(
                {DoctorRule::NON_FINITE, kSlots[i].isGuide ? FindingSeverity::FAULT : FindingSeverity::WARNING,
                 kSlots[i].type, static_cast<double>(count.pixels),
                 text("%s holds NaN or infinity in %llu pixels, the first at (%d; %d): %s", toString(kSlots[i].type),
                      static_cast<unsigned long long>(count.pixels), count.x, count.y, advice)});
        }
    }

private:
    struct Count
    {
        uint64_t pixels = 0; // of all frames
        int x = 0, y = 0;    // the first
    };

    void lookAtPixel(const Frame& frame, int x, int y)
    {
        const bool isSurface = frame.isSurface(x, y);
        for (size_t i = 0; i < kSlotCount; i++)
        {
            // What a slot holds where nothing is denoised is nobody's business, but for the depth that says so.
            const float* texel = isSurface || i == 0 ? texelOf(frame, kSlots[i], x, y) : nullptr;
            bool isFinite = true;
            for (int c = 0; texel && c < kSlots[i].componentCount; c++) isFinite &= std::isfinite(texel[c]);
            if (isFinite) continue;
            if (m_counts[i].pixels++ == 0)
            {
                m_counts[i].x = x;
                m_counts[i].y = y;
            }
        }
    }

    Count m_counts[kSlotCount];
};

class NegativeRadianceCheck final : public Check
{
public:
    void look(const Frame& frame, const Frame*) override
    {
        for (size_t i = kFirstSignal; i < kSlotCount; i++)
        {
            Share& negative = m_negative[i - kFirstSignal];
            if (!(frame.input().*kSlots[i].image)) continue;
            forSamples(frame, [&](int x, int y) { negative.add(*texelOf(frame, kSlots[i], x, y) < -1e-3f); });
        }
    }

    void report(Reports& reports) const override
    {
        for (size_t i = kFirstSignal; i < kSlotCount; i++)
        {
            const double share = m_negative[i - kFirstSignal].value();
            if (share == 0.0) continue;
            reports.push_back({DoctorRule::NEGATIVE_RADIANCE, FindingSeverity::WARNING, kSlots[i].type, share,
                               text("%s has negative luma in %.2f %% of the pixels: radiance is at least 0 and packed "
                                    "by REBLUR_FrontEnd_PackRadianceAndNormHitDist",
                                    toString(kSlots[i].type), 100.0 * share)});
        }
    }

private:
    Share m_negative[kSlotCount - kFirstSignal];
};

// Sky that is denoised: depth 0, or one depth behind everything else where no path begins, or one so far away that it
// can only be a cleared value.
class SkyCheck final : public Check
{
public:
    void look(const Frame& frame, const Frame*) override
    {
        double farthest = 0.0;
        for (int y = 0; y < frame.height(); y++)
            for (int x = 0; x < frame.width(); x++)
            {
                m_zero.add(frame.viewZ(x, y) == 0.0);
                if (frame.isSurface(x, y)) farthest = std::max(farthest, frame.viewZ(x, y));
            }
        const Plateau plateau = plateauOf(frame, farthest);
        const bool isSky =
            plateau.pixels.value() > kLeastShare && (plateau.isWithoutPaths || farthest > kFar * plateau.background);
        m_sky.add(isSky);
        if (!isSky) return;
        m_skyShare.add(plateau.pixels.value());
        m_depth = farthest;
        m_range = double(frame.common().denoisingRange);
    }

    void report(Reports& reports) const override
    {
        if (m_zero.value() > kLeastShare)
            add(reports, m_zero.value(),
                text("IN_VIEWZ is 0 in %.1f %% of the pixels, which lies in front of everything: give pixels without a "
                     "surface a finite value beyond denoisingRange",
                     100.0 * m_zero.value()));
        if (m_sky.count == 0) return;
        add(reports, m_skyShare.value(),
            text("sky is denoised: %.1f %% of the pixels hold viewZ = %g, which is within denoisingRange = %g; store a "
                 "finite value beyond it, or lower denoisingRange",
                 100.0 * m_skyShare.value(), m_depth, m_range));
    }

private:
    static constexpr double kLeastShare = 0.002;
    static constexpr double kFar = 20.0; // times the distance of nearly everything else

    struct Plateau
    {
        Share pixels;               // that hold exactly this depth
        bool isWithoutPaths = true; // neither lobe has a sample there, and elsewhere there are some
        double background = 0.0;    // depth in front of which all but a few of the other surfaces lie
    };

    static bool hasPath(const Frame& frame, int x, int y)
    {
        for (size_t i = kFirstSignal; i < kSlotCount; i++)
        {
            const float* texel = texelOf(frame, kSlots[i], x, y);
            if (texel && (texel[0] != 0.0f || texel[3] != 0.0f)) return true;
        }
        return false;
    }

    static Plateau plateauOf(const Frame& frame, double depth)
    {
        Plateau result;
        Share paths, otherPaths;
        std::vector<double> others;
        forSamples(frame,
                   [&](int x, int y)
                   {
                       const bool isInside = frame.viewZ(x, y) == depth;
                       result.pixels.add(isInside);
                       (isInside ? paths : otherPaths).add(hasPath(frame, x, y));
                       if (!isInside) others.push_back(frame.viewZ(x, y));
                   });
        result.isWithoutPaths = paths.value() < 0.01 && otherPaths.value() > 0.5;
        result.background = others.empty() ? depth : quantile(others, 0.99);
        return result;
    }

    static void add(Reports& reports, double evidence, std::string sentence)
    {
        reports.push_back(
            {DoctorRule::SKY_IN_RANGE, FindingSeverity::FAULT, ResourceType::IN_VIEWZ, evidence, std::move(sentence)});
    }

    Share m_zero;
    Share m_sky; // frames
    Series m_skyShare;
    double m_depth = 0.0;
    double m_range = 0.0;
};
} // namespace

void addValueChecks(Checks& checks)
{
    checks.push_back(std::make_unique<FiniteCheck>());
    checks.push_back(std::make_unique<NegativeRadianceCheck>());
    checks.push_back(std::make_unique<SkyCheck>());
}
} // namespace nrd::doctor
