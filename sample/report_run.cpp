#include "report_run.h"
#include "name_choice.h"
#include "program.h"
#include "replay_run.h"
#include "report_front.h"
#include "report_times.h"

#include <algorithm>
#include <iostream>
#include <map>

namespace sample::report
{
namespace
{
std::vector<Point> chosenPoints(const Options& options, Family family)
{
    const std::regex names = parseNames("--points", options.pointNames);
    std::vector<Point> points = pointsOf(family);
    std::erase_if(points, [&](const Point& point) { return !std::regex_match(point.name, names); });
    for (const Point& point : options.points)
        if (hasSettings(family, point)) points.push_back(point);
    return points;
}

std::map<std::string, std::vector<const ReplayDenoiser*>> groupsOf(const Options& options, const Capture& capture)
{
    std::map<std::string, std::vector<const ReplayDenoiser*>> groups;
    for (const ReplayDenoiser* denoiser : options.denoisers)
        if (fits(capture, *denoiser)) groups[groupOf(*denoiser)].push_back(denoiser);
    return groups;
}

// One group of one capture.
class Group
{
public:
    // times: null for those of the captures.
    Group(const Options& options, std::shared_ptr<engine::Device> device, Times* times, const Capture& capture,
          std::string name)
        : m_options(options), m_device(std::move(device)), m_times(times), m_capture(capture), m_name(std::move(name))
    {
    }

    void add(const ReplayDenoiser& denoiser)
    {
        std::optional<ReplayReport> last;
        for (const Point& point : chosenPoints(m_options, denoiser.family))
        {
            last = replay(denoiser, point);
            if (m_rows.empty()) m_rows.push_back(rowOf(*last, m_name, "noisy input", RowKind::Noisy));
            m_rows.push_back(rowOf(*last, m_name, point.name));
            if (m_times) m_times->setTime(m_rows.back(), denoiser, point);
        }
        if (last) addPeer(*last);
    }

    std::vector<Row> take() { return std::move(m_rows); }

private:
    ReplayReport replay(const ReplayDenoiser& denoiser, const Point& point) const
    {
        std::cerr << m_capture.info().name << ", " << denoiser.name << ", " << point.name << '\n';
        ReplayGpuDesc desc{m_capture, denoiser, point.settings, m_options.device, m_options.validation};
        desc.preset = point.preset;
        desc.resolution = point.resolution;
        desc.openDevice = m_device;
        ReplayRun run({desc, "", m_options.frameCount});
        ReplayReport report = run.run(showProgress);
        run.checkValidation();
        if (report.frames.empty())
            throw FileError(m_capture.info().name + " has no reference in the frames that are replayed");
        return report;
    }

    void addPeer(const ReplayReport& report)
    {
        if (m_options.peer.empty()) return;
        const std::optional<PeerFigures> peer = readPeer(m_options.peer, report.capture, report.denoiser);
        if (!peer) return;
        m_rows.push_back(rowOf(*peer, report, m_name));
        if (m_times) m_times->setPeerTime(m_rows.back());
    }

    const Options& m_options;
    const std::shared_ptr<engine::Device> m_device;
    Times* const m_times;
    const Capture& m_capture;
    const std::string m_name;
    std::vector<Row> m_rows;
};
} // namespace

std::vector<Row> measure(const Options& options)
{
    std::vector<Row> rows;
    std::shared_ptr<engine::Device> device; // opened when there is something to measure
    std::optional<Times> times;
    for (const std::string& folder : options.captures)
    {
        const Capture capture = Capture::open(folder);
        const auto groups = groupsOf(options, capture);
        if (groups.empty()) throw SettingError(folder + " has the layers of none of the denoisers");
        if (!device) device = createReplayDevice(options.device, options.validation);
        if (!times && options.timeSize.width > 0) times.emplace(device, options.timeSize, options.peerTimes);
        for (const auto& [name, denoisers] : groups)
        {
            Group group(options, device, times ? &*times : nullptr, capture, name);
            for (const ReplayDenoiser* denoiser : denoisers) group.add(*denoiser);
            const std::vector<Row> measured = group.take();
            rows.insert(rows.end(), measured.begin(), measured.end());
        }
    }
    if (rows.empty()) throw SettingError("--points " + options.pointNames + ": nothing is left to measure");
    markFronts(rows);
    return rows;
}
} // namespace sample::report
