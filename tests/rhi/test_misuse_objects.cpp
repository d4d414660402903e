// Misuses of factories, views, descriptors and lifetimes.
#include "misuse.h"
#include <optional>

using namespace rhi;
using namespace rhi::test;

TEST_CASE("misuse: views that do not fit their texture", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const auto sampled = device->createTexture(smallTexture("only sampled", TextureUsage::Sampled));
            const auto stored = device->createTexture(smallTexture("only stored", TextureUsage::Storage));
            misusedFactory(device, {"'only sampled'", "without storage usage"},
                           [&] {
                               device->createView(*sampled, {ViewType::Storage, {0, 1}});
                           });
            misusedFactory(device, {"'only stored'", "without sampled usage"},
                           [&] {
                               device->createView(*stored, {ViewType::Sampled, {}});
                           });
            misusedFactory(device, {"'only stored'", "3 mips", "expected exactly 1"},
                           [&] {
                               device->createView(*stored, {ViewType::Storage, {}});
                           });
            misusedFactory(device, {"'only sampled'", "do not exist"},
                           [&] {
                               device->createView(*sampled, {ViewType::Sampled, {2, 2}});
                           });
            misusedFactory(device, {"'only sampled'", "do not exist"},
                           [&] {
                               device->createView(*sampled, {ViewType::Sampled, {3, kAllMips}});
                           });
        });
}

TEST_CASE("misuse: descriptions that cannot be carried out", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            misusedFactory(device, {"buffer 'b'", "size is 0"},
                           [&] {
                               device->createBuffer({0, BufferUsage::Uniform, BufferMemory::Device, "b", "t"});
                           });
            misusedFactory(device, {"buffer 'b'", "usage is None"},
                           [&] {
                               device->createBuffer({16, BufferUsage::None, BufferMemory::Device, "b", "t"});
                           });
            misusedFactory(device, {"memory 'm'", "size is 0"}, [&] { device->createMemory({0, ~0u, "m", "t"}); });
            misusedFactory(device, {"memory 'm'", "memoryTypeBits"}, [&] { device->createMemory({16, 0, "m", "t"}); });
            misusedFactory(device, {"descriptor pool 'p'", "sets is 0"},
                           [&] {
                               device->createDescriptorPool({0, 0, 0, 0, 0, 1, "p"});
                           });
            misusedFactory(device, {"query pool 'q'", "count is 0"}, [&] { device->createQueryPool({0, "q"}); });
            misusedFactory(device, {"texture 'w'", "null"}, [&] { device->wrapTexture(0, smallTexture("w")); });
            const auto pipeline = [&](Span<const BindingDesc> bindings, Span<const SpecConstant> constants) {
                device->createPipeline({spirvOf(Shader::Step), bindings, constants, "p"});
            };
            misusedFactory(device, {"pipeline 'p'", "set 0 binding 0 is listed twice"},
                           [&] {
                               pipeline({kOneBuffer[0], kOneBuffer[0]}, {});
                           });
            misusedFactory(device, {"pipeline 'p'", "set 4"},
                           [&] {
                               pipeline({kOneBuffer[0], {4, 0, BindingType::Sampler}}, {});
                           });
            misusedFactory(device, {"pipeline 'p'", "set 0 binding 0", "lack"}, [&] { pipeline({}, {}); });
            misusedFactory(device, {"pipeline 'p'", "constant 7 is listed twice"},
                           [&] {
                               pipeline(kOneBuffer, {{7, 1}, {7, 2}});
                           });
        });
}

TEST_CASE("misuse: textures placed beside or beyond their memory", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const TextureDesc desc = smallTexture("placed");
            const MemoryRequirements needs = device->textureMemoryRequirements(desc);
            auto memory = device->createMemory({needs.size + needs.alignment, needs.memoryTypeBits, "block", "t"});
            if (needs.alignment > 1)
                misusedFactory(device, {"'placed'", "'block'", "not a multiple"},
                               [&] { device->createPlacedTexture(desc, *memory, 1); });
            misusedFactory(device, {"'placed'", "'block'", "do not fit"},
                           [&] { device->createPlacedTexture(desc, *memory, needs.alignment * 4096); });
            const auto texture = device->createPlacedTexture(desc, *memory, 0);
            misuse(device, {"memory 'block'", "destroyed while texture 'placed'"}, [&] { memory.reset(); });
        });
}

