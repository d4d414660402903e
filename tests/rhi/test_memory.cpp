#include "catch.h"
#include "fixture.h"
#include "gpu.h"
#include <algorithm>
#include <cstring>

using namespace rhi;
using namespace rhi::test;

namespace
{
constexpr BindingDesc kOneTexture[] = {{0, 0, BindingType::StorageTexture}};

TextureDesc placedDesc(const char* name, Format format = Format::R32_UINT)
{
    TextureDesc desc;
    desc.format = format;
    desc.width = desc.height = 64;
    desc.usage = TextureUsage::Storage | TextureUsage::Sampled | TextureUsage::TransferSrc;
    desc.name = name;
    return desc;
}

uint64_t bytesOf(Device& device, const char* tag)
{
    for (const MemoryReportLine& line : device.memoryReport())
        if (line.tag == tag) return line.byteSize;
    return 0;
}

bool isFilledWith(const Bytes& bytes, uint32_t value)
{
    std::vector<uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return std::all_of(words.begin(), words.end(), [&](uint32_t word) { return word == value; });
}
} // namespace

TEST_CASE("textures placed in the same bytes take turns", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            const MemoryRequirements ofA = device->textureMemoryRequirements(placedDesc("A"));
            const MemoryRequirements ofB = device->textureMemoryRequirements(placedDesc("B", Format::R16_UINT));
            REQUIRE(ofA.size >= 64 * 64 * 4);
            MemoryDesc memoryDesc;
            memoryDesc.size = std::max(ofA.size, ofB.size);
            memoryDesc.memoryTypeBits = ofA.memoryTypeBits & ofB.memoryTypeBits;
            memoryDesc.memoryTag = "turns";
            const auto memory = device->createMemory(memoryDesc);
            CHECK(bytesOf(*device, "turns") == memoryDesc.size);
            const auto a = device->createPlacedTexture(placedDesc("A"), *memory, 0);
            const auto b = device->createPlacedTexture(placedDesc("B", Format::R16_UINT), *memory, 0);
            CHECK(bytesOf(*device, "turns") == memoryDesc.size); // placed textures cost nothing more

            const auto aView = device->createView(*a, {ViewType::Storage, {}});
            const auto bView = device->createView(*b, {ViewType::Storage, {}});
            Pass writeA(*device, Shader::Write, kOneTexture, {{0, 1000}});
            Pass writeB(*device, Shader::Write, kOneTexture, {{0, 2}});
            writeA.write(0, {viewAt(0, *aView)});
            writeB.write(0, {viewAt(0, *bView)});
            const auto out =
                makeBuffer(*device, a->mipByteSize(0), BufferUsage::TransferDst, BufferMemory::Readback, "seen of A");
            run(*device,
                [&](CommandBuffer& commands)
                {
                    commands.barrier(TextureBarrier{a.get(), states::kAliased, states::kStorageWrite, {}});
                    writeA.record(commands, 8, 8);
                    commands.barrier(TextureBarrier{a.get(), states::kStorageWrite, states::kTransferSrc, {}});
                    commands.copyTextureToBuffer({a.get(), 0, out.get(), 0});
                    commands.barrier(TextureBarrier{b.get(), states::kAliased, states::kStorageWrite, {}});
                    writeB.record(commands, 8, 8);
                    commands.barrier(BufferBarrier{
                        out.get(), {Access::TransferWrite, Stage::Transfer}, {Access::HostRead, Stage::Host}});
                });
            const Span<uint32_t> words = mappedAs<uint32_t>(*out);
            CHECK(std::count(words.begin(), words.end(), 1000u) == 64 * 64);
            CHECK(isFilledWith(readBack(*device, *b, 0, states::kStorageWrite), 2u << 16 | 2u));
        });
}

TEST_CASE("a texture placed in wrapped memory takes turns with what its owner has placed there", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            const MemoryRequirements needs = device->textureMemoryRequirements(placedDesc("A"));
            MemoryDesc desc;
            desc.size = needs.size + needs.alignment;
            desc.memoryTypeBits = needs.memoryTypeBits;
            desc.memoryTag = "engine's";
            const auto owned = device->createMemory(desc);
            REQUIRE((owned->memoryTypeBits() & needs.memoryTypeBits) != 0);
            desc.memoryTypeBits = owned->memoryTypeBits();
            desc.memoryTag = "lent";
            const auto lent = device->wrapMemory(owned->nativeHandle(), desc);
            CHECK(lent->nativeHandle() == owned->nativeHandle());
            CHECK(lent->memoryTypeBits() == owned->memoryTypeBits());
            CHECK(bytesOf(*device, "lent") == 0);

            const auto mine = device->createPlacedTexture(placedDesc("owner's"), *owned, needs.alignment);
            const auto lenders = device->createPlacedTexture(placedDesc("borrower's"), *lent, needs.alignment);
            const auto mineView = device->createView(*mine, {ViewType::Storage, {}});
            const auto lendersView = device->createView(*lenders, {ViewType::Storage, {}});
            Pass writeMine(*device, Shader::Write, kOneTexture, {{0, 1000}});
            Pass writeLenders(*device, Shader::Write, kOneTexture, {{0, 77}});
            writeMine.write(0, {viewAt(0, *mineView)});
            writeLenders.write(0, {viewAt(0, *lendersView)});
            constexpr MemoryState kWritten = {Access::StorageWrite, Stage::Compute, false, {}};
            run(*device,
                [&](CommandBuffer& commands)
                {
                    commands.barrier(TextureBarrier{mine.get(), states::kUndefined, states::kStorageWrite, {}});
                    writeMine.record(commands, 8, 8);
                    commands.barrier(MemoryBarrier{kWritten, kWritten});
                    const TextureState taken = {Access::StorageWrite, Layout::Undefined, Stage::Compute, {}};
                    commands.barrier(TextureBarrier{lenders.get(), taken, states::kStorageWrite, {}});
                    writeLenders.record(commands, 8, 8);
                });
            CHECK(isFilledWith(readBack(*device, *lenders, 0, states::kStorageWrite), 77));
        });
}

