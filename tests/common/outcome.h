// A program as a user runs it: what it printed and returned.
#pragma once
#include "catch.h"

#include <cstdio>
#include <string>
#include <sys/wait.h>

namespace test
{
struct Outcome
{
    int exitCode = -1;
    std::string text; // stdout, and stderr as far as the command redirects it there
};

inline Outcome runCommand(const std::string& command)
{
    Outcome outcome;
    std::FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe);
    char buffer[512];
    while (const size_t count = std::fread(buffer, 1, sizeof(buffer), pipe)) outcome.text.append(buffer, count);
    const int status = pclose(pipe);
    if (WIFEXITED(status)) outcome.exitCode = WEXITSTATUS(status);
    return outcome;
}
} // namespace test
