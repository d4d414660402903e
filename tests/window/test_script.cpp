// What a script may say, and what is said about a wrong one.
#include "catch.h"
#include "window/script.h"

#include <sstream>

using namespace sample;

namespace
{
std::vector<ScriptCommand> parse(const std::string& text)
{
    std::istringstream stream(text);
    return parseScript(stream, "s.txt");
}

const char* exampleOf(ArgumentKind kind)
{
    switch (kind)
    {
    case ArgumentKind::None:
        return "";
    case ArgumentKind::Text:
        return "some text";
    case ArgumentKind::Switch:
        return "on";
    case ArgumentKind::Count:
        return "12";
    case ArgumentKind::Number:
        return "-1.5";
    case ArgumentKind::Numbers:
        return "3,-4.5";
    case ArgumentKind::Size:
        return "320x200";
    }
    return "";
}
} // namespace

TEST_CASE("every command is understood with its argument, and refused with a line break in its place", "[unit]")
{
    for (const VerbRow& row : verbs())
    {
        INFO(row.name);
        const std::vector<ScriptCommand> commands =
            parse(std::string("\n  ") + row.name + " " + exampleOf(row.kind) + " # why");
        REQUIRE(commands.size() == 1);
        CHECK(commands[0].verb == row.verb);
        CHECK(commands[0].line == 2);
        CHECK(commands[0].text == exampleOf(row.kind));
        if (row.kind == ArgumentKind::None)
            CHECK_THROWS_WITH(parse(std::string(row.name) + " 1"),
                              containing("s.txt:1: ") && containing("takes nothing"));
        else
            CHECK_THROWS_WITH(parse(row.name), containing("s.txt:1: ") && containing(" takes "));
    }
}

TEST_CASE("numbers are read whole", "[unit]")
{
    const std::vector<ScriptCommand> commands = parse("resize 640x360\nturn 10,-2.5\npause on\npause off\nsplit .25");
    REQUIRE(commands.size() == 5);
    CHECK(commands[0].numbers == std::array<double, 2>{640.0, 360.0});
    CHECK(commands[1].numbers == std::array<double, 2>{10.0, -2.5});
    CHECK(commands[2].numbers[0] == 1.0);
    CHECK(commands[3].numbers[0] == 0.0);
    CHECK(commands[4].numbers[0] == 0.25);
    for (const char* wrong :
         {"resize 640", "resize 640x360x2", "resize 8x9", "resize 1e9x1e9", "frames 0", "frames 1.5", "frames -3",
          "turn 1", "turn 1,2,3", "split x", "exposure nan", "pause maybe", "fly"})
    {
        INFO(wrong);
        CHECK_THROWS_AS(parse(wrong), ScriptError);
    }
}

TEST_CASE("a script that is not there is named", "[unit]")
{
    CHECK_THROWS_WITH(readScript("/nowhere/x.txt"), containing("/nowhere/x.txt"));
}
