// The language in which a denoiser is written down: textures, passes and variants as rows of constant tables.
// A family (denoisers/*.cpp) has one table of each; expand() turns a variant into concrete passes.
#pragma once
#include "fixed_list.h"
#include "nrd_shaders.h"
#include <nrd/settings.h>
#include <span>
#include <type_traits>
#include <variant>

namespace nrd
{
// Row i describes key i: a swapped or forgotten row does not compile.
template <class Rows> constexpr bool rowsMatchKeys(const Rows& rows)
{
    size_t i = 0;
    for (const auto& row : rows)
    {
        if (static_cast<size_t>(row.key) != i++) return false;
    }
    return true;
}

enum Lobes : uint8_t
{
    kNoLobe = 0,
    kDiffuse = 1,
    kSpecular = 2,
    kBoth = kDiffuse | kSpecular
};

// One alternative per family; the family's default is what a new denoiser starts with.
using FamilySettings =
    std::variant<ReblurSettings, RelaxSettings, SigmaSettings, ReferenceSettings, ConfidenceSettings>;

// What a signal consists of. One value for a variant, several for what a row applies to.
enum Kinds : uint8_t
{
    kAnyKind = 0,
    kRadiance = 1,             // colour and hit distance
    kSphericalHarmonics = 2,   // the same, and a direction
    kOcclusion = 4,            // hit distance
    kDirectionalOcclusion = 8, // hit distance and a direction
    kShadow = 16,              // visibility of a light
    kTranslucentShadow = 32,   // the same, and the colour that comes through
    kColor = kRadiance | kSphericalHarmonics,
    kBounded = kOcclusion | kDirectionalOcclusion, // in [0; 1]
    kStabilized = kColor | kDirectionalOcclusion
};

enum class Keeps : uint8_t // from frame to frame
{
    Any, // of rows: whatever the variant keeps
    History,
    Nothing
};

// The variants a row applies to: those that have one of the lobes, are of one of the kinds, and keep as much.
struct Having
{
    constexpr Having() = default;
    constexpr Having(Lobes l) : lobes(l) {}
    constexpr Having(Kinds k) : kinds(k) {}
    constexpr Having(Lobes l, Kinds k) : lobes(l), kinds(k) {}
    constexpr Having(Keeps keep, Kinds k = kAnyKind) : kinds(k), keeps(keep) {}

    Lobes lobes = kNoLobe;  // kNoLobe = whatever the lobes
    Kinds kinds = kAnyKind; // kAnyKind = whatever the kind
    Keeps keeps = Keeps::Any;
};

struct Variant;

// What the conditions of a table may depend on.
struct Conditions
{
    const CommonSettings& common;
    const FamilySettings& settings;
    NormalEncoding normalEncoding;
    const Variant& variant;
};
using Predicate = bool (*)(const Conditions&);

// A texture of the user pool, or of the family's texture table; the signals differ by variant.
enum class Source : uint8_t
{
    User,
    Table,
    SignalInput,
    SignalOutput,
    UserInput, // the user's, also where signals are averaged before they are denoised
    UserOutput // the user's, also where results are upsampled on their way there
};

struct Place
{
    Source source = Source::User;
    uint8_t index = 0;       // ResourceType or texture key
    bool isPrevious = false; // of a ping-pong pair: what the last request wrote
    bool isEach = false;     // one texture per signal of the variant
};

struct Choice
{
    Place place;
    Predicate isUsed = nullptr; // null = always
};

// What is bound: the first choice that is used. Either all of them are per signal, or none is.
struct Slot
{
    constexpr Slot() = default;
    constexpr Slot(Place place) : choices{{place}} {}
    constexpr Slot(ResourceType type) : Slot(Place{Source::User, static_cast<uint8_t>(type)}) {}
    template <class Key>
    requires std::is_enum_v<Key>
    constexpr Slot(Key key) : Slot(Place{Source::Table, static_cast<uint8_t>(key)}) {}

