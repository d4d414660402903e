// nrd/docs/inputs.md is what the library answers: written by `NRD_WRITE_PAGES=1 nrd-test-nrd "[pages]"`.
#include "fixture.h"
#include <cstdlib>
#include <fstream>
#include <sstream>

using namespace test;

namespace
{
const char* usageOf(const ResourceRequirement& r)
{
    if (r.descriptorType == DescriptorType::TEXTURE) return "sampled";
    return r.isReadBack ? "storage, sampled" : "storage";
}

std::string rowsOf(Denoiser denoiser)
{
    const InstancePtr instance = makeInstance({denoiser});
    const ResourceRequirement* list = nullptr;
    uint32_t num = 0;
    REQUIRE(GetRequiredResources(*instance, 0, list, num) == Result::SUCCESS);
    std::ostringstream text;
    text << "\n## " << toString(denoiser) << "\n\n| slot | | least format | usage |\n| --- | --- | --- | --- |\n";
    for (uint32_t i = 0; i < num; i++)
        text << "| `" << toString(list[i].type) << "` | " << (list[i].isRequired ? "required" : "optional") << " | "
             << toString(list[i].minFormat) << " | " << usageOf(list[i]) << " |\n";
    return text.str();
}

std::string makePage()
{
    std::string page = R"(# Inputs and outputs of each denoiser

Generated from `nrd::GetRequiredResources()` with default settings by `tests/nrd/test_pages.cpp`, which fails where this
page says otherwise. What each slot holds: [the table of slots](../README.md#inputs-and-outputs). Optional slots are
read when the common settings say that they are there, or with a setting that is off by default. `IN_NORMAL_ROUGHNESS`
has the format of the instance's normal encoding.
)";
    const LibraryDesc& library = GetLibraryDesc();
    for (uint32_t i = 0; i < library.supportedDenoisersNum; i++) page += rowsOf(library.supportedDenoisers[i]);
    return page;
}
} // namespace

TEST_CASE("the page of inputs says what the library asks for", "[unit][pages]")
{
    const std::string page = makePage();
    if (std::getenv("NRD_WRITE_PAGES")) std::ofstream(NRD_INPUTS_PAGE) << page;
    std::ostringstream written;
    written << std::ifstream(NRD_INPUTS_PAGE).rdbuf();
    CHECK(written.str() == page);
}
