// What a dump makes of each packing, over two pixels and without a device.
#include "catch.h"
#include "dump/dump_frame.h"
#include <cmath>

using nrd::Denoiser;
using nrd::ResourceType;
using nrd::dump::Channels;

namespace
{
using Texels = std::vector<float>;

// Looks along -Z; the rectangle is 2 x 1.
struct Frame
{
    Frame()
    {
        nrd::CommonSettings& common = context.common;
        for (float* matrix : {common.worldToViewMatrix, common.worldToViewMatrixPrev})
            for (int i = 0; i < 4; i++) matrix[i * 5] = 1.0f;
        for (float* matrix : {common.viewToClipMatrix, common.viewToClipMatrixPrev})
        {
            matrix[0] = matrix[5] = 1.0f;
            matrix[11] = -1.0f;
            matrix[14] = 0.1f;
        }
        for (uint16_t* size : {common.resourceSize, common.rectSize})
        {
            size[0] = 2;
            size[1] = 1;
        }
        common.denoisingRange = 100.0f;
    }
    void add(ResourceType type, Denoiser denoiser, Texels texels, uint32_t width = 2, uint32_t height = 1)
    {
        images.push_back(std::move(texels));
        nrd::dump::SlotContext slot;
        slot.type = type;
        slot.denoiser = denoiser;
        slot.width = width;
        slot.height = height;
        slots.push_back({slot, nullptr});
    }
    Channels unpack()
    {
        for (size_t i = 0; i < slots.size(); i++) slots[i].texels = images[i].data();
        return nrd::dump::unpackFrame(context, slots, notes);
    }

    nrd::dump::FrameContext context;
    std::vector<Texels> images;
    std::vector<nrd::dump::SlotTexels> slots;
    std::vector<std::string> notes;
};

void check(const Channels& channels, const char* name, float first, float second)
{
    INFO(name);
    const auto found = channels.find(name);
    REQUIRE(found != channels.end());
    CHECK(found->second.at(0) == Approx(first).margin(1e-5));
    CHECK(found->second.at(1) == Approx(second).margin(1e-5));
}
} // namespace

TEST_CASE("depths take the sign of the camera, motion on the screen becomes one of the world", "[unit]")
{
    Frame frame;
    frame.context.common.viewZScale = 2.0f;
    frame.context.common.motionVectorScale[2] = 1.0f;
    frame.add(ResourceType::IN_VIEWZ, Denoiser::RELAX_DIFFUSE, {5, 0, 0, 0, 500, 0, 0, 0}); // the second is sky
    // A quarter of the screen at a depth of 10, where it is 20 wide; then 2 units away, 1 as stored.
    frame.add(ResourceType::IN_MV, Denoiser::RELAX_DIFFUSE, {0.25f, 0, 1, 0, 0.5f, 0.5f, 0.5f, 0});
    const Channels channels = frame.unpack();
    check(channels, "viewZ", -10.0f, -1000.0f);
    check(channels, "motion.X", 5.0f, 0.0f); // from u = 0.25, x = -5, to the middle
    check(channels, "motion.Y", 0.0f, 0.0f);
    check(channels, "motion.Z", -2.0f, 0.0f);
    CHECK(frame.notes.empty());
}

TEST_CASE("motion in the world is scaled, its third axis by the first where none is given", "[unit]")
{
    Frame frame;
    frame.context.common.isMotionVectorInWorldSpace = true;
    for (int i = 0; i < 2; i++) frame.context.common.motionVectorScale[i] = 3.0f;
    frame.add(ResourceType::IN_VIEWZ, Denoiser::RELAX_DIFFUSE, {5, 0, 0, 0, 5, 0, 0, 0});
    frame.add(ResourceType::IN_MV, Denoiser::RELAX_DIFFUSE, {1, 2, 3, 0, 0, 0, -1, 0});
    const Channels channels = frame.unpack();
    check(channels, "motion.X", 3.0f, 0.0f);
    check(channels, "motion.Y", 6.0f, 0.0f);
    check(channels, "motion.Z", 9.0f, -3.0f);
}

