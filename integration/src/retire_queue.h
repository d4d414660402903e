// What the GPU may still use waits here until the frame that used it last is over.
#pragma once
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace nrd
{
class Retirable
{
public:
    Retirable() = default;
    Retirable(const Retirable&) = delete;
    Retirable& operator=(const Retirable&) = delete;
    virtual ~Retirable() = default;
};

class RetireQueue
{
public:
    /// `frame`: the last one that may have used it.
    void retire(uint64_t frame, std::unique_ptr<Retirable> object) { m_entries.push_back({frame, std::move(object)}); }
    /// Destroys what only frames up to `frame` used.
    void collect(uint64_t frame)
    {
        std::erase_if(m_entries, [frame](const Entry& entry) { return entry.frame <= frame; });
    }
    /// Makes room, so that the next `count` calls of retire() cannot fail.
    void reserve(size_t count) { m_entries.reserve(m_entries.size() + count); }
    uint32_t size() const { return static_cast<uint32_t>(m_entries.size()); }

private:
    struct Entry
    {
        uint64_t frame;
        std::unique_ptr<Retirable> object;
    };
    std::vector<Entry> m_entries;
};
} // namespace nrd
