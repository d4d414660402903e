// The Pareto fronts of points made by hand.
#include "catch.h"

#include "report_front.h"

using namespace sample;
using namespace sample::report;

namespace
{
Row makeRow(double ms, double flip, double psnr)
{
    Row row;
    row.msPerMegapixel = ms;
    row.errors.flip = flip;
    row.errors.psnr = psnr;
    return row;
}
} // namespace

TEST_CASE("a row is on a front unless another is better in one and no worse in the other", "[unit]")
{
    std::vector<Row> rows = {
        makeRow(0.0, 0.5, 10.0),  // fastest
        makeRow(1.0, 0.2, 30.0),  // on both
        makeRow(2.0, 0.2, 31.0),  // no less FLIP for more time, more PSNR
        makeRow(2.5, 0.1, 30.5),  // the other way round
        makeRow(2.0, 0.2, 31.0),  // equal to the third
        makeRow(3.0, 0.3, 20.0),  // on none
        makeRow(1.0, 0.25, 30.0), // as fast as the second, but worse
    };
    markFronts(rows);
    const bool flip[] = {true, true, false, true, false, false, false};
    const bool psnr[] = {true, true, true, false, true, false, true};
    for (size_t i = 0; i < rows.size(); i++)
    {
        INFO(i);
        CHECK(rows[i].isOnFlipFront == flip[i]);
        CHECK(rows[i].isOnPsnrFront == psnr[i]);
    }
}

TEST_CASE("captures and groups have fronts of their own", "[unit]")
{
    std::vector<Row> rows = {makeRow(1.0, 0.1, 30.0), makeRow(2.0, 0.2, 20.0), makeRow(2.0, 0.2, 20.0)};
    rows[1].capture = "other";
    rows[2].group = "other";
    markFronts(rows);
    for (const Row& row : rows) CHECK((row.isOnFlipFront && row.isOnPsnrFront));
}

TEST_CASE("the peer, and what was not measured, is on no front and beats nothing", "[unit]")
{
    std::vector<Row> rows = {makeRow(1.0, 0.2, 30.0), makeRow(0.5, 0.1, 40.0), makeRow(0.5, 0.1, 40.0),
                             makeRow(2.0, 0.3, 31.0)};
    rows[1].kind = RowKind::Peer;
    rows[2].msPerMegapixel.reset();
    rows[3].errors.flip.reset();
    markFronts(rows);
    CHECK((rows[0].isOnFlipFront && rows[0].isOnPsnrFront));
    for (size_t i : {1u, 2u}) CHECK_FALSE((rows[i].isOnFlipFront || rows[i].isOnPsnrFront));
    CHECK_FALSE(rows[3].isOnFlipFront);
    CHECK(rows[3].isOnPsnrFront);
}
