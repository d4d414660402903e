#include "program.h"
#include "capture.h"
#include "replay_settings.h"

#include <CLI/CLI.hpp>
#include <nrd/nrd.h>

#include <cstdio>
#include <fstream>
#include <unistd.h>

namespace sample
{
std::string versionText(const char* program)
{
    const nrd::LibraryDesc& library = nrd::GetLibraryDesc();
    return std::string(program) + " " + std::to_string(library.versionMajor) + "." +
           std::to_string(library.versionMinor) + "." + std::to_string(library.versionBuild);
}

void showProgress(size_t done, size_t total)
{
    const bool isTerminal = isatty(STDERR_FILENO) != 0;
    if (isTerminal)
        std::fprintf(stderr, "\r%zu of %zu frames%s", done, total, done == total ? "\n" : "");
    else if (done % 16 == 0 || done == total)
        std::fprintf(stderr, "%zu of %zu frames\n", done, total);
}

std::filesystem::path peerFile(const std::string& given, const char* name)
{
    if (!given.empty()) return given;
    const std::filesystem::path file = std::filesystem::path(NRD_TEST_DATA) / "peer" / name;
    std::error_code error;
    return std::filesystem::is_regular_file(file, error) ? file : std::filesystem::path();
}

void prepareFolder(const std::filesystem::path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw FileError(folder.string() + " cannot be created: " + error.message());
}

void prepareFile(const std::filesystem::path& file)
{
    if (!file.empty() && !std::ofstream(file, std::ios::app)) throw FileError(file.string() + " cannot be written");
}

bool parseArguments(CLI::App& app, int argumentCount, const char* const* arguments)
{
    try
    {
        app.parse(argumentCount, arguments);
        return true;
    }
    catch (const CLI::ParseError& e)
    {
        if (e.get_exit_code() != 0) throw SettingError(e.what());
        app.exit(e); // prints what was asked for
        return false;
    }
}
} // namespace sample
