// What is written of rows: Markdown, CSV, JSON, the scripts of the plots; and rows of replays and of the peer.
#include "catch.h"

#include "report_plot.h"
#include "report_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>

using namespace sample;
using namespace sample::report;

namespace
{
ReplayReport makeReport()
{
    ReplayReport report;
    report.capture = "a capture";
    report.denoiser = "RELAX_DIFFUSE";
    report.device = "A \"fast\" device";
    report.width = 500;
    report.height = 200;
    report.preset = nrd::Quality::FAST;
    report.settings = {{"atrousIterationNum", "3"}};
    report.gpuMs = 0.25;
    SignalMeasures& noisy = report.noisy[static_cast<size_t>(Signal::Composed)];
    SignalMeasures& denoised = report.denoised[static_cast<size_t>(Signal::Composed)];
    noisy.psnr = 20.0;
    noisy.flip = 0.3;
    denoised.psnr = 35.0;
    denoised.flip = 0.05;
    return report;
}

std::vector<Row> makeRows()
{
    const ReplayReport report = makeReport();
    PeerFigures peer;
    peer.denoised = report.denoised;
    peer.denoised[static_cast<size_t>(Signal::Composed)].psnr = 33.0;
    peer.gpuMs = 0.5;
    peer.device = "Other device";
    std::vector<Row> rows = {rowOf(report, "diffuse", "noisy input", RowKind::Noisy),
                             rowOf(report, "diffuse", "a|b, \"c\""), rowOf(peer, report, "diffuse")};
    rows[1].isOnFlipFront = true;
    return rows;
}
} // namespace

TEST_CASE("a row has the time per megapixel and the composed picture's errors", "[unit]")
{
    const std::vector<Row> rows = makeRows();
    CHECK(*rows[0].msPerMegapixel == 0.0);
    CHECK(*rows[0].errors.psnr == 20.0);
    CHECK(*rows[1].msPerMegapixel == Approx(2.5));
    CHECK(*rows[1].errors.flip == 0.05);
    CHECK(rows[1].settings == "FAST atrousIterationNum=3");
    CHECK(*rows[2].msPerMegapixel == Approx(5.0));
    CHECK(*rows[2].errors.psnr == 33.0);
    CHECK(rows[2].device == "Other device");
}

TEST_CASE("without a composed picture a row has the hit distance's errors", "[unit]")
{
    FrameMeasures measures;
    CHECK_FALSE(errorsOf(measures).psnr);
    measures[static_cast<size_t>(Signal::SpecularNormHitDist)].psnr = 25.0;
    CHECK(*errorsOf(measures).psnr == 25.0);
    measures[static_cast<size_t>(Signal::NormHitDist)].psnr = 30.0;
    CHECK(*errorsOf(measures).psnr == 30.0);
}

TEST_CASE("the Markdown has a heading, a plot and the rows, whose bars don't end cells", "[unit]")
{
    std::vector<Row> rows = makeRows();
    rows.push_back(rows[1]);
    rows.back().group = "diffuse-specular";
    const std::string text = formatMarkdown(rows);
    CHECK_THAT(text, containing("## a capture, diffuse\n"));
    CHECK_THAT(text, containing("![](a_capture-diffuse.svg)"));
    CHECK_THAT(text, containing("## a capture, diffuse-specular\n"));
    CHECK_THAT(text, containing("| RELAX_DIFFUSE | a\\|b, \"c\" | 0.2500 | 2.5000 | 35.00 | 0.0500 |  |  | FLIP |"));
    CHECK_THAT(text, containing("| RELAX_DIFFUSE | peer | 0.5000 | 5.0000 | 33.00 |"));
}

TEST_CASE("the CSV has a line per row with the columns of its head", "[unit]")
{
    const std::string text = formatCsv(makeRows());
    CHECK(std::count(text.begin(), text.end(), '\n') == 4);
    CHECK(text.rfind("kind,capture,group,denoiser,point,settings,device,gpuMs,msPerMegapixel,psnr,flip,relMSE,flicker,"
                     "flipFront,psnrFront\n",
                     0) == 0);
    CHECK_THAT(text, containing("ours,\"a capture\",\"diffuse\",\"RELAX_DIFFUSE\",\"a|b, \"\"c\"\"\","
                                "\"FAST atrousIterationNum=3\",\"A \"\"fast\"\" device\",0.250000,2.500000,35.000000,"
                                "0.050000,,,1,0\n"));
}

TEST_CASE("the JSON has an object per row without what was not measured", "[unit]")
{
    const nlohmann::json json = nlohmann::json::parse(formatJson(makeRows()));
    REQUIRE(json.size() == 3);
    CHECK(json[0]["kind"] == "noisy");
    CHECK_FALSE(json[0].contains("denoiser"));
    CHECK(json[1]["device"] == "A \"fast\" device");
    CHECK(json[1]["psnr"] == 35.0);
    CHECK(json[1]["flipFront"] == true);
    CHECK(json[1]["psnrFront"] == false);
    CHECK_FALSE(json[1].contains("relMSE"));
    CHECK(json[2]["kind"] == "peer");
}

TEST_CASE("a script draws both errors, every row, the front and the peer's device", "[unit]")
{
    const std::string script = plotScript(makeRows());
    CHECK_THAT(script, containing("set output \"a_capture-diffuse.svg\""));
    CHECK_THAT(script, containing("title \"a capture, diffuse, on A \\\"fast\\\" device\""));
    CHECK_THAT(script, containing("layout 2,1"));
    CHECK_THAT(script, containing("$flip_front << EOD\n2.5 0.05 \"a|b, \\\"c\\\"\"\nEOD\n"));
    CHECK_THAT(script, containing("$psnr_front << EOD\nEOD\n"));
    CHECK_THAT(script, containing("2.5 35 \"a|b"));
    CHECK_THAT(script, containing("0 20 \"\"\n")); // noisy
    CHECK_THAT(script, containing("5 33 \"\"\n")); // the peer
    CHECK_THAT(script, containing("peer's RELAX_DIFFUSE, on Other device"));
}

TEST_CASE("a script leaves out what was not measured, and there is none of nothing", "[unit]")
{
    std::vector<Row> rows = makeRows();
    for (Row& row : rows) row.errors.flip.reset();
    CHECK_THAT(plotScript(rows), containing("layout 1,1"));
    CHECK_THAT(plotScript(rows), !containing("FLIP"));
    for (Row& row : rows) row.msPerMegapixel.reset();
    CHECK(plotScript(rows).empty());
}
