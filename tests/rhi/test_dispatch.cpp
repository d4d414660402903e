#include "catch.h"
#include "fixture.h"
#include "gpu.h"
#include <array>
#include <bit>
#include <chrono>
#include <cstring>

using namespace rhi;
using namespace rhi::test;

namespace
{
constexpr BindingDesc kOneBuffer[] = {{0, 0, BindingType::StorageBuffer}};
constexpr BindingDesc kConstantsAndBuffer[] = {{0, 0, BindingType::UniformBufferDynamic},
                                               {0, 1, BindingType::StorageBuffer}};
constexpr BufferState kWritten = {Access::StorageWrite, Stage::Compute};
constexpr BufferState kReadByHost = {Access::HostRead, Stage::Host};

struct Counts
{
    uint32_t count, maxX, maxY, maxZ;
    bool operator==(const Counts&) const = default;
};

Counts countGroups(Device& device, const std::function<void(CommandBuffer&, const Pass&)>& record)
{
    const auto out = makeBuffer(device, sizeof(Counts), BufferUsage::Storage, BufferMemory::Readback, "counts");
    std::memset(out->mapped(), 0, sizeof(Counts));
    Pass pass(device, Shader::CountGroups, kOneBuffer);
    pass.write(0, {bufferAt(0, *out)});
    run(device,
        [&](CommandBuffer& commands)
        {
            record(commands, pass);
            commands.barrier(BufferBarrier{out.get(), kWritten, kReadByHost});
        });
    Counts counts = {};
    std::memcpy(&counts, out->mapped(), sizeof(counts));
    return counts;
}
} // namespace

TEST_CASE("a dispatch runs the workgroups it names, and none if one dimension is 0", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            const auto count = [&](uint32_t x, uint32_t y, uint32_t z)
            { return countGroups(*device, [&](CommandBuffer& c, const Pass& pass) { pass.record(c, x, y, z); }); };
            CHECK(count(3, 5, 7) == Counts{105, 2, 4, 6});
            CHECK(count(1, 1, 1) == Counts{1, 0, 0, 0});
            CHECK(count(0, 5, 7) == Counts{0, 0, 0, 0});
            CHECK(count(3, 0, 7) == Counts{0, 0, 0, 0});
            CHECK(count(3, 5, 0) == Counts{0, 0, 0, 0});
        });
}

TEST_CASE("a dispatch takes the device's maximum in a dimension", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            // y and z: the maximum of x may be 2^31 - 1, which takes minutes on slow devices.
            const uint32_t maxY = device->limits().maxGroupCount[1];
            const uint32_t maxZ = device->limits().maxGroupCount[2];
            const Counts ofY =
                countGroups(*device, [&](CommandBuffer& c, const Pass& pass) { pass.record(c, 1, maxY, 1); });
            CHECK(ofY == Counts{maxY, 0, maxY - 1, 0});
            const Counts ofZ =
                countGroups(*device, [&](CommandBuffer& c, const Pass& pass) { pass.record(c, 1, 1, maxZ); });
            CHECK(ofZ == Counts{maxZ, 0, 0, maxZ - 1});
        });
}

TEST_CASE("an indirect dispatch reads its workgroups from the buffer, also ones the GPU wrote", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            const auto arguments = makeBuffer(*device, 64, BufferUsage::Indirect | BufferUsage::TransferDst,
                                              BufferMemory::Device, "arguments");
            const Counts counts =
                countGroups(*device,
                            [&](CommandBuffer& commands, const Pass& pass)
                            {
                                commands.fillBuffer(*arguments, 0, 64, 1);
                                commands.barrier(BufferBarrier{arguments.get(),
                                                               {Access::TransferWrite, Stage::Transfer},
                                                               {Access::TransferWrite, Stage::Transfer}});
                                commands.fillBuffer(*arguments, 20, 4, 6); // y of the arguments at 16
                                commands.barrier(BufferBarrier{arguments.get(),
                                                               {Access::TransferWrite, Stage::Transfer},
                                                               {Access::IndirectRead, Stage::Indirect}});
                                pass.bind(commands);
                                commands.dispatchIndirect(*arguments, 16);
                            });
            CHECK(counts == Counts{6, 0, 5, 0});
        });
}

