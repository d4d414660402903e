#include "bench_bandwidth.h"

#include "bench_shaders.h"
#include "bench_statistics.h"

#include "engine/commands.h"
#include "engine/compute.h"
#include "engine/timestamps.h"

namespace sample::bench
{
namespace
{
constexpr uint32_t kRepeatCount = 20;
constexpr uint32_t kGroupSize = 16;
constexpr VkDeviceSize kTexelByteSize = 16;

// Side of the square RGBA32F image: 256 MiB on a GPU; a CPU's caches are smaller and its time is dear.
uint32_t sideFor(const engine::Device& device)
{
    return device.properties().deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU ? 1024 : 4096;
}

// Median milliseconds of what `record` records, each repeat on its own.
template <class F> double medianTime(const engine::Device& device, F&& record)
{
    engine::Timestamps timestamps(device, kRepeatCount + 1);
    engine::submitAndWait(device,
                          [&](VkCommandBuffer cmd)
                          {
                              timestamps.reset(cmd);
                              timestamps.mark(cmd);
                              for (uint32_t i = 0; i < kRepeatCount; i++)
                              {
                                  record(cmd);
                                  engine::memoryBarrier(cmd);
                                  timestamps.mark(cmd);
                              }
                          });
    std::vector<double> times = timestamps.read();
    return times.empty() ? 0.0 : quantile(std::move(times), 0.5);
}

double timeBufferCopy(const engine::Device& device, VkDeviceSize byteSize)
{
    const engine::Buffer source(device, {"bandwidth source", byteSize});
    const engine::Buffer target(device, {"bandwidth target", byteSize});
    return medianTime(device,
                      [&](VkCommandBuffer cmd)
                      {
                          const VkBufferCopy region = {0, 0, byteSize};
                          vkCmdCopyBuffer(cmd, source.handle(), target.handle(), 1, &region);
                      });
}

double timeShaderCopy(const engine::Device& device, uint32_t side)
{
    const bench_shaders::ShaderBlob blob = bench_shaders::shaderBlob(bench_shaders::Shader::BenchCopy);
    engine::ComputeDesc desc;
    desc.name = blob.name;
    desc.words = blob.words;
    desc.byteSize = blob.byteSize;
    desc.bindings = {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};
    const engine::ComputePipeline pipeline(device, desc);
    engine::Image source(device, {"bandwidth source", side, side});
    engine::Image target(device, {"bandwidth target", side, side});
    engine::submitAndWait(device,
                          [&](VkCommandBuffer cmd)
                          {
                              engine::transition(cmd, source, engine::kSampled);
                              engine::transition(cmd, target, engine::kStorage);
                          });
    const VkDescriptorSet set = pipeline.createSet({source, target});
    return medianTime(device,
                      [&](VkCommandBuffer cmd) {
                          pipeline.dispatch(cmd, set, {}, {side / kGroupSize, side / kGroupSize, 1});
                      });
}
} // namespace

double measureCopyBandwidth(const engine::Device& device)
{
    const uint32_t side = sideFor(device);
    const VkDeviceSize byteSize = kTexelByteSize * side * side;
    const double milliseconds = std::min(timeBufferCopy(device, byteSize), timeShaderCopy(device, side));
    return milliseconds > 0.0 ? 2.0 * static_cast<double>(byteSize) / (milliseconds * 1e-3) : 0.0;
}
} // namespace sample::bench
