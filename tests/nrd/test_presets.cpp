// The presets against the validation, and the passes they ask for.
#include "fixture.h"

#include <nrd/presets.h>

using namespace test;

namespace
{
const Quality kQualities[] = {Quality::FAST, Quality::BALANCED, Quality::BEST};

// Of a settled frame at the settings, on an instance of its own.
template <class Settings> size_t passCountOf(Denoiser denoiser, const Settings& settings)
{
    const InstancePtr instance = makeInstance({denoiser});
    REQUIRE(SetDenoiserSettings(*instance, 0, settings) == Result::SUCCESS);
    CommonSettings common = makeCommon();
    requestFrame(*instance, common);
    return requestFrame(*instance, common).size();
}
} // namespace

TEST_CASE("every preset is valid and FAST asks for the fewest passes", "[unit]")
{
    size_t reblur[3], relax[3];
    for (size_t i = 0; i < 3; i++)
    {
        reblur[i] = passCountOf(kReblurBoth, GetReblurSettings(kQualities[i]));
        relax[i] = passCountOf(Denoiser::RELAX_DIFFUSE_SPECULAR, GetRelaxSettings(kQualities[i]));
        CHECK(passCountOf(Denoiser::SIGMA_SHADOW, GetSigmaSettings(kQualities[i])) > 0);
    }
    CHECK(reblur[0] <= reblur[1]); // without stabilisation its last pass only copies
    CHECK(relax[0] < relax[1]);
    for (const auto& counts : {reblur, relax}) CHECK(counts[1] <= counts[2]);
}
