#include "report_plot.h"
#include "capture.h"
#include "report_table.h"

#include <algorithm>
#include <cstdio>
#include <spawn.h>
#include <sys/wait.h>

extern char** environ;

namespace sample::report
{
namespace
{
struct Panel
{
    const char* name;
    const char* label; // of the upward axis
    std::optional<double> SignalMeasures::*error;
    bool Row::*isOnFront;
};
constexpr Panel kPanels[] = {
    {"flip", "FLIP (lower is better)", &SignalMeasures::flip, &Row::isOnFlipFront},
    {"psnr", "PSNR, dB (higher is better)", &SignalMeasures::psnr, &Row::isOnPsnrFront},
};

// gnuplot's filled marks are every second one of its types from 5 on.
constexpr size_t kFirstFilledMark = 5;
constexpr size_t kMarkCount = 5;

// What is drawn alike: a denoiser's points, the peer's of one device, the noisy input.
struct Series
{
    std::string title;
    std::vector<const Row*> rows;
};

std::string quoted(const std::string& text)
{
    std::string result(1, '"');
    for (char c : text)
    {
        if (c == '"' || c == '\\') result += '\\';
        result += c == '\n' ? ' ' : c;
    }
    return result + "\"";
}

std::string titleOf(const Row& row)
{
    if (row.kind == RowKind::Noisy) return "noisy input";
    if (row.kind == RowKind::Ours) return row.denoiser;
    std::string title = "peer's ";
    return title.append(row.denoiser).append(", on ").append(row.device);
}

bool isPlaced(const Row& row, const Panel& panel) { return row.msPerMegapixel && row.errors.*panel.error; }

std::vector<Series> seriesOf(std::span<const Row> rows, const Panel& panel)
{
    std::vector<Series> all;
    for (const Row& row : rows)
    {
        if (!isPlaced(row, panel)) continue;
        const std::string title = titleOf(row);
        auto found = std::find_if(all.begin(), all.end(), [&](const Series& s) { return s.title == title; });
        if (found == all.end()) found = all.insert(found, {title, {}});
        found->rows.push_back(&row);
    }
    return all;
}

std::string dataLine(const Row& row, const Panel& panel)
{
    char numbers[80];
    std::snprintf(numbers, sizeof(numbers), "%.6g %.6g ", *row.msPerMegapixel, *(row.errors.*panel.error));
    return numbers + quoted(row.kind == RowKind::Ours ? row.point : "") + "\n";
}

std::string dataBlock(const std::string& name, const std::vector<const Row*>& rows, const Panel& panel)
{
    std::string text(1, '$');
    text.append(name).append(" << EOD\n");
    for (const Row* row : rows) text += dataLine(*row, panel);
    return text + "EOD\n";
}

std::vector<const Row*> frontOf(std::span<const Row> rows, const Panel& panel)
{
    std::vector<const Row*> front;
    for (const Row& row : rows)
        if (row.*panel.isOnFront && isPlaced(row, panel)) front.push_back(&row);
    const auto isFaster = [](const Row* a, const Row* b) { return *a->msPerMegapixel < *b->msPerMegapixel; };
    std::sort(front.begin(), front.end(), isFaster);
    return front;
}

// Nothing is left to gain between two points of the front but by one of them: steps, not slopes.
std::string panelScript(std::span<const Row> rows, const Panel& panel)
{
    const std::vector<Series> all = seriesOf(rows, panel);
    if (all.empty()) return "";
    const std::string front = std::string(panel.name) + "_front";
    std::string data = dataBlock(front, frontOf(rows, panel), panel);
    std::string plot = "plot $" + front + " using 1:2 with steps lc rgb \"gray50\" lw 2 title \"Pareto front\"";
    for (size_t i = 0; i < all.size(); i++)
    {
        const std::string name = std::string(panel.name) + std::to_string(i);
        data += dataBlock(name, all[i].rows, panel);
        const std::string color = std::to_string(i + 1);
        const std::string type = std::to_string(kFirstFilledMark + 2 * (i % kMarkCount));
        plot += ", \\\n     $" + name + " using 1:2 with points pt " + type + " lc " + color + " title " +
                quoted(all[i].title);
        plot += ", \\\n     $" + name + " using 1:2:3 with labels left offset 0.7,0.3 font \",8\" notitle";
    }
    return data + "set ylabel " + quoted(panel.label) + "\n" + plot + "\n";
}

std::string deviceOf(std::span<const Row> rows)
{
    for (const Row& row : rows)
        if (row.kind == RowKind::Ours) return row.device;
    return "";
}
} // namespace

std::string plotScript(std::span<const Row> rows)
{
    std::vector<std::string> panels;
    for (const Panel& panel : kPanels)
        if (std::string text = panelScript(rows, panel); !text.empty()) panels.push_back(std::move(text));
    if (panels.empty()) return "";
    const Row& first = rows.front();
    const std::string count = std::to_string(panels.size());
    std::string script = "set terminal svg noenhanced size 900," + std::to_string(540 * panels.size()) +
                         " background rgb \"white\" font \"sans,12\"\n";
    script += "set output " + quoted(plotName(first) + ".svg") + "\n";
    script += "set multiplot layout " + count + ",1 title " +
              quoted(first.capture + ", " + first.group + ", on " + deviceOf(rows)) + "\n";
    script += "set xlabel \"GPU ms per megapixel\"\nset xrange [0:*]\nset grid\nset key outside below\n"
              "set offsets graph 0.0, graph 0.1, graph 0.05, graph 0.05\n";
    for (const std::string& panel : panels) script += panel;
    return script + "unset multiplot\n";
}

void runGnuplot(const std::filesystem::path& script)
{
    std::string program = "gnuplot", file = script.filename().string();
    char* arguments[] = {program.data(), file.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, script.parent_path().c_str());
    pid_t child = 0;
    const int error = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error) throw FileError("gnuplot, of the package gnuplot-nox, cannot be run: the report is there but for plots");
    int status = 0;
    if (waitpid(child, &status, 0) != child || status != 0)
        throw FileError("gnuplot failed on " + script.string() + ": the report is there but for plots");
}
} // namespace sample::report
