// The report as text: Markdown for people, CSV for spreadsheets, JSON for programs.
#pragma once
#include "report_row.h"

namespace sample::report
{
// A heading, the plot and a table for each capture and group, in the order of the rows.
std::string formatMarkdown(const std::vector<Row>& rows);

// A head and one line per row; absent figures are empty.
std::string formatCsv(const std::vector<Row>& rows);

// A list with one object per row; absent figures are left out.
std::string formatJson(const std::vector<Row>& rows);

// A name for files, of the capture and group.
std::string plotName(const Row& row);
} // namespace sample::report
