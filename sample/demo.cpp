#include "demo.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sample
{
namespace
{
Image toImage(const Picture& picture)
{
    Image image(picture.width, picture.height);
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < picture.pixelCount(); ++i) image.rgba[i * 4 + c] = picture.planes[c][i];
    return image;
}

// With a white line between them.
Image sideBySide(const std::vector<Image>& images)
{
    constexpr int kLine = 4; // pixels
    const int width = images.front().width, height = images.front().height;
    const int count = static_cast<int>(images.size());
    Image out(count * width + (count - 1) * kLine, height);
    out.rgba.assign(out.rgba.size(), 1e6f);
    for (int k = 0; k < count; ++k)
        for (int y = 0; y < height; ++y)
            std::copy_n(images[size_t(k)].rgba.begin() + std::ptrdiff_t(y) * width * 4, width * 4,
                        out.rgba.begin() + (std::ptrdiff_t(y) * out.width + k * (width + kLine)) * 4);
    return out;
}
} // namespace

void writeDemoPictures(const std::filesystem::path& folder, const std::vector<DemoColumn>& columns)
{
    const ComposedPictures& first = columns.front().measurer.pictures();
    std::vector<std::pair<std::string, Image>> pictures = {{"noisy", toImage(first.noisy)}};
    for (const DemoColumn& column : columns)
        pictures.emplace_back(column.name, toImage(column.measurer.pictures().denoised));
    pictures.emplace_back("reference", toImage(first.reference));
    std::string order;
    std::vector<Image> images;
    for (const auto& [name, image] : pictures)
    {
        writePng(folder / (name + ".png"), image);
        order += (order.empty() ? "" : ", ") + name;
        images.push_back(image);
    }
    writePng(folder / "side-by-side.png", sideBySide(images));
    std::printf("side-by-side.png, from left to right: %s\n", order.c_str());
}

void printErrorTable(const std::vector<DemoColumn>& columns)
{
    constexpr auto kComposed = static_cast<size_t>(Signal::Composed);
    const SignalMeasures noisy = columns.front().measurer.meanNoisy()[kComposed];
    std::printf("\n%-10s %10s", "composed", "noisy");
    for (const DemoColumn& column : columns) std::printf(" %10s", column.name.c_str());
    std::printf("\n");
    for (const MeasureInfo& measure : kMeasures)
    {
        const std::optional<double>& before = noisy.*measure.field;
        if (!before) continue;
        std::printf("%-10s %10.*f", measure.name, measure.decimals, *before);
        for (const DemoColumn& column : columns)
        {
            const std::optional<double> after = column.measurer.meanDenoised()[kComposed].*measure.field;
            std::printf(" %*.*f", std::max(10, int(column.name.size())), measure.decimals, after.value_or(NAN));
        }
        std::printf("\n");
    }
}
} // namespace sample
