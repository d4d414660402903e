#include "report_table.h"

#include <nlohmann/json.hpp>

#include <cctype>
#include <cstdio>

namespace sample::report
{
namespace
{
using Json = nlohmann::ordered_json;

struct FigureColumn
{
    const char* title; // of the Markdown
    const char* name;  // of CSV and JSON
    std::optional<double> (*figure)(const Row&);
    int decimals;
};
constexpr FigureColumn kFigures[] = {
    {"GPU ms", "gpuMs", [](const Row& row) { return row.gpuMs; }, 4},
    {"ms per megapixel", "msPerMegapixel", [](const Row& row) { return row.msPerMegapixel; }, 4},
    {"PSNR dB", "psnr", [](const Row& row) { return row.errors.psnr; }, 2},
    {"FLIP", "flip", [](const Row& row) { return row.errors.flip; }, 4},
    {"relMSE", "relMSE", [](const Row& row) { return row.errors.relMse; }, 4},
    {"flicker", "flicker", [](const Row& row) { return row.errors.flicker; }, 4},
};

struct TextColumn
{
    const char* name;
    std::string Row::*text;
};
constexpr TextColumn kTexts[] = {
    {"capture", &Row::capture}, {"group", &Row::group},       {"denoiser", &Row::denoiser},
    {"point", &Row::point},     {"settings", &Row::settings}, {"device", &Row::device},
};

const char* kindName(RowKind kind)
{
    switch (kind)
    {
    case RowKind::Ours:
        return "ours";
    case RowKind::Noisy:
        return "noisy";
    case RowKind::Peer:
        return "peer";
    }
    return "";
}

std::string print(const std::optional<double>& figure, int decimals)
{
    if (!figure) return "";
    char text[64];
    std::snprintf(text, sizeof(text), "%.*f", decimals, *figure);
    return text;
}

std::string escaped(const std::string& text, char special, char escape)
{
    std::string result;
    for (char c : text)
    {
        if (c == special) result += escape;
        result += c;
    }
    return result;
}

std::string field(const std::string& text)
{
    std::string result(1, '"');
    return result.append(escaped(text, '"', '"')).append(1, '"');
}

std::string cell(const std::string& text)
{
    std::string result(1, ' ');
    return result.append(escaped(text, '|', '\\')).append(" |");
}

std::string frontsOf(const Row& row)
{
    if (row.isOnFlipFront && row.isOnPsnrFront) return "FLIP, PSNR";
    return row.isOnFlipFront ? "FLIP" : row.isOnPsnrFront ? "PSNR" : "";
}

std::string markdownHead(const Row& row)
{
    const std::string name = plotName(row);
    std::string text = "\n## " + row.capture + ", " + row.group + "\n\n![](" + name + ".svg)\n\n";
    std::string titles = "| denoiser | point |", rule = "| --- | --- |";
    for (const FigureColumn& column : kFigures)
    {
        titles += cell(column.title);
        rule += " --- |";
    }
    return text + titles + " on the front | device |\n" + rule + " --- | --- |\n";
}

std::string markdownLine(const Row& row)
{
    std::string text(1, '|');
    text += cell(row.denoiser) + cell(row.point);
    for (const FigureColumn& column : kFigures) text += cell(print(column.figure(row), column.decimals));
    return text + cell(frontsOf(row)) + cell(row.device) + "\n";
}

std::string csvLine(const Row& row)
{
    std::string text = kindName(row.kind);
    for (const TextColumn& column : kTexts) text.append(1, ',').append(field(row.*column.text));
    for (const FigureColumn& column : kFigures) text.append(1, ',').append(print(column.figure(row), 6));
    text += row.isOnFlipFront ? ",1" : ",0";
    text += row.isOnPsnrFront ? ",1" : ",0";
    return text + "\n";
}

Json toJson(const Row& row)
{
    Json json = {{"kind", kindName(row.kind)}};
    for (const TextColumn& column : kTexts)
        if (!(row.*column.text).empty()) json[column.name] = row.*column.text;
    for (const FigureColumn& column : kFigures)
        if (const std::optional<double> figure = column.figure(row)) json[column.name] = *figure;
    json["flipFront"] = row.isOnFlipFront;
    json["psnrFront"] = row.isOnPsnrFront;
    return json;
}
} // namespace

std::string plotName(const Row& row)
{
    std::string name = row.capture + "-" + row.group;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
    return name;
}

std::string formatMarkdown(const std::vector<Row>& rows)
{
    std::string text = "# Speed against error\n";
    std::string before;
    for (const Row& row : rows)
    {
        if (plotName(row) != before) text += markdownHead(row);
        before = plotName(row);
        text += markdownLine(row);
    }
    return text;
}

std::string formatCsv(const std::vector<Row>& rows)
{
    std::string text = "kind";
    for (const TextColumn& column : kTexts) text.append(1, ',').append(column.name);
    for (const FigureColumn& column : kFigures) text.append(1, ',').append(column.name);
    text += ",flipFront,psnrFront\n";
    for (const Row& row : rows) text += csvLine(row);
    return text;
}

std::string formatJson(const std::vector<Row>& rows)
{
    Json json = Json::array();
    for (const Row& row : rows) json.push_back(toJson(row));
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}
} // namespace sample::report
