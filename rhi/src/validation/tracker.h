// The state of a resource as the barriers left it, and what happened to it since. Pure: knows no device.
#pragma once
#include <memory>
#include <rhi/states.h>
#include <string>
#include <vector>

namespace rhi::validation
{
/// One recording of a command buffer. What it did counts for nothing once it has been executed, or was never submitted.
struct Recording
{
    uint64_t id = 0;         // unique per device
    uint64_t submission = 0; // number of its submission, 0 = not submitted
    bool isDropped = false;  // recorded anew before it was submitted
};

/// One way of using a resource by one command.
struct Use
{
    Access access = Access::None;
    Stage stage = Stage::Compute;
    Layout layout = Layout::General; // textures only
    bool isWrite = false;
};

/// Who asks: the recording, and the number of the last submission known to be done.
struct Moment
{
    std::shared_ptr<const Recording> recording;
    uint64_t completed = 0;
};

/// A mip of a texture.
class MipTracker
{
public:
    /// For wrapped textures: the first barrier or use says what the state is.
    void forget() { m_isKnown = false; }
    /// The contents are gone: another texture took the memory.
    void discard();

    /// What is wrong with the use, as the rest of a sentence that began with the name; empty if nothing is.
    std::string findError(const Use& use, const Moment& now) const;
    void apply(const Use& use, const Moment& now);
    std::string findError(const TextureState& before, const Moment& now) const;
    void apply(const TextureState& after);
    /// What the last barrier allowed; everything if nobody knows.
    Access allowed() const { return m_isKnown ? m_state.access : Access::MemoryRead | Access::MemoryWrite; }
    /// Stages that used it since its last barrier and may still be running.
    Stage usedStages(const Moment& now) const;

private:
    bool isStale(const Moment& now) const;

    bool m_isKnown = true;
    TextureState m_state;
    Stage m_usedStages = Stage::None;
    bool m_isWritten = false; // since the last barrier
    std::shared_ptr<const Recording> m_user;
};

struct ByteRange
{
    uint64_t begin = 0;
    uint64_t end = 0;
};

class BufferTracker
{
public:
    std::string findError(const Use& use, ByteRange range, const Moment& now) const;
    void apply(const Use& use, ByteRange range, const Moment& now);
    std::string findError(const BufferState& before, const Moment& now) const;
    void apply(const BufferState& after);
    Access allowed() const { return m_isKnown ? m_state.access : Access::MemoryRead | Access::MemoryWrite; }

private:
    struct Entry
    {
        Use use;
        ByteRange range;
        std::shared_ptr<const Recording> user;
    };
    bool m_isKnown = false; // a barrier said what the state is
    BufferState m_state;
    std::vector<Entry> m_uses; // since the last barrier
};

std::string describe(Access access);
std::string describe(Stage stages);
std::string describe(const TextureState& state);
std::string describe(const BufferState& state);
const char* describe(Layout layout);
} // namespace rhi::validation
