// What the measuring programs share round their work: version, progress, errors as one sentence, recorded figures.
#pragma once
#include <cstddef>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>

namespace CLI
{
class App;
}

namespace sample
{
// "nrd-replay 0.1.0".
std::string versionText(const char* program);

// On stderr: one line that changes on a terminal, else now and then a line.
void showProgress(size_t done, size_t total);

// `given`, else `name` among the recorded figures of the test data when it is there; empty: none.
std::filesystem::path peerFile(const std::string& given, const char* name);

// Creates the folder if need be. Throws FileError.
void prepareFolder(const std::filesystem::path& folder);

// What would only fail after all the work fails before it; an empty path is none. Throws FileError.
void prepareFile(const std::filesystem::path& file);

// False: the help or the version was asked for and is printed. Throws SettingError.
bool parseArguments(CLI::App& app, int argumentCount, const char* const* arguments);

// The exit code of `run`, or 1 and the exception's sentence.
template <class Run> int runProgram(const char* program, Run&& run)
{
    try
    {
        return run();
    }
    catch (const std::bad_alloc&)
    {
        std::cerr << program << ": out of memory\n";
    }
    catch (const std::exception& e)
    {
        std::cerr << program << ": " << e.what() << '\n';
    }
    return 1;
}
} // namespace sample
