// What must hold of every table, whatever the family: checked over every variant and combination of settings.
#include "compiled.h"
#include "denoisers/families.h"
#include "expand.h"
#include "fixture.h"
#include <set>

using namespace test;

namespace
{
struct Case
{
    Program program;
    CommonSettings common;
    FamilySettings settings;
    std::string text;

    Conditions conditions() const { return {common, settings, NormalEncoding::R10_G10_B10_A2_UNORM, *program.variant}; }
};

// Bits of the combinations of settings on which the tables depend.
void applyBits(Case& c, uint32_t bits)
{
    c.common.isHistoryConfidenceAvailable = bits & 1;
    c.common.isDisocclusionThresholdMixAvailable = bits & 2;
    c.common.splitScreen = (bits & 4) ? 0.5f : 0.0f;
    c.common.enableCutDetection = (bits & 128) == 0;
    c.common.enableValidation = bits & 256;
    c.common.isSpecularMotionAvailable = bits & 512;
    if (ReblurSettings* reblur = std::get_if<ReblurSettings>(&c.settings))
    {
        if (bits & 8) reblur->diffusePrepassBlurRadius = reblur->specularPrepassBlurRadius = 0.0f;
        if (bits & 16) reblur->maxStabilizedFrameNum = 0;
        if (bits & 32) reblur->enableAntiFirefly = false;
        if (bits & 64) reblur->hitDistanceReconstructionMode = HitDistanceReconstructionMode::AREA_3X3;
    }
    if (RelaxSettings* relax = std::get_if<RelaxSettings>(&c.settings))
    {
        if (bits & 8) relax->prePassMode = PrePassMode::OFF;
        relax->atrousIterationNum = 2 + (bits >> 4) % 7;
    }
    if (ConfidenceSettings* confidence = std::get_if<ConfidenceSettings>(&c.settings))
        confidence->blurPassNum = (bits >> 4) % 6;
    c.text = std::string(nameOf(*c.program.variant)) + " with settings " + std::to_string(bits);
}

std::vector<const Family*> allTables()
{
    std::vector<const Family*> tables(std::begin(kFamilies), std::end(kFamilies));
    tables.push_back(&kHistoryConfidence);
    return tables;
}

// Confidence is an input of the denoisers, and made by a table of its own.
bool isOutput(const Binding& binding, const Variant& variant)
{
    if (variant.key == Denoiser::MAX_NUM)
        return binding.type == ResourceType::IN_DIFF_CONFIDENCE || binding.type == ResourceType::IN_SPEC_CONFIDENCE;
    return binding.type >= ResourceType::OUT_DIFF_RADIANCE_HITDIST && binding.type <= ResourceType::OUT_VALIDATION;
}

std::vector<Case> allCases()
{
    std::vector<Case> cases;
    for (const Family* family : allTables())
    {
        for (size_t variant = 0; variant < family->variants.size(); variant++)
        {
            for (uint32_t bits = 0; bits < 1024; bits++)
            {
                Case c = {expand({family, variant}, NormalEncoding::R10_G10_B10_A2_UNORM), makeCommon(),
                          family->defaults, ""};
                applyBits(c, bits);
                cases.push_back(c);
            }
        }
    }
    return cases;
}

using Key = std::pair<uint32_t, bool>; // texture, previous

bool isTransient(const Program& program, const Binding& binding)
{
    return program.textures[binding.texture].isTransient();
}

std::vector<Program> allPrograms()
{
    std::vector<Program> programs;
    for (const Family* family : allTables())
    {
        for (size_t variant = 0; variant < family->variants.size(); variant++)
            programs.push_back(expand({family, variant}, NormalEncoding::R10_G10_B10_A2_UNORM));
    }
    return programs;
}
} // namespace

TEST_CASE("a pass reads of the transient textures only what an earlier pass of the request wrote", "[unit]")
{
    for (const Case& c : allCases())
    {
        INFO(c.text);
        std::set<uint32_t> written;
        for (const Pass& pass : c.program.passes)
        {
            if (!pass.row->runsIf(c.conditions())) continue;
            INFO(pass.row->name);
            for (const BoundSlot& slot : pass.reads)
            {
                const Binding& binding = slot.pick(c.conditions());
                if (!binding.isTexture() || !isTransient(c.program, binding)) continue;
                INFO(c.program.textures[binding.texture].row->name);
                REQUIRE(written.count(binding.texture) == 1);
            }
            for (const BoundSlot& slot : pass.writes)
            {
                const Binding& binding = slot.pick(c.conditions());
                if (binding.isTexture()) written.insert(binding.texture);
            }
        }
    }
}

TEST_CASE("history that a request reads is renewed by the same request", "[unit]")
{
    for (const Case& c : allCases())
    {
        INFO(c.text);
        std::set<Key> read, written;
        for (const Pass& pass : c.program.passes)
        {
            if (!pass.row->runsIf(c.conditions())) continue;
            for (const BoundSlot& slot : pass.reads)
            {
                const Binding& b = slot.pick(c.conditions());
                if (b.isTexture() && !isTransient(c.program, b)) read.insert({b.texture, b.isPrevious});
            }
            for (const BoundSlot& slot : pass.writes)
            {
                const Binding& b = slot.pick(c.conditions());
                if (b.isPrevious) continue; // history that was read serves as a step between passes
                if (b.isTexture()) written.insert({b.texture, false});
            }
        }
        for (const Key& key : read)
        {
            INFO(c.program.textures[key.first].row->name);
            CHECK(written.count({key.first, false}) == 1);
        }
    }
}

