// A check looks at frame after frame, keeps what it needs to know of them, and reports when asked.
#pragma once
#include "frame.h"
#include "statistics.h"
#include <memory>
#include <string>
#include <vector>

namespace nrd::doctor
{
struct Report
{
    DoctorRule rule = DoctorRule::MAX_NUM;
    FindingSeverity severity = FindingSeverity::FAULT;
    ResourceType slot = ResourceType::MAX_NUM;
    double evidence = 0.0;
    std::string text;
};
using Reports = std::vector<Report>;

class Check
{
public:
    Check() = default;
    Check(const Check&) = delete;
    Check& operator=(const Check&) = delete;
    virtual ~Check() = default;

    /// `before` is null for a first frame, after a restart, and where frames were left out.
    virtual void look(const Frame& frame, const Frame* before) = 0;
    virtual void report(Reports& reports) const = 0;
};

using Checks = std::vector<std::unique_ptr<Check>>;
void addSettingsChecks(Checks& checks);
void addValueChecks(Checks& checks);
void addNormalChecks(Checks& checks);
void addRoughnessChecks(Checks& checks);
void addMotionChecks(Checks& checks);
void addHitDistanceChecks(Checks& checks);
void addDemodulationChecks(Checks& checks);

/// printf-like.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

/// A number per frame, summed up as their median: one odd frame decides nothing.
class Series
{
public:
    void add(double value)
    {
        if (std::isfinite(value)) m_values.push_back(value);
    }
    double value() const { return median(m_values); } // NaN if there is none
    size_t size() const { return m_values.size(); }

private:
    std::vector<double> m_values;
};
} // namespace nrd::doctor
