#include "report_front.h"

namespace sample::report
{
namespace
{
// What is better when smaller.
using Cost = std::optional<double> (*)(const Row&);

std::optional<double> flipOf(const Row& row) { return row.errors.flip; }

std::optional<double> noiseOf(const Row& row)
{
    return row.errors.psnr ? std::optional<double>(-*row.errors.psnr) : std::nullopt;
}

bool isPlaced(const Row& row, Cost cost) { return row.kind != RowKind::Peer && row.msPerMegapixel && cost(row); }

bool isBeaten(const Row& row, const Row& other, Cost cost)
{
    const double time = *row.msPerMegapixel, otherTime = *other.msPerMegapixel;
    const double error = *cost(row), otherError = *cost(other);
    return otherTime <= time && otherError <= error && (otherTime < time || otherError < error);
}

bool isOnFront(const Row& row, const std::vector<Row>& rows, Cost cost)
{
    if (!isPlaced(row, cost)) return false;
    for (const Row& other : rows)
        if (isPlaced(other, cost) && other.capture == row.capture && other.group == row.group &&
            isBeaten(row, other, cost))
            return false;
    return true;
}
} // namespace

void markFronts(std::vector<Row>& rows)
{
    for (Row& row : rows)
    {
        row.isOnFlipFront = isOnFront(row, rows, flipOf);
        row.isOnPsnrFront = isOnFront(row, rows, noiseOf);
    }
}
} // namespace sample::report
