// Runs one GLSL function over many arguments on the device.
#pragma once
#include "denoiser_constants.h"
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace nrdtest
{
using Vec4 = std::array<float, 4>;

struct Arguments
{
    Vec4 a{}, b{}, c{}, d{}, e{}, f{}, g{}, h{};
};

struct Results
{
    Vec4 first{}, second{};
};

enum class Language : uint8_t
{
    Glsl,
    Hlsl, // of the functions that applications include
};

// function: a number of functions.h. frames: what the functions of passes index. Any validation message of the device
// fails the running test case.
std::vector<Results> runFunction(int function, const std::vector<Arguments>& arguments,
                                 std::span<const nrd::shared::DenoiserConstants> frames = {},
                                 Language language = Language::Glsl);
Results runFunction(int function, const Arguments& arguments);
} // namespace nrdtest
