#include "ledger.h"
#include <utility>

namespace rhi
{
MemoryLedger::Entry::Entry(MemoryLedger& ledger, const char* tag, uint64_t byteSize)
    : m_ledger(&ledger), m_byteSize(byteSize)
{
    const std::lock_guard lock(ledger.m_mutex);
    const std::string key = tag ? tag : "";
    m_line = &ledger.m_lines[key];
    m_line->tag = key;
    m_line->byteSize += byteSize;
    m_line->allocationCount++;
}

MemoryLedger::Entry::Entry(Entry&& other) noexcept
    : m_ledger(std::exchange(other.m_ledger, nullptr)), m_line(other.m_line), m_byteSize(other.m_byteSize)
{
}

MemoryLedger::Entry& MemoryLedger::Entry::operator=(Entry other) noexcept
{
    std::swap(m_ledger, other.m_ledger);
    std::swap(m_line, other.m_line);
    std::swap(m_byteSize, other.m_byteSize);
    return *this;
}

MemoryLedger::Entry::~Entry()
{
    if (!m_ledger) return;
    const std::lock_guard lock(m_ledger->m_mutex);
    m_line->byteSize -= m_byteSize;
    m_line->allocationCount--;
}

std::vector<MemoryReportLine> MemoryLedger::report() const
{
    const std::lock_guard lock(m_mutex);
    std::vector<MemoryReportLine> report;
    for (const auto& [tag, line] : m_lines)
        if (line.allocationCount > 0) report.push_back(line);
    return report;
}
} // namespace rhi