    FixedList<Choice, 3> choices;
    Having having;
};

// The five words of the pass tables, besides plain keys and resource types.
template <class Key> constexpr Place prev(Key key) { return {Source::Table, static_cast<uint8_t>(key), true, false}; }
template <class Key> constexpr Place prevEach(Key key)
{
    return {Source::Table, static_cast<uint8_t>(key), true, true};
}
template <class Key> constexpr Place each(Key key) { return {Source::Table, static_cast<uint8_t>(key), false, true}; }
constexpr Place kEachInput = {Source::SignalInput, 0, false, true};
constexpr Place kEachOutput = {Source::SignalOutput, 0, false, true};

constexpr Slot only(Having having, Slot slot)
{
    slot.having = having;
    return slot;
}
constexpr Slot choose(Predicate condition, Slot slot, const Slot& otherwise)
{
    slot.choices[slot.choices.size() - 1].isUsed = condition;
    for (const Choice& choice : otherwise.choices) slot.choices.push(choice);
    return slot;
}
// Nothing is partially bound: an input that is not there is replaced by one that always is.
constexpr Slot optional(Predicate condition, Slot slot)
{
    return choose(condition, slot, Place{Source::User, static_cast<uint8_t>(ResourceType::IN_VIEWZ)});
}

enum class FormatRule : uint8_t
{
    Fixed,     // first
    PerLobes,  // one scalar per lobe in one texture: first for one lobe, second for two
    Luma,      // the same, half floats for colour, 8 bits for what lies in [0; 1]
    PerSignal, // one texture per signal of the variant, in the signal's format
    PerOutput, // the same, in a format that holds what the signal's output does
    PrevGuide  // as IN_NORMAL_ROUGHNESS; 16 bits where diffuse light alone needs it
};

struct TextureFormat
{
    FormatRule rule = FormatRule::Fixed;
    Format first = Format::MAX_NUM;
    Format second = Format::MAX_NUM;
};
constexpr TextureFormat fixed(Format format) { return {FormatRule::Fixed, format, format}; }
constexpr TextureFormat perLobes(Format one, Format two) { return {FormatRule::PerLobes, one, two}; }
constexpr TextureFormat kLuma = {FormatRule::Luma, Format::MAX_NUM, Format::MAX_NUM};
constexpr TextureFormat kPerSignal = {FormatRule::PerSignal, Format::MAX_NUM, Format::MAX_NUM};
constexpr TextureFormat kPrevGuide = {FormatRule::PrevGuide, Format::MAX_NUM, Format::MAX_NUM};

enum class Lifetime : uint8_t
{
    Transient, // from its first pass to its last within a request
    Lent,      // the same, in the output of its signal where SignalRow::lendsOutput says so
    Permanent, // history
    PingPong   // history, a pair that changes places with every request
};

struct TextureRow
{
    uint8_t key;
    const char* name; // as in the shaders' bindings
    TextureFormat format;
    Lifetime lifetime;
    uint16_t downsampleFactor = 1;
    Having having = {};
};

constexpr uint16_t kOneTexel = 0xFFFF; // downsample factor that leaves a single texel of any size

// One noisy input and its denoised output. A variant has one per lobe, with spherical harmonics two.
struct SignalRow
{
    ResourceType input = ResourceType::MAX_NUM;
    ResourceType output = ResourceType::MAX_NUM;
    Format format = Format::MAX_NUM; // inside the denoiser
    Lobes lobe = kNoLobe;
    bool lendsOutput = false; // any output that serves can hold what is inside, until the result takes its place
};

struct Variant
{
    Denoiser key; // MAX_NUM: no denoiser
    Lobes lobes;
    Kinds kind;
    FixedList<SignalRow, 4> signals; // with a second texture per lobe, those come after the first ones
    Keeps keeps = Keeps::History;
};

constexpr bool has(const Variant& variant, Having needed)
{
    return (needed.lobes == kNoLobe || (variant.lobes & needed.lobes) != 0) &&
           (needed.kinds == kAnyKind || (variant.kind & needed.kinds) != 0) &&
           (needed.keeps == Keeps::Any || needed.keeps == variant.keeps);
}

// The shader of a pass for each variant to which the pass applies: enumerators from first to last, in the order of the
// family's variants, as the shader list declares them. One that is alone serves all of them.
struct ShaderSet
{
    constexpr ShaderSet(Shader one) : first(one), last(one) {}
    constexpr ShaderSet(Shader f, Shader l) : first(f), last(l) {}
    constexpr size_t size() const { return static_cast<size_t>(last) - static_cast<size_t>(first) + 1; }
    constexpr Shader operator[](size_t i) const
    {
        return static_cast<Shader>(static_cast<size_t>(first) + (size() == 1 ? 0 : i));
    }

