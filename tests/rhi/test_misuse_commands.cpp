// Misuses of command buffers, dispatches, queries, fences and submissions.
#include "misuse.h"

using namespace rhi;
using namespace rhi::test;

TEST_CASE("misuse: commands outside begin() and end(), and submissions of unfinished command buffers", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const auto commands = device->createCommandBuffer("commands");
            CommandBuffer* const list[] = {commands.get()};
            misuse(device, {"'commands'", "dispatch()", "between begin() and end()"},
                   [&] { commands->dispatch(1, 1, 1); });
            misuse(device, {"'commands'", "was not recorded"}, [&] { device->submit(list, nullptr); });
            misuse(device, {"'commands'", "end()"}, [&] { commands->end(); });
            commands->begin();
            misuse(device, {"'commands'", "recorded already"}, [&] { commands->begin(); });
            misuse(device, {"'commands'", "was not ended"}, [&] { device->submit(list, nullptr); });
            commands->beginLabel("open");
            misuse(device, {"'commands'", "labels are still open"}, [&] { commands->end(); });
            commands->endLabel();
            misuse(device, {"'commands'", "no label is open"}, [&] { commands->endLabel(); });
            commands->end();
            misuse(device, {"'commands'", "between begin() and end()"}, [&] { commands->beginLabel("late"); });
            CommandBuffer* const twice[] = {commands.get(), commands.get()};
            misuse(device, {"'commands'", "twice"}, [&] { device->submit(twice, nullptr); });
        });
}

TEST_CASE("misuse: a submission of what refers to a destroyed object", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            auto buffer = makeBuffer(*device, 256, BufferUsage::TransferDst, BufferMemory::Device, "gone");
            const auto commands = device->createCommandBuffer("commands");
            commands->begin();
            commands->fillBuffer(*buffer, 0, 256, 0);
            commands->end();
            buffer.reset();
            CommandBuffer* const list[] = {commands.get()};
            misuse(device, {"'commands'", "buffer 'gone', which was destroyed"},
                   [&] { device->submit(list, nullptr); });
        });
}

TEST_CASE("misuse: fences that would wait for ever or are submitted twice", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const auto fence = device->createFence("fence");
            misuse(device, {"fence 'fence'", "for ever"}, [&] { CHECK_FALSE(fence->wait()); });
            device->submit({}, fence.get());
            REQUIRE(fence->wait());
            misuse(device, {"fence 'fence'", "not reset"}, [&] { device->submit({}, fence.get()); });
            fence->reset();
            device->submit({}, fence.get());
            REQUIRE(fence->wait());
        });
}

TEST_CASE("misuse: dispatches without pipeline or sets, or beyond the device's limits", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const auto data = makeBuffer(*device, 256, BufferUsage::Storage, BufferMemory::Device, "data");
            const auto constants = makeBuffer(*device, 256, BufferUsage::Uniform, BufferMemory::Upload, "constants");
            Pass step(*device, Shader::Step, kOneBuffer, {}, "step");
            Pass unwritten(*device, Shader::Step, kOneBuffer, {}, "unwritten");
            Pass other(*device, Shader::Constants, kConstantsAndBuffer, {}, "other");
            step.write(0, {bufferAt(0, *data)});
            other.write(0, {bufferAt(0, *constants, 0, 16), bufferAt(1, *data)});
            Recorder commands(device);
            misuse(device, {"dispatch()", "no pipeline is bound"}, [&] { commands->dispatch(1, 1, 1); });
            misuse(device, {"bindSet()", "no pipeline is bound"}, [&] { commands->bindSet(0, step.set(0), {}); });
            commands->bindPipeline(step.pipeline());
            misuse(device, {"set 0 of pipeline 'step' is not bound"}, [&] { commands->dispatch(1, 1, 1); });
            misuse(device, {"pipeline other", "does not fit set 0 of pipeline 'step'"},
                   [&] { commands->bindSet(0, other.set(0), {0u}); });
            misuse(device, {"set 4 does not exist"}, [&] { commands->bindSet(4, step.set(0), {}); });
            misuse(device, {"pipeline unwritten", "was not written"},
                   [&] { commands->bindSet(0, unwritten.set(0), {}); });
            commands->bindSet(0, step.set(0), {});
            const uint32_t maxX = device->limits().maxGroupCount[0];
            const uint32_t maxY = device->limits().maxGroupCount[1];
            if (maxX < ~0u) misuse(device, {"the device allows"}, [&] { commands->dispatch(maxX + 1, 1, 1); });
            misuse(device, {"the device allows"}, [&] { commands->dispatch(1, maxY + 1, 1); });
            commands->bindPipeline(other.pipeline());
            misuse(device, {"does not fit set 0 of pipeline 'other'"}, [&] { commands->dispatch(1, 1, 1); });
        });
}

