// Misuses of states: barriers, copies, clears, and textures in the wrong one.
#include "misuse.h"

using namespace rhi;
using namespace rhi::test;

TEST_CASE("misuse: barriers that do not begin where the texture is, or end where it cannot be", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const auto texture = device->createTexture(smallTexture("texture"));
            const auto sampledOnly = device->createTexture(smallTexture("sampled only", TextureUsage::Sampled));
            Recorder commands(device);
            const auto wrong = [&](const Parts& parts, const TextureBarrier& barrier)
            { misuse(device, parts, [&] { commands->barrier(barrier); }); };
            wrong(
                {"'texture' mip 0", "says {SampledRead, ShaderReadOnly, Compute}", "state is {None, Undefined, None}"},
                {texture.get(), states::kSampled, states::kStorageWrite, {}});
            commands->barrier(TextureBarrier{texture.get(), states::kUndefined, states::kStorageWrite, {}});
            commands->barrier(TextureBarrier{texture.get(), states::kStorageWrite, states::kSampled, {1, 1}});
            wrong({"'texture' mip 1"}, {texture.get(), states::kStorageWrite, states::kSampled, {}});
            wrong({"'texture'", "do not exist"}, {texture.get(), states::kStorageWrite, states::kSampled, {2, 2}});
            wrong({"'texture'", "layout Undefined"}, {texture.get(), states::kStorageWrite, states::kUndefined, {}});
            wrong({"'sampled only'", "storage"}, {sampledOnly.get(), states::kUndefined, states::kStorageWrite, {}});
            wrong({"'sampled only'", "transfer destination"},
                  {sampledOnly.get(), states::kUndefined, states::kTransferDst, {}});
            TextureState attachment;
            attachment.layout = Layout::Native;
            attachment.native = {1024, 256, 2};
            wrong({"'texture' mip 0", "says native layout 2"}, {texture.get(), attachment, states::kSampled, {0, 1}});
            const TextureBarrier batch[] = {{texture.get(), states::kStorageWrite, states::kSampled, {0, 1}},
                                            {texture.get(), states::kStorageWrite, states::kSampled, {0, 1}}};
            misuse(device, {"'texture'", "in the batch twice"}, [&] { commands->barriers(batch, {}); });
        });
}

TEST_CASE("misuse: a dispatch whose textures are in the wrong layout or access", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const auto a = device->createTexture(smallTexture("A"));
            const auto b = device->createTexture(smallTexture("B"));
            const auto aView = device->createView(*a, {ViewType::Sampled, {}});
            const auto bView = device->createView(*b, {ViewType::Storage, {0, 1}});
            Pass pass(*device, Shader::CopyUint, kTextureToTexture, {}, "copy");
            pass.write(0, {viewAt(0, *aView), viewAt(1, *bView)});
            Recorder commands(device);
            pass.bind(*commands);
            const auto dispatch = [&] { commands->dispatch(1, 1, 1); };
            misuse(device, {"'A' mip 0", "Undefined", "ShaderReadOnly is needed", "binding 0", "'copy'"}, dispatch);
            commands->barrier(TextureBarrier{a.get(), states::kUndefined, states::kSampled, {0, 2}});
            misuse(device, {"'A' mip 2", "Undefined"}, dispatch);
            commands->barrier(TextureBarrier{a.get(), states::kUndefined, states::kSampled, {2, 1}});
            misuse(device, {"'B' mip 0", "Undefined", "General is needed", "binding 1"}, dispatch);
            commands->barrier(TextureBarrier{b.get(), states::kUndefined, states::kSampledGeneral, {}});
            misuse(device, {"'B' mip 0", "StorageWrite at Compute is needed"}, dispatch);
            commands->barrier(TextureBarrier{b.get(), states::kSampledGeneral, states::kStorageWrite, {}});
            dispatch();
            misuse(device, {"'B' mip 0", "was written since its last barrier"}, dispatch);
        });
}

TEST_CASE("misuse: a placed texture that does not wait for the one it takes the place of", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const MemoryRequirements needs = device->textureMemoryRequirements(smallTexture("A"));
            const auto memory = device->createMemory({needs.size, needs.memoryTypeBits, "block", "t"});
            const auto a = device->createPlacedTexture(smallTexture("A"), *memory, 0);
            const auto b = device->createPlacedTexture(smallTexture("B"), *memory, 0);
            const auto aView = device->createView(*a, {ViewType::Storage, {0, 1}});
            Pass pass(*device, Shader::Write, kOneTexture);
            pass.write(0, {viewAt(0, *aView)});
            Recorder commands(device);
            commands->barrier(TextureBarrier{a.get(), states::kAliased, states::kStorageWrite, {}});
            pass.record(*commands, 1);
            misuse(device, {"'B'", "does not wait for texture 'A'"},
                   [&] {
                       commands->barrier(TextureBarrier{b.get(), states::kUndefined, states::kStorageWrite, {}});
                   });
            commands->barrier(TextureBarrier{b.get(), states::kAliased, states::kStorageWrite, {}});
            misuse(device, {"'A' mip 0", "Undefined"}, [&] { pass.record(*commands, 1); }); // its turn is over
        });
}

