#include "figures.h"
#include "catch.h"
#include <cmath>
#include <cstdio>
#include <utility>

namespace stability
{
Figure::Figure(std::string what, std::string unit, double bound)
    : m_what(std::move(what)), m_unit(std::move(unit)), m_bound(bound)
{
}

Figure::~Figure()
{
    if (m_denoiser == nrd::Denoiser::MAX_NUM) return;
    char bound[32] = "no bound";
    if (std::isfinite(m_bound)) std::snprintf(bound, sizeof(bound), "bound %.4g", m_bound);
    std::printf("FIGURE %s: %.4g %s at worst, of %s (%s)\n", m_what.c_str(), m_worst, m_unit.c_str(),
                nrd::toString(m_denoiser), bound);
}

void Figure::add(nrd::Denoiser denoiser, double value)
{
    INFO(nrd::toString(denoiser) << ", " << m_what << " [" << m_unit << "]");
    CHECK(value <= m_bound); // fails for NaN too
    if (isLong()) std::printf("%s, %s: %.4g %s\n", nrd::toString(denoiser), m_what.c_str(), value, m_unit.c_str());
    if (value <= m_worst && m_denoiser != nrd::Denoiser::MAX_NUM) return;
    m_worst = value;
    m_denoiser = denoiser;
}
} // namespace stability
