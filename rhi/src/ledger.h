// Counts bytes by tag, for the memory report.
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <rhi/device.h>
#include <string>
#include <vector>

namespace rhi
{
class MemoryLedger
{
public:
    /// One line's share of one object; gives its bytes back when it goes.
    class Entry
    {
    public:
        Entry() = default;
        Entry(MemoryLedger& ledger, const char* tag, uint64_t byteSize);
        Entry(Entry&& other) noexcept;
        Entry& operator=(Entry other) noexcept;
        ~Entry();

    private:
        MemoryLedger* m_ledger = nullptr;
        MemoryReportLine* m_line = nullptr;
        uint64_t m_byteSize = 0;
    };

    std::vector<MemoryReportLine> report() const; // sorted by tag, lines without allocations left out

private:
    mutable std::mutex m_mutex;
    std::map<std::string, MemoryReportLine> m_lines; // a node stays where it is, so entries may point at it
};
} // namespace rhi
