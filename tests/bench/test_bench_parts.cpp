// What of the benchmark needs no device: options, the order of frames, the bandwidth floor, reports.
#include "catch.h"
#include "relax_slots.h"

#include "bench_camera.h"
#include "bench_report.h"
#include "bench_slots.h"
#include "bench_statistics.h"
#include "bench_traffic.h"
#include "name_choice.h"

#include "capture.h"

#include <nrd/nrd.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <random>

using namespace sample;
using namespace sample::bench;

namespace
{
std::vector<std::string> namesOf(const std::vector<const ReplayDenoiser*>& denoisers)
{
    std::vector<std::string> names;
    for (const ReplayDenoiser* denoiser : denoisers) names.push_back(denoiser->name);
    return names;
}

struct File
{
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("nrd-test-bench-" + std::to_string(std::random_device()()) + ".json");
    ~File()
    {
        std::error_code error;
        std::filesystem::remove(path, error);
    }
    void write(const std::string& text) const { std::ofstream(path) << text; }
};

Report makeReport()
{
    Report report;
    report.device = "a device";
    report.bytesPerSecond = 1e12;
    Result result;
    result.denoiser = "REBLUR_DIFFUSE";
    result.size = {1024, 1024};
    result.memory = {30.0 * 1024 * 1024, 10.0 * 1024 * 1024};
    result.gpu = GpuResult{0.5, 0.4, 0.6, {{"Blur", 0.3, 100000000}, {"Post-blur", 0.2, 50000000}}};
    result.cpu = CpuResult{2.0, 20.0};
    report.results.push_back(result);
    return report;
}
} // namespace

TEST_CASE("sizes are pairs of sides and nothing else", "[unit]")
{
    const std::vector<Extent> sizes = parseSizes("1920x1080,64x36");
    REQUIRE(sizes.size() == 2);
    CHECK(sizes[0].width == 1920);
    CHECK(sizes[1].height == 36);
    for (const char* text : {"", "64", "64x", "x36", "64x36,", "64x0", "64x-1", "64x36x2", "65536x1", "64 x 36", "axb"})
    {
        INFO(text);
        CHECK_THROWS_AS(parseSizes(text), SettingError);
    }
}

TEST_CASE("a denoiser is selected by its whole name", "[unit]")
{
    CHECK(namesOf(selectDenoisers("REBLUR_DIFFUSE")) == std::vector<std::string>{"REBLUR_DIFFUSE"});
    CHECK(namesOf(selectDenoisers("REBLUR_DIFFUSE|REFERENCE")) ==
          std::vector<std::string>{"REBLUR_DIFFUSE", "REFERENCE"});
    CHECK(selectDenoisers(".*").size() == nrd::GetLibraryDesc().supportedDenoisersNum);
    CHECK_THROWS_AS(selectDenoisers("REBLUR"), SettingError);
    CHECK_THROWS_AS(selectDenoisers("("), SettingError);
    CHECK_THROWS_AS(selectDenoisers("NONE"), SettingError);
}

TEST_CASE("the benchmark generates every slot of every RELAX denoiser", "[unit]")
{
    size_t count = 0;
    for (const ReplayDenoiser& denoiser : replayDenoisers())
    {
        if (denoiser.family != Family::Relax) continue;
        for (nrd::ResourceType type : relaxLobeSlots(denoiser.name))
        {
            INFO(denoiser.name << " " << nrd::toString(type));
            const BenchSlot* slot = findBenchSlot(type, Family::Relax);
            REQUIRE(slot);
            count++;
            CHECK(slot->type == type);
            CHECK(slot->isOutput == isOutputSlot(type));
            CHECK(slot->isSpecular == (std::string(nrd::toString(type)).find("_SPEC_") != std::string::npos));
        }
    }
    CHECK(count == 24);
}

TEST_CASE("the camera goes there and back in steps of one input frame", "[unit]")
{
    constexpr uint32_t last = kInputFrameCount - 1;
    CHECK(inputFrameOf(0) == 0);
    CHECK(inputFrameOf(last) == last);
    CHECK(inputFrameOf(2 * last) == 0);
    for (uint32_t i = 1; i < 100; i++)
    {
        const uint32_t now = inputFrameOf(i), before = inputFrameOf(i - 1);
        CHECK((now > before ? now - before : before - now) == 1);
    }
    Workload workload;
    const nrd::CommonSettings a = bench::commonSettingsOf(workload, {64, 36}, 8);
    const nrd::CommonSettings b = bench::commonSettingsOf(workload, {64, 36}, 9);
    CHECK(std::equal(std::begin(a.worldToViewMatrix), std::end(a.worldToViewMatrix), b.worldToViewMatrixPrev));
    CHECK_FALSE(std::equal(std::begin(a.worldToViewMatrix), std::end(a.worldToViewMatrix), b.worldToViewMatrix));
    workload.isStatic = true;
    const nrd::CommonSettings c = bench::commonSettingsOf(workload, {64, 36}, 9);
    CHECK(std::equal(std::begin(c.worldToViewMatrix), std::end(c.worldToViewMatrix), c.worldToViewMatrixPrev));
}

