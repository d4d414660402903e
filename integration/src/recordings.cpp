#include "recordings.h"
#include <new>

namespace nrd
{
void Recordings::keep(uint32_t number, const Plan& plan) noexcept
{
    try
    {
        m_plans[number] = plan;
    }
    catch (const std::bad_alloc&)
    {
        forget(number);
    }
}

const Plan* Recordings::find(uint32_t number) const
{
    const auto found = m_plans.find(number);
    return found != m_plans.end() ? &found->second : nullptr;
}
} // namespace nrd