TEST_CASE("misuse: dynamic offsets of the wrong number, alignment or range", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const uint32_t alignment = device->limits().uniformOffsetAlignment;
            const auto data = makeBuffer(*device, 256, BufferUsage::Storage, BufferMemory::Device, "data");
            const auto ring =
                makeBuffer(*device, uint64_t{alignment} * 4, BufferUsage::Uniform, BufferMemory::Upload, "ring");
            Pass pass(*device, Shader::Constants, kConstantsAndBuffer);
            pass.write(0, {bufferAt(0, *ring, 0, 16), bufferAt(1, *data)});
            Recorder commands(device);
            commands->bindPipeline(pass.pipeline());
            misuse(device, {"takes 1 dynamic offsets, got 0"}, [&] { commands->bindSet(0, pass.set(0), {}); });
            misuse(device, {"takes 1 dynamic offsets, got 2"}, [&] { commands->bindSet(0, pass.set(0), {0u, 0u}); });
            if (alignment > 1)
                misuse(device, {"offset 1", "'ring'", "not a multiple"},
                       [&] { commands->bindSet(0, pass.set(0), {1u}); });
            misuse(device, {"beyond the end of buffer 'ring'"},
                   [&] { commands->bindSet(0, pass.set(0), {alignment * 4}); });
            commands->bindSet(0, pass.set(0), {alignment * 3});
        });
}

TEST_CASE("misuse: indirect arguments outside their buffer or in a buffer without the usage", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            const auto data = makeBuffer(*device, 256, BufferUsage::Storage, BufferMemory::Device, "data");
            const auto arguments = makeBuffer(*device, 32, BufferUsage::Indirect, BufferMemory::Upload, "arguments");
            Pass pass(*device, Shader::Step, kOneBuffer);
            pass.write(0, {bufferAt(0, *data)});
            Recorder commands(device);
            pass.bind(*commands);
            misuse(device, {"'data'", "without indirect usage"}, [&] { commands->dispatchIndirect(*data, 0); });
            misuse(device, {"'arguments'", "do not exist"}, [&] { commands->dispatchIndirect(*arguments, 24); });
            misuse(device, {"'arguments'", "not a multiple of 4"}, [&] { commands->dispatchIndirect(*arguments, 2); });
        });
}

TEST_CASE("misuse: timestamps out of range, not reset, or at a stage that has none", "[gpu]")
{
    forEachDecorated(
        [](TestDevice& device)
        {
            if (device->limits().timestampValidBits == 0) return skip(device->info().name + " has no timestamps");
            const auto queries = device->createQueryPool({4, "queries"});
            Recorder commands(device);
            misuse(device, {"'queries'", "do not exist"}, [&] { commands->resetQueries(*queries, 2, 3); });
            misuse(device, {"query 1", "'queries'", "not reset"}, [&] { commands->writeTimestamp(*queries, 1); });
            commands->resetQueries(*queries, 0, 4);
            misuse(device, {"'queries'", "do not exist"}, [&] { commands->writeTimestamp(*queries, 4); });
            misuse(device, {"stage Host"}, [&] { commands->writeTimestamp(*queries, 0, Stage::Host); });
            commands->writeTimestamp(*queries, 1);
            misuse(device, {"query 1", "not reset"}, [&] { commands->writeTimestamp(*queries, 1); });
            uint64_t ticks[2] = {};
            misuse(device, {"'queries'", "do not exist"}, [&] { CHECK_FALSE(queries->read(3, ticks)); });
        });
}

TEST_CASE("misuse: an engine's command buffer begun, ended or submitted by us", "[gpu]")
{
    // Over the recording device alone: a real one needs a real handle, which test_native.cpp provides.
    forEach({decoratedFactories().front()},
            [](TestDevice& device)
            {
                const auto commands = device->wrapCommandBuffer(1234, "engine's");
                CommandBuffer* const list[] = {commands.get()};
                misuse(device, {"'engine's'", "begin()", "wrapped"}, [&] { commands->begin(); });
                misuse(device, {"'engine's'", "end()", "wrapped"}, [&] { commands->end(); });
                misuse(device, {"'engine's'", "wrapped"}, [&] { device->submit(list, nullptr); });
            });
}
