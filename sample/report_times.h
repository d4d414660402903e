// GPU times of the report's points at a size at which they mean something: a small capture leaves a large GPU idle.
#pragma once
#include "bench_options.h"
#include "bench_report.h"
#include "report_points.h"
#include "report_row.h"

#include "engine/device.h"

#include <map>
#include <memory>

namespace sample::report
{
// Measures each point of each denoiser once, on generated input.
class Times
{
public:
    // peer: file with recorded times; empty: none.
    Times(std::shared_ptr<engine::Device> device, bench::Extent size, const std::filesystem::path& peer);

    // In place of the times of a capture. Throws engine::Error and SettingError.
    void setTime(Row& row, const ReplayDenoiser& denoiser, const Point& point);
    // No time where the peer has none of this size.
    void setPeerTime(Row& row) const;

private:
    double measure(const ReplayDenoiser& denoiser, const Point& point) const;
    void setTime(Row& row, double ms) const;

    const std::shared_ptr<engine::Device> m_device;
    const bench::Extent m_size;
    std::vector<bench::PeerRow> m_peers;
    std::map<std::string, double> m_times; // by denoiser and point
};
} // namespace sample::report
