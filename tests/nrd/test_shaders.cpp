// The tables against the SPIR-V that was built: bindings, group sizes, switches, constants.
#include "bindings.h"
#include "confidence_constants.h"
#include "denoiser_constants.h"
#include "denoisers/families.h"
#include "expand.h"
#include "fixture.h"
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
        const FormatRule rule = texture.row->format.rule;
        const bool isPerSignal = rule == FormatRule::PerSignal || rule == FormatRule::PerOutput;
        return isPerSignal ? &signals[texture.signal] : nullptr;
    }
    for (const SignalRow& signal : signals)
    {
        if (signal.input == binding.type || signal.output == binding.type) return &signal;
    }
    return nullptr;
}

// One texture that lies in the first signal's output until the result takes its place.
bool isLent(const Program& program, const std::string& name)
{
    const auto& rows = program.family->textures;
    return std::any_of(rows.begin(), rows.end(),
                       [&](const TextureRow& row)
                       {
                           return row.lifetime == Lifetime::Lent && row.format.rule != FormatRule::PerSignal &&
                                  has(*program.variant, row.having) && normalize(row.name) == name;
                       });
}

// What is bound per signal is named after its lobe; everything else after the slot.
void checkName(const Program& program, const Binding& binding, const std::string& shaderName)
{
    const std::string name = normalize(shaderName);
    const auto begins = [&](const char* word) { return name.rfind(word, 0) == 0; };
    if (begins("signal") || begins("first") || begins("second")) return; // resampled, whatever it is
    const SignalRow* signal = findSignal(program, binding);
    if (isLent(program, name))
    {
        CHECK(signal == &program.variant->signals[0]);
        return;
    }
    if (signal && signal->lobe != kNoLobe)
    {
        CHECK_THAT(name, containing(signal->lobe == kDiffuse ? "diff" : "spec"));
        return;
    }
    const bool isTexture = binding.isTexture();
    if (signal && isTexture) // SIGMA's, on its way to the output
    {
        CHECK(name == normalize(toString(signal->output)));
        return;
    }
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
        checkName(program, slots[i].choices[0].binding, found->name);
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
    const bool isTileGroup = pass.row->group.x % TILE_SIZE == 0 && module.localSize[0] < TILE_SIZE;
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
    CHECK(unreadNum <= 2); // the second textures of spherical harmonics, where luma is all that is asked for
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
    std::vector<const Family*> tables(std::begin(kFamilies), std::end(kFamilies));
    tables.push_back(&kHistoryConfidence);
    for (const Family* family : tables)
    {
        for (size_t variant = 0; variant < family->variants.size(); variant++)
        {
            for (FullSize fullSize : {FullSize::NOTHING, FullSize::GUIDES_AND_OUTPUTS, FullSize::EVERYTHING})
            {
                const Variant& v = family->variants[variant];
                const bool isResampled = v.signals.size() > 0 && v.key != Denoiser::REFERENCE;
                if (!isResampled && fullSize != FullSize::NOTHING) continue;
                if (v.lobes == kNoLobe && fullSize == FullSize::EVERYTHING) continue; // SIGMA
                const Program program = expand({family, variant}, NormalEncoding::R10_G10_B10_A2_UNORM, fullSize);
                for (const Pass& pass : program.passes) checkPass(program, pass);
            }
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
    using shared::ConfidenceConstants;
    using shared::DenoiserConstants;
    using shared::ReferenceConstants;
    const Member both[] = {
        {"worldToClip", offsetof(DenoiserConstants, worldToClip)},
        {"worldToClipPrev", offsetof(DenoiserConstants, worldToClipPrev)},
        {"worldToViewPrev", offsetof(DenoiserConstants, worldToViewPrev)},
        {"viewToWorld", offsetof(DenoiserConstants, viewToWorld)},
        {"viewToWorldPrev", offsetof(DenoiserConstants, viewToWorldPrev)},
        {"frustum", offsetof(DenoiserConstants, frustum)},
        {"frustumPrev", offsetof(DenoiserConstants, frustumPrev)},
        {"cameraDelta", offsetof(DenoiserConstants, cameraDelta)},
        {"viewDirection", offsetof(DenoiserConstants, viewDirection)},
        {"cameraPosition", offsetof(DenoiserConstants, cameraPosition)},
        {"cameraJitter", offsetof(DenoiserConstants, cameraJitter)},
        {"rotatorPrePass", offsetof(DenoiserConstants, rotatorPrePass)},
        {"rotatorBlur", offsetof(DenoiserConstants, rotatorBlur)},
        {"rotatorPostBlur", offsetof(DenoiserConstants, rotatorPostBlur)},
        {"hitDistanceParameters", offsetof(DenoiserConstants, hitDistanceParameters)},
        {"motionVectorScale", offsetof(DenoiserConstants, motionVectorScale)},
        {"relaxDoubt", offsetof(DenoiserConstants, relaxDoubt)},
        {"relaxAntilag", offsetof(DenoiserConstants, relaxAntilag)},
        {"sigmaLight", offsetof(DenoiserConstants, sigmaLight)},
        {"rectSize", offsetof(DenoiserConstants, rectSize)},
        {"rectSizeInv", offsetof(DenoiserConstants, rectSizeInv)},
        {"rectSizePrev", offsetof(DenoiserConstants, rectSizePrev)},
        {"resourceSizeInv", offsetof(DenoiserConstants, resourceSizeInv)},
        {"resourceSizeInvPrev", offsetof(DenoiserConstants, resourceSizeInvPrev)},
        {"relaxPhi", offsetof(DenoiserConstants, relaxPhi)},
        {"relaxMaxLumaStop", offsetof(DenoiserConstants, relaxMaxLumaStop)},
        {"relaxEdgeRelaxation", offsetof(DenoiserConstants, relaxEdgeRelaxation)},
        {"maxAccumulatedFrameNum", offsetof(DenoiserConstants, maxAccumulatedFrameNum)},
        {"maxFastAccumulatedFrameNum", offsetof(DenoiserConstants, maxFastAccumulatedFrameNum)},
        {"convergence", offsetof(DenoiserConstants, convergence)},
        {"rectOrigin", offsetof(DenoiserConstants, rectOrigin)},
        {"rectSizeMinusOne", offsetof(DenoiserConstants, rectSizeMinusOne)},
        {"fullRectSizeMinusOne", offsetof(DenoiserConstants, fullRectSizeMinusOne)},
        {"convergenceLengthInv", offsetof(DenoiserConstants, convergenceLengthInv)},
        {"unproject", offsetof(DenoiserConstants, unproject)},
        {"minRectDim", offsetof(DenoiserConstants, minRectDim)},
        {"denoisingRange", offsetof(DenoiserConstants, denoisingRange)},
        {"viewZScale", offsetof(DenoiserConstants, viewZScale)},
        {"disocclusionThreshold", offsetof(DenoiserConstants, disocclusionThreshold)},
        {"disocclusionThresholdAlternate", offsetof(DenoiserConstants, disocclusionThresholdAlternate)},
        {"planeDistanceSensitivity", offsetof(DenoiserConstants, planeDistanceSensitivity)},
        {"historyFixFrameNum", offsetof(DenoiserConstants, historyFixFrameNum)},
        {"minBlurRadius", offsetof(DenoiserConstants, minBlurRadius)},
        {"maxBlurRadius", offsetof(DenoiserConstants, maxBlurRadius)},
        {"diffusePrepassRadius", offsetof(DenoiserConstants, diffusePrepassRadius)},
        {"specularPrepassRadius", offsetof(DenoiserConstants, specularPrepassRadius)},
        {"lobeAngleFraction", offsetof(DenoiserConstants, lobeAngleFraction)},
        {"roughnessFraction", offsetof(DenoiserConstants, roughnessFraction)},
        {"minHitDistanceWeight", offsetof(DenoiserConstants, minHitDistanceWeight)},
        {"historyFixStride", offsetof(DenoiserConstants, historyFixStride)},
        {"historyFixAlternateStride", offsetof(DenoiserConstants, historyFixAlternateStride)},
        {"fastClampSigmaScale", offsetof(DenoiserConstants, fastClampSigmaScale)},
        {"fireflyMinScale", offsetof(DenoiserConstants, fireflyMinScale)},
        {"fireflyHeadroom", offsetof(DenoiserConstants, fireflyHeadroom)},
        {"fireflyStrictness", offsetof(DenoiserConstants, fireflyStrictness)},
        {"antilagSigmaScale", offsetof(DenoiserConstants, antilagSigmaScale)},
        {"antilagSensitivity", offsetof(DenoiserConstants, antilagSensitivity)},
        {"stabilizationStrength", offsetof(DenoiserConstants, stabilizationStrength)},
        {"frameRateScale", offsetof(DenoiserConstants, frameRateScale)},
        {"responsiveRoughnessThreshold", offsetof(DenoiserConstants, responsiveRoughnessThreshold)},
        {"responsiveMinFrameNum", offsetof(DenoiserConstants, responsiveMinFrameNum)},
        {"splitScreen", offsetof(DenoiserConstants, splitScreen)},
        {"splitScreenPrev", offsetof(DenoiserConstants, splitScreenPrev)},
        {"strandThickness", offsetof(DenoiserConstants, strandThickness)},
        {"relaxLobeAngle", offsetof(DenoiserConstants, relaxLobeAngle)},
        {"relaxLobeAngleSlack", offsetof(DenoiserConstants, relaxLobeAngleSlack)},
        {"relaxDepthThreshold", offsetof(DenoiserConstants, relaxDepthThreshold)},
        {"relaxFixNormalPower", offsetof(DenoiserConstants, relaxFixNormalPower)},
        {"relaxViewRelaxation", offsetof(DenoiserConstants, relaxViewRelaxation)},
        {"relaxVarianceBoost", offsetof(DenoiserConstants, relaxVarianceBoost)},
        {"relaxSpatialVarianceFrameNum", offsetof(DenoiserConstants, relaxSpatialVarianceFrameNum)},
        {"relaxRoughnessStop", offsetof(DenoiserConstants, relaxRoughnessStop)},
        {"strandMaterialID", offsetof(DenoiserConstants, strandMaterialID)},
        {"cameraAttachedMaterialID", offsetof(DenoiserConstants, cameraAttachedMaterialID)},
        {"historyFixAlternateMaterialID", offsetof(DenoiserConstants, historyFixAlternateMaterialID)},
        {"minMaterialForDiffuse", offsetof(DenoiserConstants, minMaterialForDiffuse)},
        {"minMaterialForSpecular", offsetof(DenoiserConstants, minMaterialForSpecular)},
        {"frameIndex", offsetof(DenoiserConstants, frameIndex)},
        {"isHistoryReset", offsetof(DenoiserConstants, isHistoryReset)},
        {"isPrepassTrackingOnly", offsetof(DenoiserConstants, isPrepassTrackingOnly)},
        {"returnHistoryLength", offsetof(DenoiserConstants, returnHistoryLength)},
        {"hasValidation", offsetof(DenoiserConstants, hasValidation)},
        {"isCutDetected", offsetof(DenoiserConstants, isCutDetected)},
        {"hasDisocclusionMix", offsetof(DenoiserConstants, hasDisocclusionMix)},
        {"isCapped", offsetof(DenoiserConstants, isCapped)},
        {"checkerboard", offsetof(DenoiserConstants, checkerboard)},
        {"checkerboardResolve", offsetof(DenoiserConstants, checkerboardResolve)},
        {"reconstructionRadius", offsetof(DenoiserConstants, reconstructionRadius)},
        {"guideStride", offsetof(DenoiserConstants, guideStride)},
        {"signalStride", offsetof(DenoiserConstants, signalStride)},
    };
    const Member reference[] = {
        {"rectSize", offsetof(ReferenceConstants, rectSize)},
        {"splitScreen", offsetof(ReferenceConstants, splitScreen)},
        {"weight", offsetof(ReferenceConstants, weight)},
    };
    const Member confidence[] = {
        {"viewToWorldPrev", offsetof(ConfidenceConstants, viewToWorldPrev)},
        {"frustumPrev", offsetof(ConfidenceConstants, frustumPrev)},
        {"rectSizePrev", offsetof(ConfidenceConstants, rectSizePrev)},
        {"outputSizeInv", offsetof(ConfidenceConstants, outputSizeInv)},
        {"isOrthographic", offsetof(ConfidenceConstants, isOrthographic)},
        {"planeDistance", offsetof(ConfidenceConstants, planeDistance)},
        {"denoisingRange", offsetof(ConfidenceConstants, denoisingRange)},
        {"viewZScale", offsetof(ConfidenceConstants, viewZScale)},
        {"minLuminance", offsetof(ConfidenceConstants, minLuminance)},
        {"maxLuminance", offsetof(ConfidenceConstants, maxLuminance)},
        {"tolerance", offsetof(ConfidenceConstants, tolerance)},
        {"sensitivity", offsetof(ConfidenceConstants, sensitivity)},
        {"isHistoryReset", offsetof(ConfidenceConstants, isHistoryReset)},
    };
    checkMembers(Shader::ConfidenceBlur, "ConfidenceConstants", confidence);
    checkMembers(Shader::ReblurBlurDiffuseSpecular, "DenoiserConstants", both);
    checkMembers(Shader::ReferenceAccumulate, "ReferenceConstants", reference);
}
