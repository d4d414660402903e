// The tables against the SPIR-V that was built: bindings, group sizes, switches, constants.
#include "bindings.h"
#include "denoisers/families.h"
#include "expand.h"
#include "fixture.h"
#include "reblur_constants.h"
#include "reference_constants.h"
#include "spirv.h"
#include <algorithm>
#include <cctype>

using namespace test;

namespace
{
// "gIn_DiffuseConfidence", "IN_DIFF_CONFIDENCE", "gPrev_ViewZ" and "PrevViewZ" are to compare as equal.
std::string normalize(std::string name)
{
    for (const char* prefix : {"gIn_", "gOut_", "gPrev_", "IN_", "OUT_"})
    {
        if (name.rfind(prefix, 0) == 0) name = name.substr(std::string(prefix).size());
    }
    std::string result;
    for (char c : name)
    {
        if (c != '_') result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    const std::pair<std::string, std::string> words[] = {{"diffuse", "diff"}, {"specular", "spec"}, {"motion", "mv"},
                                                         {"prev", ""},        {"temp", ""},         {"threshold", ""}};
    for (const auto& [from, to] : words)
    {
        for (size_t at = result.find(from); at != std::string::npos; at = result.find(from))
            result.replace(at, from.size(), to);
    }
    return result;
}

const SignalRow* findSignal(const Program& program, const Binding& binding)
{
    const auto& signals = program.variant->signals;
    if (binding.isTexture())
    {
        const Texture& texture = program.textures[binding.texture];
        return texture.row->format.rule == FormatRule::PerSignal ? &signals[texture.signal] : nullptr;
    }
    for (const SignalRow& signal : signals)
    {
        if (signal.input == binding.type || signal.output == binding.type) return &signal;
    }
    return nullptr;
}

// What is bound per signal is named after its lobe; everything else after the slot.
void checkName(const Program& program, const Binding& binding, const std::string& shaderName)
{
    const std::string name = normalize(shaderName);
    const SignalRow* signal = findSignal(program, binding);
    if (signal && signal->lobe != kNoLobe)
    {
        CHECK_THAT(name, containing(signal->lobe == kDiffuse ? "diff" : "spec"));
        return;
    }
    const bool isTexture = binding.isTexture();
    CHECK(name == normalize(isTexture ? program.textures[binding.texture].row->name : toString(binding.type)));
}

// Returns how many of the slots the shader does not use: the optimiser drops those.
template <class Slots>
size_t checkBindings(const Program& program, const Slots& slots, const ShaderModule& module, size_t first,
                     BindingKind kind, const char* prefix)
{
    size_t unusedNum = 0;
    for (size_t i = 0; i < slots.size(); i++)
    {
        const auto isHere = [&](const ShaderBinding& b) { return b.set == SET_RESOURCES && b.binding == first + i; };
        const auto found = std::find_if(module.bindings.begin(), module.bindings.end(), isHere);
        if (found == module.bindings.end())
        {
            unusedNum++;
            continue;
        }
        INFO("binding " << first + i << ", " << found->name);
        CHECK(found->kind == kind);
        CHECK_THAT(found->name, containing(prefix));
        checkName(program, slots[i].binding, found->name);
    }
    return unusedNum;
}

void checkLayout(const Pass& pass, const ShaderModule& module)
{
    for (const ShaderBinding& b : module.bindings)
    {
        INFO(b.name);
        if (b.set == SET_RESOURCES)
        {
            CHECK(b.binding < pass.reads.size() + pass.writes.size());
            continue;
        }
        CHECK(b.set == SET_CONSTANTS);
        const bool isConstants = b.binding == BINDING_CONSTANTS;
        CHECK(b.kind == (isConstants ? BindingKind::UniformBuffer : BindingKind::Sampler));
    }
    // A tile, and a whole grid of one, is one group, whatever its number of invocations.
    const bool isTileGroup = (pass.row->group.x == TILE_SIZE && module.localSize[0] < TILE_SIZE) ||
                             (pass.row->group.x == 1 && pass.row->gridFactor == kOneTexel);
    CHECK((isTileGroup || module.localSize[0] == pass.row->group.x));
    CHECK((isTileGroup || module.localSize[1] == pass.row->group.y));
}

void checkPass(const Program& program, const Pass& pass)
{
    const ShaderBlob blob = shaderBlob(pass.shader);
    INFO(blob.name);
    const ShaderModule module = parseSpirv(blob.words, blob.byteSize);
    const size_t unreadNum = checkBindings(program, pass.reads, module, 0, BindingKind::SampledImage, "g");
    const size_t unwrittenNum =
        checkBindings(program, pass.writes, module, pass.reads.size(), BindingKind::StorageImage, "gOut_");
    CHECK(unreadNum <= 1);
    CHECK(unwrittenNum == 0);
    if (unreadNum > 0) WARN(blob.name << " does not read one of the textures of its table row");
    checkLayout(pass, module);
    for (const SwitchRow& row : pass.switches)
    {
        INFO("specialisation constant " << row.constantId);
        const auto& ids = module.specializationIds;
        CHECK(std::find(ids.begin(), ids.end(), row.constantId) != ids.end());
    }
}

struct Member
{
    const char* name;
    size_t offset;
};

template <size_t Num> void checkMembers(Shader shader, const std::string& structName, const Member (&members)[Num])
{
    const ShaderBlob blob = shaderBlob(shader);
    const ShaderModule module = parseSpirv(blob.words, blob.byteSize);
    const auto found = module.memberOffsets.find(structName);
    REQUIRE(found != module.memberOffsets.end());
    CHECK(found->second.size() == Num);
    for (const Member& member : members)
    {
        INFO(structName << "::" << member.name);
        const auto offset = found->second.find(member.name);
        REQUIRE(offset != found->second.end());
        CHECK(offset->second == member.offset);
    }
}
} // namespace

TEST_CASE("bindings, groups and switches of each shader are those of its table row", "[unit]")
{
    for (const Family* family : kFamilies)
    {
        for (size_t variant = 0; variant < family->variants.size(); variant++)
        {
            const Program program = expand({family, variant}, NormalEncoding::R10_G10_B10_A2_UNORM);
            for (const Pass& pass : program.passes) checkPass(program, pass);
        }
    }
}

TEST_CASE("clears write one storage image and need no constants", "[unit]")
{
    for (Shader shader : {Shader::ClearFloat, Shader::ClearUint})
    {
        const ShaderBlob blob = shaderBlob(shader);
        const ShaderModule module = parseSpirv(blob.words, blob.byteSize);
        REQUIRE(module.bindings.size() == 1);
        CHECK(module.bindings[0].set == SET_RESOURCES);
        CHECK(module.bindings[0].binding == 0);
        CHECK(module.bindings[0].kind == BindingKind::StorageImage);
        CHECK(module.localSize[0] == 16);
        CHECK(module.localSize[1] == 16);
    }
}

TEST_CASE("constants lie at the same offsets in C++ and in SPIR-V", "[unit]")
{
    using shared::ReblurConstants;
    using shared::ReferenceConstants;
    const Member reblur[] = {
        {"worldToClip", offsetof(ReblurConstants, worldToClip)},
        {"worldToClipPrev", offsetof(ReblurConstants, worldToClipPrev)},
        {"worldToViewPrev", offsetof(ReblurConstants, worldToViewPrev)},
        {"viewToWorld", offsetof(ReblurConstants, viewToWorld)},
        {"viewToWorldPrev", offsetof(ReblurConstants, viewToWorldPrev)},
        {"frustum", offsetof(ReblurConstants, frustum)},
        {"frustumPrev", offsetof(ReblurConstants, frustumPrev)},
        {"cameraDelta", offsetof(ReblurConstants, cameraDelta)},
        {"viewDirection", offsetof(ReblurConstants, viewDirection)},
        {"cameraPosition", offsetof(ReblurConstants, cameraPosition)},
        {"cameraJitter", offsetof(ReblurConstants, cameraJitter)},
        {"rotatorPrePass", offsetof(ReblurConstants, rotatorPrePass)},
        {"rotatorBlur", offsetof(ReblurConstants, rotatorBlur)},
        {"rotatorPostBlur", offsetof(ReblurConstants, rotatorPostBlur)},
        {"hitDistanceParameters", offsetof(ReblurConstants, hitDistanceParameters)},
        {"motionVectorScale", offsetof(ReblurConstants, motionVectorScale)},
        {"rectSize", offsetof(ReblurConstants, rectSize)},
        {"rectSizeInv", offsetof(ReblurConstants, rectSizeInv)},
        {"rectSizePrev", offsetof(ReblurConstants, rectSizePrev)},
        {"resourceSizeInv", offsetof(ReblurConstants, resourceSizeInv)},
        {"resourceSizeInvPrev", offsetof(ReblurConstants, resourceSizeInvPrev)},
        {"convergence", offsetof(ReblurConstants, convergence)},
        {"rectOrigin", offsetof(ReblurConstants, rectOrigin)},
        {"rectSizeMinusOne", offsetof(ReblurConstants, rectSizeMinusOne)},
        {"convergenceLengthInv", offsetof(ReblurConstants, convergenceLengthInv)},
        {"unproject", offsetof(ReblurConstants, unproject)},
        {"minRectDim", offsetof(ReblurConstants, minRectDim)},
        {"denoisingRange", offsetof(ReblurConstants, denoisingRange)},
        {"viewZScale", offsetof(ReblurConstants, viewZScale)},
        {"disocclusionThreshold", offsetof(ReblurConstants, disocclusionThreshold)},
        {"disocclusionThresholdAlternate", offsetof(ReblurConstants, disocclusionThresholdAlternate)},
        {"planeDistanceSensitivity", offsetof(ReblurConstants, planeDistanceSensitivity)},
        {"maxAccumulatedFrameNum", offsetof(ReblurConstants, maxAccumulatedFrameNum)},
        {"maxFastAccumulatedFrameNum", offsetof(ReblurConstants, maxFastAccumulatedFrameNum)},
        {"historyFixFrameNum", offsetof(ReblurConstants, historyFixFrameNum)},
        {"minBlurRadius", offsetof(ReblurConstants, minBlurRadius)},
        {"maxBlurRadius", offsetof(ReblurConstants, maxBlurRadius)},
        {"diffusePrepassRadius", offsetof(ReblurConstants, diffusePrepassRadius)},
        {"specularPrepassRadius", offsetof(ReblurConstants, specularPrepassRadius)},
        {"lobeAngleFraction", offsetof(ReblurConstants, lobeAngleFraction)},
        {"roughnessFraction", offsetof(ReblurConstants, roughnessFraction)},
        {"minHitDistanceWeight", offsetof(ReblurConstants, minHitDistanceWeight)},
        {"historyFixStride", offsetof(ReblurConstants, historyFixStride)},
        {"historyFixAlternateStride", offsetof(ReblurConstants, historyFixAlternateStride)},
        {"fastClampSigmaScale", offsetof(ReblurConstants, fastClampSigmaScale)},
        {"fireflyMinScale", offsetof(ReblurConstants, fireflyMinScale)},
        {"antilagSigmaScale", offsetof(ReblurConstants, antilagSigmaScale)},
        {"antilagSensitivity", offsetof(ReblurConstants, antilagSensitivity)},
        {"stabilizationStrength", offsetof(ReblurConstants, stabilizationStrength)},
        {"frameRateScale", offsetof(ReblurConstants, frameRateScale)},
        {"responsiveRoughnessThreshold", offsetof(ReblurConstants, responsiveRoughnessThreshold)},
        {"responsiveMinFrameNum", offsetof(ReblurConstants, responsiveMinFrameNum)},
        {"splitScreen", offsetof(ReblurConstants, splitScreen)},
        {"splitScreenPrev", offsetof(ReblurConstants, splitScreenPrev)},
        {"strandThickness", offsetof(ReblurConstants, strandThickness)},
        {"strandMaterialID", offsetof(ReblurConstants, strandMaterialID)},
        {"cameraAttachedMaterialID", offsetof(ReblurConstants, cameraAttachedMaterialID)},
        {"historyFixAlternateMaterialID", offsetof(ReblurConstants, historyFixAlternateMaterialID)},
        {"minMaterialForDiffuse", offsetof(ReblurConstants, minMaterialForDiffuse)},
        {"minMaterialForSpecular", offsetof(ReblurConstants, minMaterialForSpecular)},
        {"frameIndex", offsetof(ReblurConstants, frameIndex)},
        {"isHistoryReset", offsetof(ReblurConstants, isHistoryReset)},
        {"isPrepassTrackingOnly", offsetof(ReblurConstants, isPrepassTrackingOnly)},
        {"returnHistoryLength", offsetof(ReblurConstants, returnHistoryLength)},
        {"hasValidation", offsetof(ReblurConstants, hasValidation)},
        {"isCutDetected", offsetof(ReblurConstants, isCutDetected)},
        {"checkerboard", offsetof(ReblurConstants, checkerboard)},
        {"checkerboardResolve", offsetof(ReblurConstants, checkerboardResolve)},
        {"reconstructionRadius", offsetof(ReblurConstants, reconstructionRadius)},
    };
    const Member reference[] = {
        {"rectSize", offsetof(ReferenceConstants, rectSize)},
        {"splitScreen", offsetof(ReferenceConstants, splitScreen)},
        {"weight", offsetof(ReferenceConstants, weight)},
    };
    checkMembers(Shader::ReblurBlurDiffuseSpecular, "ReblurConstants", reblur);
    checkMembers(Shader::ReferenceAccumulate, "ReferenceConstants", reference);
}
