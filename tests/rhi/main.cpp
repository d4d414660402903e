#define CATCH_CONFIG_RUNNER // Catch2 2: this file holds its implementation; Catch2 3 ignores it
#include "catch.h"
#include "fixture.h"
#include <cstdio>

int main(int argc, char** argv)
{
    const int result = Catch::Session().run(argc, argv);
    for (const std::string& text : rhi::test::skipped()) std::printf("skipped: %s\n", text.c_str());
    return result;
}