TEST_CASE("memory is wrapped by its handle and one type, or refused", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            const auto refuse = [&](uint64_t handle, const MemoryDesc& desc, const char* part)
            {
                CHECK_THROWS_WITH(device->wrapMemory(handle, desc), containing("memory 'block': ") && containing(part));
                CHECK(device.takeMisuses().size() == (device.isDecorated() ? 1 : 0));
            };
            MemoryDesc desc = {1024, 1, "block", "lent"};
            refuse(0, desc, "the memory to wrap is null");
            desc.memoryTypeBits = 3;
            refuse(4711, desc, "memoryTypeBits is 0x3, must be the one bit of its type");
            desc.memoryTypeBits = 1;
            desc.size = 0;
            refuse(4711, desc, "size is 0");
        });
}

TEST_CASE("textures placed side by side in one memory do not disturb each other", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            const MemoryRequirements needs = device->textureMemoryRequirements(placedDesc("A"));
            const uint64_t stride = (needs.size + needs.alignment - 1) / needs.alignment * needs.alignment;
            MemoryDesc memoryDesc;
            memoryDesc.size = stride * 2;
            memoryDesc.memoryTypeBits = needs.memoryTypeBits;
            const auto memory = device->createMemory(memoryDesc);
            const auto a = device->createPlacedTexture(placedDesc("A"), *memory, 0);
            const auto b = device->createPlacedTexture(placedDesc("B"), *memory, stride);
            const auto aView = device->createView(*a, {ViewType::Storage, {}});
            const auto bView = device->createView(*b, {ViewType::Storage, {}});
            Pass writeA(*device, Shader::Write, kOneTexture, {{0, 123456}});
            Pass writeB(*device, Shader::Write, kOneTexture, {{0, 654321}});
            writeA.write(0, {viewAt(0, *aView)});
            writeB.write(0, {viewAt(0, *bView)});
            run(*device,
                [&](CommandBuffer& commands)
                {
                    const TextureBarrier barriers[] = {{a.get(), states::kUndefined, states::kStorageWrite, {}},
                                                       {b.get(), states::kUndefined, states::kStorageWrite, {}}};
                    commands.barriers(barriers, {});
                    writeA.record(commands, 8, 8);
                    writeB.record(commands, 8, 8);
                });
            CHECK(isFilledWith(readBack(*device, *a, 0, states::kStorageWrite), 123456));
            CHECK(isFilledWith(readBack(*device, *b, 0, states::kStorageWrite), 654321));
        });
}

TEST_CASE("the memory report follows what is created and destroyed", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            CHECK(device->memoryReport().empty());
            {
                TextureDesc desc = placedDesc("A");
                desc.memoryTag = "history";
                const auto a = device->createTexture(desc);
                const auto b = device->createTexture(desc);
                BufferDesc bufferDesc;
                bufferDesc.size = 1000;
                bufferDesc.usage = BufferUsage::Uniform;
                bufferDesc.memory = BufferMemory::Upload;
                bufferDesc.memoryTag = "constants";
                const auto buffer = device->createBuffer(bufferDesc);
                const std::vector<MemoryReportLine> report = device->memoryReport();
                REQUIRE(report.size() == 2);
                CHECK(report[0].tag == "constants");
                CHECK(report[0].byteSize >= 1000);
                CHECK(report[1].tag == "history");
                CHECK(report[1].allocationCount == 2);
                CHECK(report[1].byteSize >= 2 * 64 * 64 * 4);
            }
            CHECK(device->memoryReport().empty());
        });
}

TEST_CASE("a texture no device can make is refused with its name and its field", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            const auto refuse = [&](const TextureDesc& desc, const char* part)
            {
                CHECK_THROWS_WITH(device->createTexture(desc), containing("'wrong'") && containing(part));
                CHECK_THROWS_WITH(device->textureMemoryRequirements(desc), containing(part));
                CHECK(device.takeMisuses().size() == (device.isDecorated() ? 2 : 0));
            };
            TextureDesc desc = placedDesc("wrong");
            desc.format = Format::Unknown;
            refuse(desc, "format is Unknown");
            desc = placedDesc("wrong");
            desc.width = 0;
            refuse(desc, "size is 0 x 64");
            desc.width = device->limits().maxTextureSize + 1;
            refuse(desc, "expected [1;");
            desc = placedDesc("wrong");
            desc.mipCount = 8;
            refuse(desc, "mipCount is 8, expected [1; 7]");
            desc.mipCount = 1;
            desc.usage = TextureUsage::None;
            refuse(desc, "usage is None");
            desc = placedDesc("wrong", Format::RGBA8_SRGB);
            if (!hasAny(device->formatSupport(desc.format), FormatSupport::Storage))
                refuse(desc, "no storage access to format RGBA8_SRGB");
        });
}