TEST_CASE("misuse: descriptor sets written wrongly", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const auto texture = device->createTexture(smallTexture("texture"));
            const auto sampled = device->createView(*texture, {ViewType::Sampled, {}});
            const auto storage = device->createView(*texture, {ViewType::Storage, {0, 1}});
            const auto uniform = makeBuffer(*device, 4096, BufferUsage::Uniform, BufferMemory::Upload, "uniform");
            const auto stored = makeBuffer(*device, 4096, BufferUsage::Storage, BufferMemory::Device, "stored");
            Pass textures(*device, Shader::CopyUint, kTextureToTexture, {}, "copy");
            Pass buffers(*device, Shader::Constants, kConstantsAndBuffer, {}, "constants");
            const auto wrong = [&](Pass& pass, const Parts& parts, Span<const DescriptorWrite> writes)
            { misuse(device, parts, [&] { pass.write(0, writes); }); };

            wrong(textures, {"pipeline copy", "binding 1 is missing"}, {viewAt(0, *sampled)});
            wrong(textures, {"no binding 5"}, {viewAt(5, *sampled)});
            wrong(textures, {"binding 0 is written twice"}, {viewAt(0, *sampled), viewAt(0, *sampled)});
            wrong(textures, {"binding 0", "sampled view", "'texture'"}, {viewAt(0, *storage), viewAt(1, *storage)});
            wrong(textures, {"binding 1", "storage view", "'texture'"}, {viewAt(0, *sampled), viewAt(1, *sampled)});
            wrong(textures, {"binding 0 needs a view"}, {bufferAt(0, *stored)});
            wrong(textures, {"binding 0", "layout TransferDst"}, {viewAt(0, *sampled, Layout::TransferDst)});
            wrong(buffers, {"binding 0 needs a buffer"}, {viewAt(0, *sampled)});
            wrong(buffers, {"binding 0", "uniform usage", "'stored'"}, {bufferAt(0, *stored)});
            wrong(buffers, {"binding 1", "storage usage", "'uniform'"},
                  {bufferAt(0, *uniform, 0, 16), bufferAt(1, *uniform)});
            wrong(buffers, {"binding 0", "'uniform'", "4104"}, {bufferAt(0, *uniform, 0, 4104)});
            wrong(buffers, {"binding 0", "offset 1"}, {bufferAt(0, *uniform, 1, 16)});

            textures.write(0, {viewAt(0, *sampled), viewAt(1, *storage)});
            wrong(textures, {"written already"}, {viewAt(0, *sampled), viewAt(1, *storage)});

            const BindingDesc withSampler[] = {
                {0, 0, BindingType::SampledTexture}, {0, 1, BindingType::StorageTexture}, {0, 2, BindingType::Sampler}};
            Pass samplers(*device, Shader::CopyUint, withSampler);
            wrong(samplers, {"binding 2", "immutable sampler"}, {viewAt(2, *sampled)});
        });
}

TEST_CASE("misuse: sets of a pool that was reset, and sets a pipeline does not have", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const auto data = makeBuffer(*device, 256, BufferUsage::Storage, BufferMemory::Device, "data");
            Pass pass(*device, Shader::Step, kOneBuffer);
            misusedFactory(device, {"'test pool'", "no set 3"}, [&] { pass.pool().allocate(pass.pipeline(), 3); });
            Recorder commands(device);
            commands->bindPipeline(pass.pipeline());
            pass.write(0, {bufferAt(0, *data)});
            commands->bindSet(0, pass.set(0), {});
            pass.pool().reset();
            misuse(device, {"test pool", "given back"}, [&] { commands->dispatch(1, 1, 1); });
            misuse(device, {"descriptor set", "was destroyed"}, [&] { commands->bindSet(0, pass.set(0), {}); });
            misuse(device, {"descriptor set", "was destroyed"}, [&] { pass.write(0, {bufferAt(0, *data)}); });
        });
}

