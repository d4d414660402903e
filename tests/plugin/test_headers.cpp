// The C header, the C# file and the library's own enumeration say the same.
#include "../common/catch.h"
#include <fstream>
#include <map>
#include <nrd/nrd.h>
#include <regex>
#include <sstream>
#include <vector>

namespace
{
std::string textOf(const char* path)
{
    std::ifstream file(path);
    REQUIRE(file);
    std::ostringstream text;
    text << file.rdbuf();
    return std::regex_replace(text.str(), std::regex("/\\*[^*]*\\*+([^/*][^*]*\\*+)*/|//[^\n]*"), ""); // comments
}

// First capture of every match.
std::vector<std::string> matches(const std::string& text, const std::string& pattern)
{
    const std::regex regex(pattern);
    std::vector<std::string> result;
    for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) result.push_back((*i)[1]);
    return result;
}

// "NAME = 3" of an enumeration's body, without the prefix C needs.
std::vector<std::string> enumerators(const std::string& text, const std::string& name)
{
    const std::vector<std::string> bodies = matches(text, "enum " + name + "\\s*\\{([^}]*)\\}");
    REQUIRE(bodies.size() == 1);
    return matches(bodies[0], "(?:NRD_PLUGIN_)?([A-Z_]+ = [0-9]+)");
}

// "uint structSize" as C# spells it; arrays with their length.
std::vector<std::string> fields(const std::string& text, const std::string& name)
{
    const std::vector<std::string> bodies = matches(text, "struct " + name + "\\s*\\{([^}]*)\\}");
    REQUIRE(bodies.size() == 1);
    return matches(bodies[0], "(\\w+)(?:\\[[0-9]+\\])?;");
}
} // namespace

TEST_CASE("the C header, the C# file and the library have the same denoisers and results", "[unit]")
{
    const std::string c = textOf(NRD_PLUGIN_HEADER);
    const std::string cs = textOf(NRD_PLUGIN_CSHARP);
    const std::vector<std::string> denoisers = enumerators(c, "NrdPluginDenoiser");
    CHECK(denoisers == enumerators(cs, "NrdPluginDenoiser"));
    CHECK(enumerators(c, "NrdPluginResult") == enumerators(cs, "NrdPluginResult"));
    REQUIRE(denoisers.size() == static_cast<size_t>(nrd::Denoiser::MAX_NUM));
    for (uint32_t i = 0; i < denoisers.size(); i++)
        CHECK(denoisers[i] == toString(static_cast<nrd::Denoiser>(i)) + (" = " + std::to_string(i)));
}

TEST_CASE("the C header and the C# file have the same structs and functions", "[unit]")
{
    const std::string c = textOf(NRD_PLUGIN_HEADER);
    const std::string cs = textOf(NRD_PLUGIN_CSHARP);
    for (const char* name :
         {"NrdPluginDevice", "NrdPluginImageInfo", "NrdPluginImage", "NrdPluginFrame", "NrdPluginSettingInfo"})
    {
        INFO(name);
        CHECK(fields(c, name).size() > 4);
        CHECK(fields(c, name) == fields(cs, name));
    }
    const std::vector<std::string> functions = matches(c, "\n *NRD_PLUGIN_API [^(]*?(\\w+)\\(");
    CHECK(functions.size() == 15);
    CHECK(functions == matches(cs, "extern \\w+ (\\w+)\\("));
}