TEST_CASE("inputs are read and never written, outputs read only once the same request has written them", "[unit]")
{
    for (const Case& c : allCases())
    {
        INFO(c.text);
        std::set<ResourceType> written;
        for (const Pass& pass : c.program.passes)
        {
            if (!pass.row->runsIf(c.conditions())) continue;
            for (const BoundSlot& slot : pass.reads)
            {
                const Binding& binding = slot.pick(c.conditions());
                if (binding.isTexture() || !isOutput(binding, *c.program.variant)) continue;
                INFO(pass.row->name << " reads " << toString(binding.type));
                CHECK(written.count(binding.type) == 1);
            }
            for (const BoundSlot& slot : pass.writes)
            {
                const Binding& binding = slot.pick(c.conditions());
                if (binding.isTexture()) continue;
                CHECK(isOutput(binding, *c.program.variant));
                written.insert(binding.type);
            }
        }
        for (const SignalRow& signal : c.program.variant->signals) CHECK(written.count(signal.output) == 1);
    }
}

TEST_CASE("every texture of a variant is bound by a pass, and only ping-pong textures have a previous one", "[unit]")
{
    for (const Program& program : allPrograms())
    {
        INFO(nameOf(*program.variant));
        for (size_t i = 0; i < program.textures.size(); i++)
        {
            INFO(program.textures[i].row->name);
            CHECK(lifeOf(program, i).isBound);
            CHECK(program.textures[i].format < Format::MAX_NUM);
        }
        for (const Pass& pass : program.passes)
        {
            for (const BoundSlot& slot : pass.reads)
            {
                for (const BoundChoice& choice : slot.choices)
                {
                    if (!choice.binding.isPrevious) continue;
                    CHECK(program.textures[choice.binding.texture].row->lifetime == Lifetime::PingPong);
                }
            }
        }
    }
}

TEST_CASE("a texture read at other pixels is not written by the same pass", "[unit]")
{
    // Four passes read and write one place, each invocation its own texel.
    const std::set<std::string> inPlace = {"Temporal accumulation", "Temporal stabilization", "Post-blur",
                                           "Accumulate"};
    for (const Case& c : allCases())
    {
        INFO(c.text);
        for (const Pass& pass : c.program.passes)
        {
            if (!pass.row->runsIf(c.conditions())) continue;
            for (const BoundSlot& read : pass.reads)
            {
                for (const BoundSlot& write : pass.writes)
                {
                    const Binding& binding = read.pick(c.conditions());
                    if (!(binding == write.pick(c.conditions()))) continue;
                    INFO(pass.row->name);
                    CHECK(inPlace.count(pass.row->name) == 1);
                }
            }
        }
    }
}

TEST_CASE("textures that share a place in the transient pool are never alive together", "[unit]")
{
    std::vector<DenoiserDesc> descs;
    const LibraryDesc& library = GetLibraryDesc();
    for (uint32_t i = 0; i < 2 * library.supportedDenoisersNum; i++) // two of each
        descs.push_back({i, library.supportedDenoisers[i / 2]});
    InstanceCreationDesc desc;
    desc.denoisers = descs.data();
    desc.denoisersNum = static_cast<uint32_t>(descs.size());
    Compiled compiled(std::pmr::new_delete_resource());
    compile(desc, compiled);
    for (const CompiledDenoiser& denoiser : compiled.denoisers)
    {
        const Program& program = denoiser.program;
        for (size_t i = 0; i < program.textures.size(); i++)
        {
            const PoolPlace& place = denoiser.places[i];
            if (place.pool != ResourceType::TRANSIENT_POOL) continue;
            CHECK(compiled.transientPool[place.index].format == program.textures[i].format);
            CHECK(compiled.transientPool[place.index].downsampleFactor == program.textures[i].row->downsampleFactor);
            for (size_t j = 0; j < i; j++)
            {
                const PoolPlace& other = denoiser.places[j];
                if (other.pool != place.pool || other.index != place.index) continue;
                const Life a = lifeOf(program, i), b = lifeOf(program, j);
                CHECK((a.last < b.first || b.last < a.first));
            }
        }
    }
}

TEST_CASE("the guide's copy has the format of the encoding", "[unit]")
{
    for (uint32_t i = 0; i < static_cast<uint32_t>(NormalEncoding::MAX_NUM); i++)
    {
        const NormalEncoding encoding = static_cast<NormalEncoding>(i);
        const Program program = expand(findVariant(kReblurBoth), encoding);
        size_t num = 0;
        for (const Texture& texture : program.textures)
        {
            if (texture.row->format.rule != FormatRule::PrevGuide) continue;
            CHECK(texture.format == guideFormat(encoding));
            num++;
        }
        CHECK(num == 1);
    }
}

TEST_CASE("memory per pixel of REBLUR_DIFFUSE_SPECULAR stays within 51 bytes", "[unit]")
{
    const InstancePtr instance = makeInstance({kReblurBoth});
    const InstanceDesc& desc = GetInstanceDesc(*instance);
    const auto bytesPerPixel = [](const TextureDesc* pool, uint32_t num)
    {
        double sum = 0.0;
        for (uint32_t i = 0; i < num; i++)
        {
            const double factor = pool[i].downsampleFactor; // 65535 for a single texel
            sum += texelByteSize(pool[i].format) / (factor * factor);
        }
        return sum;
    };
    const double permanent = bytesPerPixel(desc.permanentPool, desc.permanentPoolSize);
    const double transient = bytesPerPixel(desc.transientPool, desc.transientPoolSize);
    WARN("REBLUR_DIFFUSE_SPECULAR: " << permanent << " permanent + " << transient
                                     << " transient = " << permanent + transient << " bytes per pixel");
    CHECK(permanent == Approx(36.125)); // the last eighth for four texels per tile
    CHECK(permanent + transient < 51.0);
}
