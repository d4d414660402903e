// An integration over the recording device under the validating decorator, and the life of an application around it.
#pragma once
#include "soak.h"
#include <integration_access.h>
#include <rhi/recording.h>
#include <rhi/validation.h>
#include <string>

namespace faults
{
class RecordedLife
{
public:
    explicit RecordedLife(uint32_t seed);

    /// A frame with whatever the dice want before and in it.
    void frame();
    /// Anew, always the same and without the decorator, with enough frames that everything has settled.
    void settle();
    void destroy();

    struct Holdings
    {
        uint32_t objects = 0; // of the device
        uint64_t bytes = 0;
        bool operator==(const Holdings&) const = default;
    };
    Holdings holdings() const;
    const std::vector<std::string>& misuses() const { return m_misuses; }

private:
    struct Choice
    {
        std::vector<nrd::DenoiserDesc> denoisers;
        nrd::IntegrationCreationDesc desc;
    };
    Choice anyChoice();
    void create(const Choice& choice, bool isValidated);
    void resize(uint16_t width, uint16_t height);
    void plainFrame(const nrd::CommonSettings& settings, const std::vector<nrd::Identifier>& identifiers,
                    const nrd::DenoiseOptions& options);
    nrd::CommonSettings common();
    void fillPool();

    Dice m_dice;
    std::vector<std::string> m_misuses;
    std::unique_ptr<rhi::RecordingDevice> m_device = rhi::makeRecordingDevice();
    std::unique_ptr<rhi::Device> m_validating; // one per integration, for it keeps the names of the dead
    Choice m_choice;
    nrd::NrdUserPool m_pool;
    uint64_t m_generation = 0;
    uint32_t m_frameIndex = 0;
    uint16_t m_lastSize[2] = {};       // of the last frame, 0: there was none
    nrd::NrdIntegration m_integration; // goes first
};
} // namespace faults
