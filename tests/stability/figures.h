// One line of the table of figures: what was measured, the denoiser that did worst, and the bound.
#pragma once
#include "long_form.h"
#include <nrd/nrd.h>
#include <string>

namespace stability
{
using test::isLong;

class Figure
{
public:
    // bound: no value may be larger; infinite: printed only. unit: behind the numbers, "%" for instance.
    Figure(std::string what, std::string unit, double bound);
    ~Figure(); // prints

    // Fails the test case if the value, or no number, is beyond the bound.
    void add(nrd::Denoiser denoiser, double value);

    Figure(const Figure&) = delete;
    Figure& operator=(const Figure&) = delete;

private:
    std::string m_what, m_unit;
    double m_bound;
    double m_worst = 0.0;
    nrd::Denoiser m_denoiser = nrd::Denoiser::MAX_NUM; // MAX_NUM: nothing measured
};
} // namespace stability
