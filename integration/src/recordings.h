// What applications' command buffers hold that are recorded once and submitted again and again, by the application's
// number for them.
#pragma once
#include "dispatch.h"
#include <map>

namespace nrd
{
class Recordings
{
public:
    /// Without memory for it the number stands for nothing, so that it is recorded anew.
    void keep(uint32_t number, const Plan& plan) noexcept;
    void forget(uint32_t number) { m_plans.erase(number); }
    void clear() { m_plans.clear(); }
    const Plan* find(uint32_t number) const; // null: nothing

private:
    std::map<uint32_t, Plan> m_plans;
};
} // namespace nrd
