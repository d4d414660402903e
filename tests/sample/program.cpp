#include "program.h"
#include "gltf_builder.h"

#include <cstdlib>
#include <fstream>
#include <sys/wait.h>

namespace test
{
std::string readText(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

Outcome runProgram(const std::string& program, const std::string& arguments)
{
    const TemporaryFolder folder;
    const std::string command =
        program + " " + arguments + " >" + (folder / "out").string() + " 2>" + (folder / "err").string();
    const int status = std::system(command.c_str());
    Outcome outcome;
    outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.output = readText(folder / "out");
    outcome.errors = readText(folder / "err");
    return outcome;
}
} // namespace test