    Shader first;
    Shader last;
};

struct SwitchRow
{
    uint32_t constantId = 0; // SPEC_..., a bool in the shader
    Predicate isOn = nullptr;
    Having having = {};
};

struct GroupSize
{
    uint8_t x, y; // texels of the grid that one group covers
};

struct PassRow
{
    const char* name;
    ShaderSet shaders;
    FixedList<Slot, 22> reads;  // binding order
    FixedList<Slot, 12> writes; // bindings go on
    GroupSize group;
    Predicate runsIf;
    FixedList<SwitchRow, 5> switches = {}; // each doubles the number of pipelines
    uint16_t gridFactor = 1;               // the grid covers ceil(rect / gridFactor)
    Having having = {};
    uint8_t step = 0;        // SPEC_STEP, for passes that run one shader several times
    bool isFullSize = false; // the grid covers the rectangle of the guides, also where signals are smaller
};

struct FrameState;

// What a denoiser remembers of its last request. Changed only by Family::advance and the instance.
struct RequestHistory
{
    uint32_t requestNum = 0;     // parity of the ping-pong pairs
    bool isCleared = false;      // its textures have been written at least once
    bool isValid = false;        // its last request left history behind
    bool isStabilized = false;   // ... including the stabilised one
    float splitScreen = 0.0f;    // of the last request
    uint32_t meanFrameNum = 0;   // frames in REFERENCE's mean, less one
    uint16_t rectSize[2] = {};   // of the last request
    double worldToClip[16] = {}; // of the last request
    float worldToView[16] = {};  // of the last request
};

struct Request
{
    const CommonSettings& common; // of the signals' size; on reset the previous values are the current ones
    const CommonSettings& full;   // of the guides' size, where signals are smaller
    const FamilySettings& settings;
    const FrameState& frame;
    const RequestHistory& history; // of the last request
    const Variant& variant;
    bool isReset;
    uint32_t guideStride;  // pixels of the guides from one pixel of the signals to the next
    uint32_t signalStride; // pixels of what the user hands over as a signal, likewise
};

constexpr size_t kConstantMaxByteSize = 1024;
constexpr size_t kConstantAlignment = 16;

// Passes of a family are shared by its variants; nothing below knows a denoiser by name.
struct Family
{
    FamilySettings defaults;
    std::span<const Variant> variants;
    std::span<const TextureRow> textures;
    std::span<const PassRow> passes;
    uint32_t constantByteSize;
    bool areOutputsCleared; // false where the output may be the same image as the input
    void (*fillConstants)(const Request& request, void* block); // block is zeroed
    RequestHistory (*advance)(const Request& request);          // the history after this request
    bool spansResource = false; // grids cover the resource whatever the rectangle: outputs are sampled over [0; 1]^2
};

// Every pass has one shader for all of its variants or exactly one for each.
constexpr bool shadersMatchVariants(std::span<const PassRow> passes, std::span<const Variant> variants)
{
    for (const PassRow& pass : passes)
    {
        size_t num = 0;
        for (const Variant& variant : variants) num += has(variant, pass.having) ? 1 : 0;
        if (pass.shaders.size() != 1 && pass.shaders.size() != num) return false;
    }
    return true;
}
} // namespace nrd