TEST_CASE("least traffic counts each texel of each image once per direction", "[unit]")
{
    using nrd::DescriptorType, nrd::ResourceState, nrd::ResourceType;
    const nrd::TextureDesc permanent[] = {{nrd::Format::RGBA16_SFLOAT, 1}, {nrd::Format::R16_SFLOAT, 1}};
    const nrd::TextureDesc transient[] = {{nrd::Format::R8_UNORM, 16}};
    nrd::InstanceDesc instance = {};
    instance.permanentPool = permanent;
    instance.transientPool = transient;
    const auto read = [](ResourceType type, uint16_t index) {
        return nrd::ResourceDesc{DescriptorType::TEXTURE, ResourceState::SAMPLED, type, index};
    };
    const auto write = [](ResourceType type, uint16_t index) {
        return nrd::ResourceDesc{DescriptorType::STORAGE_TEXTURE, ResourceState::STORAGE, type, index};
    };
    const nrd::ResourceDesc first[] = {read(ResourceType::IN_VIEWZ, 0), write(ResourceType::TRANSIENT_POOL, 0)};
    const nrd::ResourceDesc second[] = {read(ResourceType::TRANSIENT_POOL, 0), read(ResourceType::IN_VIEWZ, 0),
                                        read(ResourceType::IN_VIEWZ, 0), // stands in for an absent input
                                        read(ResourceType::PERMANENT_POOL, 1), write(ResourceType::PERMANENT_POOL, 0),
                                        write(ResourceType::PERMANENT_POOL, 1)};
    nrd::DispatchDesc dispatches[3] = {};
    dispatches[0] = {"X - Tiles", 0, 0, first, 2, nullptr, 0, false, 0, 0, 0, 0};
    dispatches[1] = {"X - Blur", 0, 0, second, 6, nullptr, 0, false, 0, 0, 0, 0};
    dispatches[2] = {"X - Blur", 0, 0, first, 2, nullptr, 0, false, 0, 0, 0, 0};
    SlotTexels slots = {};
    slots[static_cast<size_t>(ResourceType::IN_VIEWZ)] = {4};

    const std::vector<PassTraffic> passes = findTraffic(instance, dispatches, slots, {100, 60});
    constexpr uint64_t pixels = 6000, tiles = 7 * 4;
    REQUIRE(passes.size() == 2);
    CHECK(passes[0].name == "Tiles");
    CHECK(passes[0].byteCount == 4 * pixels + tiles);
    CHECK(passes[1].byteCount == (tiles + 4 * pixels + 2 * pixels + 8 * pixels + 2 * pixels) + (4 * pixels + tiles));
    CHECK(floorMs(2000000, 1e9) == Approx(2.0));
}

TEST_CASE("quantiles lie between the values", "[unit]")
{
    CHECK(quantile({3.0, 1.0, 2.0}, 0.5) == 2.0);
    CHECK(quantile({4.0, 1.0, 3.0, 2.0}, 0.5) == 2.5);
    CHECK(quantile({7.0}, 0.9) == 7.0);
    CHECK(quantile({0.0, 10.0}, 0.1) == Approx(1.0));
}

TEST_CASE("a report says times, floors, memory and the peer's figures", "[unit]")
{
    File file;
    file.write(R"([{"denoiser": "REBLUR_DIFFUSE", "resolution": [1024, 1024], "device": "its device",
                    "gpuMs": {"total": 1.0}, "memoryMiB": {"permanent": 50.0, "transient": 14.0, "total": 64.0}}])");
    const std::vector<PeerRow> peers = readPeer(file.path);
    const Report report = makeReport();
    const PeerRow* peer = findPeer(peers, report.results[0]);
    REQUIRE(peer);
    const std::string text = formatResult(report, report.results[0], peer);
    for (const char* part : {"Post-blur", "0.1000 ms", "3.00", "40.0 bytes per pixel", "64.0 bytes per pixel",
                             "its device", "0.50 of it", "emission 2.0 us, recording 20.0 us"})
        CHECK_THAT(text, containing(part));
    Result other = report.results[0];
    other.size = {1024, 512};
    CHECK(findPeer(peers, other) == nullptr);

    writeJson(file.path, report);
    const nlohmann::json json = nlohmann::json::parse(std::ifstream(file.path));
    REQUIRE(json.size() == 1);
    CHECK(json[0]["resolution"] == nlohmann::json({1024, 1024}));
    CHECK(json[0]["copyGBPerSecond"] == Approx(1000.0));
    CHECK(json[0]["gpuMs"]["floor"] == Approx(0.15));
    CHECK(json[0]["gpuMs"]["passes"][0]["floorMs"] == Approx(0.1));
    CHECK(json[0]["memoryMiB"]["total"] == Approx(40.0));
    CHECK(json[0]["bytesPerPixel"] == Approx(40.0));
    CHECK(json[0]["cpuUs"]["record"] == 20.0);
}

TEST_CASE("a file that is not a list of figures is refused by its name", "[unit]")
{
    File file;
    for (const char* text : {"", "{", "[1]", "[{}]", R"([{"denoiser": 3}])"})
    {
        INFO(text);
        file.write(text);
        CHECK_THROWS_AS(readPeer(file.path), FileError);
    }
    CHECK_THROWS_AS(readPeer("/none.json"), FileError);
}
