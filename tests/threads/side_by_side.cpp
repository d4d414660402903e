#include "side_by_side.h"
#include "catch.h"
#include <array>
#include <latch>
#include <thread>
#include <vector>

namespace test
{
void requireUndisturbed(const Work& work)
{
    std::array<uint64_t, kWorkerNum> together = {};
    std::latch start(kWorkerNum);
    std::vector<std::thread> threads;
    for (uint32_t i = 0; i < kWorkerNum; i++)
        threads.emplace_back(
            [&, i]
            {
                start.arrive_and_wait();
                together[i] = work(i);
            });
    for (std::thread& thread : threads) thread.join();
    for (uint32_t i = 0; i < kWorkerNum; i++)
    {
        INFO("worker " << i);
        CHECK(together[i] == work(i));
    }
}
} // namespace test
