#include "fixture.h"
#include <set>

using namespace test;

namespace
{
template <class Enum> void checkNames()
{
    std::set<std::string> names;
    for (uint32_t i = 0; i < static_cast<uint32_t>(Enum::MAX_NUM); i++)
    {
        const std::string name = toString(static_cast<Enum>(i));
        CHECK(name != "UNKNOWN");
        CHECK(names.insert(name).second);
    }
    CHECK(std::string(toString(Enum::MAX_NUM)) == "UNKNOWN");
    CHECK(std::string(toString(static_cast<Enum>(~0u))) == "UNKNOWN");
}
} // namespace

TEST_CASE("every enumerator has a name of its own", "[unit]")
{
    checkNames<Result>();
    checkNames<Denoiser>();
    checkNames<ResourceType>();
    checkNames<Format>();
    CHECK(std::string(toString(ResourceType::IN_DIFF_CONFIDENCE)) == "IN_DIFF_CONFIDENCE");
    CHECK(std::string(toString(ResourceType::OUT_SPEC_RADIANCE_HITDIST)) == "OUT_SPEC_RADIANCE_HITDIST");
    CHECK(std::string(toString(Denoiser::REFERENCE)) == "REFERENCE");
}

TEST_CASE("the order of the public enumerations is that of the interface", "[unit]")
{
    CHECK(static_cast<uint32_t>(Denoiser::REBLUR_DIFFUSE_SPECULAR) == 6);
    CHECK(static_cast<uint32_t>(Denoiser::RELAX_DIFFUSE) == 10);
    CHECK(static_cast<uint32_t>(Denoiser::REFERENCE) == 18);
    CHECK(static_cast<uint32_t>(ResourceType::IN_SPEC_MV) == 6);
    CHECK(static_cast<uint32_t>(ResourceType::IN_DIFF_RADIANCE_HITDIST) == 7);
    CHECK(static_cast<uint32_t>(ResourceType::OUT_DIFF_RADIANCE_HITDIST) == 19);
    CHECK(static_cast<uint32_t>(ResourceType::PERMANENT_POOL) == 35);
}

TEST_CASE("frame numbers come from time", "[unit]")
{
    CHECK(GetMaxAccumulatedFrameNum(0.5f, 60.0f) == 30);
    CHECK(GetMaxAccumulatedFrameNum(0.084f, 60.0f) == 5);
    CHECK(GetMaxAccumulatedFrameNum(0.025f, 60.0f) == 2);
    CHECK(GetMaxAccumulatedFrameNum(10.0f, 60.0f) == 63);
    CHECK(GetMaxAccumulatedFrameNum(-1.0f, 60.0f) == 0);
    CHECK(GetMaxAccumulatedFrameNum(NAN, 60.0f) == 0);
    CHECK(GetMaxAccumulatedFrameNum(0.5f, NAN) == 0);
    CHECK(GetMaxAccumulatedFrameNum(-1.0f, -60.0f) == 0);
    CHECK(GetMaxAccumulatedFrameNum(0.0f, INFINITY) == 0);
    CHECK(GetMaxAccumulatedFrameNum(0.0f, 0.0f) == 0);
    CHECK(GetMaxAccumulatedFrameNum(1e30f, 1e30f) == 63);
    CHECK(GetMaxAccumulatedFrameNum(INFINITY, 60.0f) == 63);
    CHECK(GetMaxAccumulatedFrameNum(1.0f, 63.0f) == 63);
    CHECK(GetMaxAccumulatedFrameNum(1.0f, 62.4f) == 62);
    CHECK(GetMaxAccumulatedFrameNum(1.0f, 0.49f) == 0);
    CHECK(GetMaxAccumulatedFrameNum(0.5f, 30.0f) == 15);
}
