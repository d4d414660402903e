// nrd-report: speed against error of every denoiser and setting that matters, as a table and as plots.
#include "program.h"
#include "report_plot.h"
#include "report_run.h"
#include "report_table.h"

#include "engine/device.h"

#include <algorithm>
#include <fstream>

namespace
{
using namespace sample;
using namespace sample::report;

void write(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    if (!stream.flush()) throw FileError(file.string() + " cannot be written");
}

// All scripts before the first run, so that nothing but the plots is missing without gnuplot.
void plot(const std::filesystem::path& folder, const std::vector<Row>& rows)
{
    std::vector<std::filesystem::path> scripts;
    for (auto first = rows.begin(); first != rows.end();)
    {
        const std::string name = plotName(*first);
        const auto isOther = [&](const Row& row) { return plotName(row) != name; };
        const auto end = std::find_if(first, rows.end(), isOther);
        const std::string script = plotScript({first, end});
        first = end;
        if (script.empty()) continue;
        scripts.push_back(folder / (name + ".gnuplot"));
        write(scripts.back(), script);
    }
    for (const std::filesystem::path& script : scripts) runGnuplot(script);
}

int reportOn(Options options)
{
    const std::filesystem::path folder = options.out;
    options.peer = peerFile(options.peer, "nrd-4.17.4-sequences.json").string();
    options.peerTimes = peerFile(options.peerTimes, "nrd-4.17.4-h200.json").string();
    prepareFolder(folder);
    prepareFile(folder / "report.md");
    const std::vector<Row> rows = measure(options);
    const std::string markdown = formatMarkdown(rows);
    write(folder / "report.md", markdown);
    write(folder / "report.csv", formatCsv(rows));
    write(folder / "report.json", formatJson(rows));
    std::cout << markdown << std::flush;
    plot(folder, rows);
    return 0;
}

int run(int argumentCount, char** arguments)
{
    const std::optional<Options> options = parseOptions(argumentCount, arguments);
    if (!options) return 0;
    if (!options->isDeviceListWanted) return reportOn(*options);
    for (const std::string& line : engine::listDevices()) std::cout << line << '\n';
    return 0;
}
} // namespace

int main(int argumentCount, char** arguments)
{
    return runProgram("nrd-report", [&] { return run(argumentCount, arguments); });
}