TEST_CASE("signals of both families are radiance, distance and direction", "[unit]")
{
    const bool isReblur = GENERATE(true, false);
    const Denoiser denoiser = isReblur ? Denoiser::REBLUR_DIFFUSE_SH : Denoiser::RELAX_DIFFUSE_SH;
    Frame frame;
    frame.add(ResourceType::IN_VIEWZ, denoiser, {10, 0, 0, 0, 10, 0, 0, 0});
    // Red of 4, luma 1, Co 2, Cg -1. REBLUR's range is 3 + 10 * 0.1 = 4 at roughness 1.
    if (isReblur)
        frame.add(ResourceType::IN_DIFF_SH0, denoiser, {1, 2, -1, 0.5f, 0, 0, 0, 1});
    else
        frame.add(ResourceType::IN_DIFF_SH0, denoiser, {4, 0, 0, 2, 0, 0, 0, 65504});
    frame.add(ResourceType::IN_DIFF_SH1, denoiser, {0, 0.6f, 0.8f, 0, 0, 0, 0, 0});
    const Channels channels = frame.unpack();
    check(channels, "diffuse.R", 4.0f, 0.0f);
    check(channels, "diffuse.G", 0.0f, 0.0f);
    check(channels, "diffuse.B", 0.0f, 0.0f);
    check(channels, "diffuse.hitDist", 2.0f, 65504.0f);
    check(channels, "diffuse.DX", 0.0f, 0.0f);
    check(channels, "diffuse.DY", 0.6f, 0.0f);
    check(channels, "diffuse.DZ", 0.8f, 0.0f);
    CHECK(channels.count("specular.R") == 0);
}

TEST_CASE("a layer that is dumped in part is completed", "[unit]")
{
    Frame frame;
    frame.add(ResourceType::IN_VIEWZ, Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION, {10, 0, 0, 0, 10, 0, 0, 0});
    frame.add(ResourceType::IN_DIFF_DIRECTION_HITDIST, Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION,
              {0, 0, 0.25f, 0.25f, 0, 0, 0, 0});
    const Channels channels = frame.unpack();
    check(channels, "diffuse.hitDist", 1.0f, 0.0f);
    check(channels, "diffuse.DZ", 1.0f, 0.0f);
    check(channels, "diffuse.R", 0.0f, 0.0f);
}

TEST_CASE("penumbrae are distances to a light of tangent 1", "[unit]")
{
    Frame frame;
    frame.add(ResourceType::IN_VIEWZ, Denoiser::SIGMA_SHADOW_TRANSLUCENCY, {10, 0, 0, 0, 10, 0, 0, 0});
    frame.add(ResourceType::IN_PENUMBRA, Denoiser::SIGMA_SHADOW_TRANSLUCENCY, {0.3f, 0, 0, 0, 65504, 0, 0, 0});
    Channels channels = frame.unpack();
    check(channels, "shadow.dist", 0.3f, 65504.0f);
    check(channels, "shadow.R", 0.0f, 1.0f);
    frame.add(ResourceType::IN_TRANSLUCENCY, Denoiser::SIGMA_SHADOW_TRANSLUCENCY, {0, 0.1f, 0.2f, 0.4f, 1, 1, 1, 1});
    channels = frame.unpack();
    check(channels, "shadow.R", 0.1f, 1.0f);
    check(channels, "shadow.B", 0.4f, 1.0f);
}

TEST_CASE("guides lie at the rectangle's origin, signals at the image's", "[unit]")
{
    Frame frame;
    frame.context.common.rectOrigin[0] = 1;
    frame.add(ResourceType::IN_VIEWZ, Denoiser::REFERENCE, {1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0}, 3);
    frame.add(ResourceType::IN_SIGNAL, Denoiser::REFERENCE, {7, 0, 0, 0, 8, 0, 0, 0, 9, 0, 0, 0}, 3);
    const Channels channels = frame.unpack();
    check(channels, "viewZ", -2.0f, -3.0f);
    check(channels, "diffuse.R", 7.0f, 8.0f);
}

TEST_CASE("an image that is smaller than the rectangle is left out with a note", "[unit]")
{
    Frame frame;
    frame.add(ResourceType::IN_VIEWZ, Denoiser::RELAX_DIFFUSE, {1, 0, 0, 0}, 1);
    CHECK(frame.unpack().count("viewZ") == 1); // a capture has depths
    REQUIRE(frame.notes.size() == 2);
    CHECK(frame.notes[0] == "IN_VIEWZ is left out: 1 x 1 texels are less than the rectangle");
    CHECK(frame.notes[1] == "no denoiser was handed IN_VIEWZ; written as 1");
}