TEST_CASE("misuse: copies and clears without usage, range, alignment or layout", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const auto texture = device->createTexture(smallTexture("texture"));
            const auto plain = device->createTexture(smallTexture("plain", TextureUsage::Sampled));
            const auto buffer = makeBuffer(*device, 1024, BufferUsage::TransferSrc | BufferUsage::TransferDst,
                                           BufferMemory::Device, "buffer");
            const auto uniform = makeBuffer(*device, 1024, BufferUsage::Uniform, BufferMemory::Device, "uniform");
            Recorder commands(device);
            const auto upload = [&](const Parts& parts, const TextureCopy& copy)
            { misuse(device, parts, [&] { commands->copyBufferToTexture(copy); }); };
            const auto download = [&](const Parts& parts, const TextureCopy& copy)
            { misuse(device, parts, [&] { commands->copyTextureToBuffer(copy); }); };
            upload({"'texture' mip 0", "Undefined", "TransferDst"}, {texture.get(), 0, buffer.get(), 0});
            download({"'texture' mip 1", "Undefined", "TransferSrc"}, {texture.get(), 1, buffer.get(), 0});
            upload({"'plain'", "without transfer destination"}, {plain.get(), 0, buffer.get(), 0});
            download({"'plain'", "without transfer source"}, {plain.get(), 0, buffer.get(), 0});
            upload({"'texture'", "no mip 3"}, {texture.get(), 3, buffer.get(), 0});
            upload({"'buffer'", "do not exist"}, {texture.get(), 0, buffer.get(), 4});
            upload({"'buffer'", "not a multiple of 4"}, {texture.get(), 1, buffer.get(), 2});
            upload({"'uniform'", "without transfer source"}, {texture.get(), 0, uniform.get(), 0});
            download({"'uniform'", "without transfer destination"}, {texture.get(), 0, uniform.get(), 0});

            const auto clear = [&](const Parts& parts, const Texture& target, MipRange mips, bool isUint) {
                misuse(device, parts, [&] { commands->clearTexture(target, mips, {isUint, {}, {}}); });
            };
            clear({"'plain'", "without transfer destination"}, *plain, {}, true);
            clear({"'texture'", "do not exist"}, *texture, {1, 5}, true);
            clear({"'texture'", "R32_UINT", "clear colour"}, *texture, {}, false);
            clear({"'texture' mip 0", "Undefined"}, *texture, {}, true);
            misuse(device, {"both source and destination"}, [&] { commands->copyTexture(*texture, *texture); });
        });
}

TEST_CASE("misuse: buffer copies and fills beyond the buffer, overlapping or unaligned", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const auto a = makeBuffer(*device, 256, BufferUsage::TransferSrc | BufferUsage::TransferDst,
                                      BufferMemory::Device, "A");
            const auto uniform = makeBuffer(*device, 256, BufferUsage::Uniform, BufferMemory::Device, "uniform");
            Recorder commands(device);
            const auto copy = [&](const Parts& parts, const BufferCopy& c)
            { misuse(device, parts, [&] { commands->copyBuffer(c); }); };
            copy({"'A'", "do not exist"}, {a.get(), 200, a.get(), 0, 100});
            copy({"'A'", "overlap"}, {a.get(), 0, a.get(), 32, 64});
            copy({"'A'", "0 bytes"}, {a.get(), 0, a.get(), 128, 0});
            copy({"'uniform'", "without transfer source"}, {uniform.get(), 0, a.get(), 0, 16});
            copy({"'uniform'", "without transfer destination"}, {a.get(), 0, uniform.get(), 0, 16});
            misuse(device, {"'A'", "multiples of 4"}, [&] { commands->fillBuffer(*a, 2, 4, 0); });
            misuse(device, {"'A'", "do not exist"}, [&] { commands->fillBuffer(*a, 0, 260, 0); });
            commands->fillBuffer(*a, 0, 64, 0);
            misuse(device, {"'A'", "was written since its last barrier"}, [&] { commands->fillBuffer(*a, 60, 8, 0); });
            misuse(device, {"the barrier of buffer 'A'", "TransferWrite"},
                   [&]
                   {
                       commands->barrier(BufferBarrier{
                           a.get(), {Access::StorageWrite, Stage::Compute}, {Access::StorageRead, Stage::Compute}});
                   });
        });
}