TEST_CASE("each dynamic offset shows the dispatch its own slot of the constants ring", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            constexpr uint32_t kSlots = 32;
            const uint32_t stride = std::max(device->limits().uniformOffsetAlignment, 16u);
            const auto ring =
                makeBuffer(*device, uint64_t{stride} * kSlots, BufferUsage::Uniform, BufferMemory::Upload, "ring");
            for (uint32_t i = 0; i < kSlots; i++)
            {
                const std::array<uint32_t, 4> slot = {i, i * i + 1, ~i, 0};
                std::memcpy(static_cast<std::byte*>(ring->mapped()) + size_t{i} * stride, slot.data(), sizeof(slot));
            }
            const auto out =
                makeBuffer(*device, kSlots * 32, BufferUsage::Storage, BufferMemory::Readback, "seen constants");
            Pass pass(*device, Shader::Constants, kConstantsAndBuffer);
            pass.write(0, {bufferAt(0, *ring, 0, 16), bufferAt(1, *out)});
            run(*device,
                [&](CommandBuffer& commands)
                {
                    for (uint32_t i = 0; i < kSlots; i++)
                    {
                        pass.bind(commands, {i * stride});
                        commands.dispatch(1, 1, 1);
                        commands.barrier(BufferBarrier{out.get(), kWritten, kWritten});
                    }
                    commands.barrier(BufferBarrier{out.get(), kWritten, kReadByHost});
                });
            const Span<uint32_t> words = mappedAs<uint32_t>(*out);
            for (uint32_t i = 0; i < kSlots; i++)
            {
                CHECK(words[i * 8 + 4] == i);
                CHECK(words[i * 8 + 5] == i * i + 1);
                CHECK(words[i * 8 + 6] == ~i);
            }
        });
}

TEST_CASE("specialisation constants replace the defaults of their identifiers and of no others", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            const auto ring = makeBuffer(*device, 256, BufferUsage::Uniform, BufferMemory::Upload, "constants");
            std::memset(ring->mapped(), 0, 256);
            const auto see = [&](Span<const SpecConstant> constants)
            {
                const auto out = makeBuffer(*device, 32, BufferUsage::Storage, BufferMemory::Readback, "seen");
                Pass pass(*device, Shader::Constants, kConstantsAndBuffer, constants);
                pass.write(0, {bufferAt(0, *ring, 0, 16), bufferAt(1, *out)});
                run(*device,
                    [&](CommandBuffer& commands)
                    {
                        pass.bind(commands, {0u});
                        commands.dispatch(1, 1, 1);
                        commands.barrier(BufferBarrier{out.get(), kWritten, kReadByHost});
                    });
                std::array<uint32_t, 4> seen = {};
                std::memcpy(seen.data(), out->mapped(), sizeof(seen));
                return seen;
            };
            const auto bits = [](float f) { return std::bit_cast<uint32_t>(f); };
            using Values = std::array<uint32_t, 4>;
            CHECK(see({}) == Values{0, 11, 12, bits(13.5f)});
            CHECK(see({{0, 1}, {1, ~0u}, {7, 99}, {9, bits(-2.25f)}}) == Values{1, ~0u, 99, bits(-2.25f)});
            CHECK(see({{9, bits(1.0f)}, {1234, 5}}) == Values{0, 11, 12, bits(1.0f)}); // 1234 is not in the module
        });
}

TEST_CASE("timestamps grow, and measure less than the host does around them", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            if (device->limits().timestampValidBits == 0) return skip(device->info().name + " has no timestamps");
            const auto queries = device->createQueryPool({3, "timestamps"});
            const auto data = makeBuffer(*device, 1 << 20, BufferUsage::Storage | BufferUsage::TransferDst,
                                         BufferMemory::Device, "work");
            Pass pass(*device, Shader::Step, kOneBuffer);
            pass.write(0, {bufferAt(0, *data)});
            const auto before = std::chrono::steady_clock::now();
            run(*device,
                [&](CommandBuffer& commands)
                {
                    commands.resetQueries(*queries, 0, 3);
                    commands.writeTimestamp(*queries, 0);
                    pass.record(commands, 4096);
                    commands.writeTimestamp(*queries, 1, Stage::Compute);
                    commands.barrier(BufferBarrier{data.get(), kWritten, kWritten});
                    pass.record(commands, 4096);
                    commands.writeTimestamp(*queries, 2);
                });
            const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - before;
            std::array<uint64_t, 3> ticks = {};
            REQUIRE(queries->read(0, ticks));
            CHECK(ticks[1] >= ticks[0]);
            CHECK(ticks[2] > ticks[0]);
            CHECK(ticks[2] >= ticks[1]);
            const double nanoseconds = queries->nanoseconds(ticks[0], ticks[2]);
            CHECK(nanoseconds > 0.0);
            CHECK(nanoseconds <= elapsed.count() * 1.01);
        });
}
