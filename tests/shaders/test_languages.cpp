// The one include gives the same numbers in both of its languages, on the device, over random arguments.
#include "catch.h"
#include "functions.h"
#include "random.h"
#include <cmath>
#include <cstring>

using namespace nrdtest;

namespace
{
constexpr int kCount = 4096;

struct Range
{
    int first, last; // numbers of functions
};

// Four numbers of a kind that some argument is: a direction, a radiance, ratios, or anything of a signal.
Vec4 draw(Random& random)
{
    Vec4 result;
    switch (random.below(3))
    {
    case 0:
        result = toVec4(random.normal(), random.unit());
        break;
    case 1:
        for (float& value : result) value = static_cast<float>(random.unit());
        break;
    default:
        for (float& value : result) value = random.signal(1e-3, 1e3);
    }
    return result;
}

Arguments drawArguments(Random& random, int function)
{
    Arguments result;
    for (Vec4* vector : {&result.a, &result.b, &result.c, &result.d, &result.e, &result.f, &result.g, &result.h})
        *vector = draw(random);
    const bool hasEncodings =
        function == FN_PACK_NORMAL || function == FN_UNPACK_NORMAL || function == FN_NORMAL_ROUND_TRIP;
    if (hasEncodings)
    {
        result.b = {static_cast<float>(random.below(4)), static_cast<float>(random.below(5)),
                    static_cast<float>(random.below(3)), 0.0f};
        result.c = {1023.0f, 3.0f, 0.0f, 0.0f};
    }
    return result;
}

// Equal to the last bit, or both are no number; the compilers may order products and sums differently.
bool isEqual(float a, float b)
{
    if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
    if (std::isinf(a) || std::isinf(b)) return a == b;
    return std::fabs(a - b) <= 1e-5f * std::fmax(std::fabs(a), std::fabs(b));
}

std::string textOf(const Arguments& v)
{
    std::string result;
    for (const Vec4& vector : {v.a, v.b, v.c, v.d, v.e, v.f, v.g, v.h})
        for (const float value : vector) result += std::to_string(value) + " ";
    return result;
}
} // namespace

TEST_CASE("the front end's functions give the same in GLSL and HLSL", "[gpu]")
{
    const Range range = GENERATE(Range{FN_PACK_NORMAL, FN_NORMAL_ROUND_TRIP}, Range{FN_UNPACK_SH, FN_UNFOLD_BEND},
                                 Range{FN_PENUMBRA, FN_MULTI_LIGHT});
    Random random(77);
    for (int function = range.first; function <= range.last; function++)
    {
        std::vector<Arguments> arguments;
        for (int i = 0; i < kCount; i++) arguments.push_back(drawArguments(random, function));
        const std::vector<Results> glsl = runFunction(function, arguments);
        const std::vector<Results> hlsl = runFunction(function, arguments, {}, Language::Hlsl);
        int differentNum = 0, nonZeroNum = 0, inexactNum = 0;
        for (int i = 0; i < kCount; i++)
            for (int channel = 0; channel < 8; channel++)
            {
                const float a = (channel < 4 ? glsl[i].first : glsl[i].second)[channel % 4];
                const float b = (channel < 4 ? hlsl[i].first : hlsl[i].second)[channel % 4];
                nonZeroNum += a != 0.0f;
                inexactNum += std::memcmp(&a, &b, sizeof(float)) != 0 && !std::isnan(a);
                if (isEqual(a, b) || differentNum++ > 3) continue;
                UNSCOPED_INFO("channel " << channel << ": " << a << " and " << b << " of " << textOf(arguments[i]));
            }
        if (inexactNum) WARN("function " << function << ": " << inexactNum << " of " << nonZeroNum << " not bit-equal");
        INFO("function " << function);
        CHECK(differentNum == 0);
        CHECK(nonZeroNum > kCount / 4);
    }
}
