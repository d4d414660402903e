#include "capture_fixture.h"
#include "exr.h"

#include <cmath>
#include <fstream>

using namespace sample;
using namespace test;

TEST_CASE("channels keep their names, types and values through a file", "[unit]")
{
    TempFolder folder;
    ExrPicture picture{3, 2, {}};
    picture.channels.push_back({"b.half", ExrType::Half, {0.0f, 1.0f, -2.5f, 65504.0f, 0.1f, 6.0e-8f}});
    picture.channels.push_back({"a.float", ExrType::Float, {0.1f, 1e30f, -1e-30f, 3.0f, 4.0f, 5.0f}});
    writeExr(folder.path() / "x.exr", picture);
    const ExrPicture read = readExr(folder.path() / "x.exr");
    REQUIRE(read.find("a.float"));
    REQUIRE(read.find("b.half"));
    CHECK(read.find("c") == nullptr);
    CHECK(read.find("a.float")->type == ExrType::Float);
    CHECK(read.find("b.half")->type == ExrType::Half);
    CHECK(read.find("a.float")->values == picture.channels[1].values);
    const std::vector<float>& halves = read.find("b.half")->values;
    CHECK(halves[3] == 65504.0f);
    CHECK(std::abs(halves[4] - 0.1f) <= 0.1f / 2048.0f);
    CHECK(halves[4] != 0.1f);
    const ExrHeader header = readExrHeader(folder.path() / "x.exr");
    CHECK(header.width == 3);
    CHECK(header.height == 2);
    CHECK(header.isLossless);
    CHECK(header.channelNames == std::vector<std::string>{"a.float", "b.half"});
}

TEST_CASE("a file that cannot be written is named", "[unit]")
{
    const std::filesystem::path file = "/nonexistent-folder/x.exr";
    CHECK_THAT(errorOf(
                   [&] {
                       writeExr(file, {1, 1, {{"R", ExrType::Half, {1.0f}}}});
                   }),
               containing("/nonexistent-folder/x.exr cannot be written"));
    CHECK_THAT(errorOf([&] { writePng("/nonexistent-folder/x.png", Image(1, 1)); }),
               containing("/nonexistent-folder/x.png cannot be written"));
}

TEST_CASE("environments are read from .hdr and .exr, other files refused", "[unit]")
{
    TempFolder folder;
    // 2 x 1 pixels, flat RGBE: (128, 64, 32) * 2^(129 - 136) and black.
    std::ofstream(folder.path() / "sky.hdr", std::ios::binary) << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"
                                                               << std::string("\x80\x40\x20\x81\0\0\0\0", 8);
    const Image hdr = readImage(folder.path() / "sky.hdr");
    CHECK(hdr.width == 2);
    CHECK(hdr.height == 1);
    CHECK(hdr.rgba == std::vector<float>{1.0f, 0.5f, 0.25f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f});

    writeExr(folder.path() / "sky.exr",
             {1, 1, {{"R", ExrType::Float, {1.0f}}, {"G", ExrType::Float, {2.0f}}, {"B", ExrType::Float, {3.0f}}}});
    CHECK(readImage(folder.path() / "sky.exr").rgba == std::vector<float>{1.0f, 2.0f, 3.0f, 1.0f});

    writeExr(folder.path() / "z.exr", {1, 1, {{"Z", ExrType::Float, {1.0f}}}});
    CHECK_THAT(errorOf([&] { (void)readImage(folder.path() / "z.exr"); }), containing("no channel R"));
    std::ofstream(folder.path() / "bad.hdr") << "not a picture";
    CHECK_THAT(errorOf([&] { (void)readImage(folder.path() / "bad.hdr"); }), containing("bad.hdr"));
    std::ofstream(folder.path() / "cut.hdr", std::ios::binary)
        << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 9 +X 99999999\n";
    CHECK_THAT(errorOf([&] { (void)readImage(folder.path() / "cut.hdr"); }), containing("cut.hdr"));
    CHECK_THAT(errorOf([&] { (void)readImage(folder.path() / "none.hdr"); }), containing("none.hdr"));
    CHECK_THAT(errorOf([&] { (void)readImage(folder.path() / "x.jpg"); }), containing("neither"));
}

TEST_CASE("the tone mapping is srgb(x / (1 + x)), and 0 for what is negative or not finite", "[unit]")
{
    CHECK(toneMap(0.0f) == 0.0f);
    CHECK(toneMap(1.0f) == Approx(0.735357).epsilon(1e-5)); // srgb(0.5)
    CHECK(toneMap(0.001f) == Approx(12.92 * 0.001 / 1.001).epsilon(1e-5));
    CHECK(toneMap(1e30f) == Approx(1.0));
    CHECK(toneMap(-1.0f) == 0.0f);
    CHECK(toneMap(std::nanf("")) == 0.0f);
    CHECK(toneMap(INFINITY) == 0.0f);
}

TEST_CASE("a PNG starts with its signature and has the stated size", "[unit]")
{
    TempFolder folder;
    Image image(3, 2);
    writePng(folder.path() / "x.png", image);
    std::ifstream stream(folder.path() / "x.png", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    REQUIRE(bytes.size() > 24);
    CHECK(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
    CHECK(static_cast<int>(bytes[19]) == 3);
    CHECK(static_cast<int>(bytes[23]) == 2);
}
