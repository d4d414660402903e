// nrd-sample and other programs, run as a user runs them.
#pragma once
#include <filesystem>
#include <string>

namespace test
{
struct Outcome
{
    int exitCode = -1; // -1: killed by a signal
    std::string output;
    std::string errors;
};

std::string readText(const std::filesystem::path& file);
Outcome runProgram(const std::string& program, const std::string& arguments);
inline Outcome run(const std::string& arguments) { return runProgram(NRD_SAMPLE, arguments); }
} // namespace test
