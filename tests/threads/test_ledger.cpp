// The one thing that objects over one device share and write: the account of its memory.
#include "catch.h"
#include "ledger.h"
#include "side_by_side.h"
#include <string>

namespace
{
constexpr uint32_t kObjectNum = 2000;
}

TEST_CASE("an account that threads share adds up", "[unit]")
{
    rhi::MemoryLedger ledger;
    test::requireUndisturbed(
        [&](uint32_t worker)
        {
            std::vector<rhi::MemoryLedger::Entry> entries;
            const std::string own = "of worker " + std::to_string(worker);
            for (uint32_t i = 0; i < kObjectNum; i++)
            {
                entries.emplace_back(ledger, i % 2 ? "shared" : own.c_str(), 1 + worker);
                if (i % 3 == 0) entries.erase(entries.begin());
            }
            uint64_t byteSize = 0;
            for (const rhi::MemoryReportLine& line : ledger.report())
                if (line.tag == own) byteSize += line.byteSize;
            return byteSize;
        });
    CHECK(ledger.report().empty());
}
