// One misuse at a time: the decorator reports exactly one sentence, which names the object, and passes nothing on (the
// validation of the API would complain otherwise).
#pragma once
#include "catch.h"
#include "fixture.h"
#include "gpu.h"

namespace rhi::test
{
/// The text parts that the one report must contain.
using Parts = std::vector<std::string>;

inline void requireOneReport(TestDevice& device, const Parts& parts)
{
    const std::vector<std::string> reports = device.takeMisuses();
    std::string all;
    for (const std::string& text : reports) all += text + "\n";
    INFO("reported: " << all);
    REQUIRE(reports.size() == 1);
    for (const std::string& part : parts) CHECK_THAT(reports.front(), containing(part));
}

inline void misuse(TestDevice& device, const Parts& parts, const std::function<void()>& body)
{
    body();
    requireOneReport(device, parts);
}

/// The misuse of a factory is thrown as well.
inline void misusedFactory(TestDevice& device, const Parts& parts, const std::function<void()>& body)
{
    CHECK_THROWS_AS(body(), Error);
    requireOneReport(device, parts);
}

inline TextureDesc smallTexture(const char* name, TextureUsage usage = TextureUsage::Sampled | TextureUsage::Storage |
                                                                       TextureUsage::TransferSrc |
                                                                       TextureUsage::TransferDst)
{
    TextureDesc desc;
    desc.format = Format::R32_UINT;
    desc.width = desc.height = 16;
    desc.mipCount = 3;
    desc.usage = usage;
    desc.name = name;
    return desc;
}

/// A command buffer in the middle of being recorded; whatever it holds is dropped.
class Recorder
{
public:
    explicit Recorder(TestDevice& device) : m_commands(device->createCommandBuffer("commands")) { m_commands->begin(); }
    CommandBuffer& operator*() const { return *m_commands; }
    CommandBuffer* operator->() const { return m_commands.get(); }

private:
    std::unique_ptr<CommandBuffer> m_commands;
};

inline constexpr BindingDesc kOneBuffer[] = {{0, 0, BindingType::StorageBuffer}};
inline constexpr BindingDesc kOneTexture[] = {{0, 0, BindingType::StorageTexture}};
inline constexpr BindingDesc kTextureToTexture[] = {{0, 0, BindingType::SampledTexture},
                                                    {0, 1, BindingType::StorageTexture}};
inline constexpr BindingDesc kConstantsAndBuffer[] = {{0, 0, BindingType::UniformBufferDynamic},
                                                      {0, 1, BindingType::StorageBuffer}};

inline void forEachDecorated(const std::function<void(TestDevice&)>& body) { forEach(decoratedFactories(), body); }
} // namespace rhi::test