TEST_CASE("misuse: objects used after their end", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            auto texture = device->createTexture(smallTexture("gone"));
            auto view = device->createView(*texture, {ViewType::Storage, {0, 1}});
            auto buffer = makeBuffer(*device, 256, BufferUsage::Storage, BufferMemory::Device, "gone buffer");
            Pass pass(*device, Shader::Write, kOneTexture);
            Pass step(*device, Shader::Step, kOneBuffer);
            pass.write(0, {viewAt(0, *view)});
            step.write(0, {bufferAt(0, *buffer)});
            Recorder commands(device);
            Recorder later(device); // the API allows nothing more in a command buffer that lost an object
            commands->barrier(TextureBarrier{texture.get(), states::kUndefined, states::kStorageWrite, {}});
            pass.bind(*commands);
            step.bind(*later);
            const Texture* dangling = texture.get(); // only its address is looked at
            const Buffer* danglingBuffer = buffer.get();
            view.reset();
            misuse(device, {"view of texture 'gone'", "destroyed"}, [&] { commands->dispatch(1, 1, 1); });
            texture.reset();
            misuse(device, {"texture 'gone' was destroyed"},
                   [&] {
                       commands->barrier(TextureBarrier{dangling, states::kUndefined, states::kSampled, {}});
                   });
            buffer.reset();
            misuse(device, {"buffer 'gone buffer' was destroyed"}, [&] { later->dispatch(1, 1, 1); });
            misuse(device, {"buffer 'gone buffer' was destroyed"},
                   [&] { commands->fillBuffer(*danglingBuffer, 0, 4, 0); });
            misuse(device, {"texture is null"}, [&] { commands->barrier(TextureBarrier{}); });
        });
}

TEST_CASE("misuse: objects of another device", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            TestDevice other(decoratedFactories().front());
            const auto foreign = other->createTexture(smallTexture("foreign"));
            Recorder commands(device);
            misuse(device, {"made by another device"},
                   [&] {
                       commands->barrier(TextureBarrier{foreign.get(), states::kUndefined, states::kSampled, {}});
                   });
            misusedFactory(device, {"made by another device"},
                           [&] {
                               device->createView(*foreign, {ViewType::Sampled, {}});
                           });
        });
}

TEST_CASE("misuse: a texture destroyed before its views, and a device before its objects", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            auto texture = device->createTexture(smallTexture("viewed"));
            const auto view = device->createView(*texture, {ViewType::Sampled, {}});
            misuse(device, {"texture 'viewed'", "1 of its views"}, [&] { texture.reset(); });
        });
}

TEST_CASE("misuse: objects destroyed, rewritten or reset while a submission uses them", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            auto data = makeBuffer(*device, 1 << 16, BufferUsage::Storage, BufferMemory::Device, "busy");
            auto idle = makeBuffer(*device, 256, BufferUsage::Storage, BufferMemory::Device, "idle");
            Pass pass(*device, Shader::Step, kOneBuffer);
            pass.write(0, {bufferAt(0, *data)});
            const auto commands = device->createCommandBuffer("commands");
            const auto fence = device->createFence("fence");
            commands->begin();
            pass.record(*commands, 16);
            commands->end();
            CommandBuffer* const list[] = {commands.get()};
            device->submit(list, fence.get());
            misuse(device, {"command buffer 'commands'", "pending"}, [&] { device->submit(list, nullptr); });
            misuse(device, {"command buffer 'commands'", "pending"}, [&] { commands->begin(); });
            misuse(device, {"descriptor set", "pending"}, [&] { pass.write(0, {bufferAt(0, *idle)}); });
            misuse(device, {"'test pool'", "pending"}, [&] { pass.pool().reset(); });
            misuse(device, {"fence 'fence'", "pending"}, [&] { fence->reset(); });
            misuse(device, {"buffer 'busy'", "destroyed while a submission"}, [&] { data.reset(); });
            idle.reset(); // not used: no report
            REQUIRE(fence->wait());
            pass.pool().reset(); // done: no report
        });
}
