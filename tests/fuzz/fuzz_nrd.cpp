// Every public call of the library in any order, with arbitrary values in every field and null wherever it is allowed.
#include "arbitrary_instance.h"
#include "arbitrary_settings.h"
#include "dispatch_promises.h"
#include "fuzz.h"
#include "valid_settings.h"

namespace
{
using fuzz::ByteReader;
using fuzz::kIdentifierNum;
using fuzz::require;
using namespace nrd;

class Calls
{
public:
    explicit Calls(ByteReader& reader) : m_reader(reader) {}
    ~Calls() { DestroyInstance(m_instance); }
    Calls(const Calls&) = delete;
    Calls& operator=(const Calls&) = delete;

    void callSomething();
    void expectUsable(); // after whatever was refused

private:
    void create();
    void setCommon();
    void setDenoiser();
    void dispatch();
    void getRequirements(Identifier identifier);
    void check(Result result, bool isRefusalExplained = true);

    ByteReader& m_reader;
    Instance* m_instance = nullptr;
    sample::ReplaySettings m_settings = {test::makeCommon(), {}, {}, {}, {}, {}};
    uint32_t m_reportNum = 0;
};

void Calls::check(Result result, bool isRefusalExplained)
{
    fuzz::countCall();
    require(result < Result::MAX_NUM, "a result is one of the enumeration");
    const bool isRefused = result != Result::SUCCESS;
    if (isRefusalExplained) require(isRefused == (m_reportNum == 1), "one sentence for a refused call, else none");
    if (isRefused && m_instance) require(*GetLastMessage(*m_instance) != 0, "a refused call is explained");
    m_reportNum = 0;
}

void Calls::create()
{
    DestroyInstance(m_instance);
    fuzz::ArbitraryInstance arbitrary;
    fuzz::makeArbitrary(arbitrary, m_reader, m_reportNum);
    const Result result = CreateInstance(arbitrary.desc, m_instance);
    require((result == Result::SUCCESS) == (m_instance != nullptr), "an instance comes with success only");
    check(result);
}

void Calls::setCommon()
{
    if (m_reader.below(4) == 0) m_settings.common = test::makeCommon();
    fuzz::changeSettings(m_settings, sample::Family::None, m_reader);
    check(SetCommonSettings(*m_instance, m_settings.common));
}

void Calls::setDenoiser()
{
    const Identifier identifier = fuzz::arbitraryIdentifier(m_reader);
    const auto family = static_cast<sample::Family>(1 + m_reader.below(4));
    if (m_reader.below(4) == 0) m_settings = {m_settings.common, {}, {}, {}, {}, {}};
    fuzz::changeSettings(m_settings, family, m_reader);
    check(sample::setDenoiserSettings(m_settings, family,
                                      [&](const auto& settings)
                                      { return SetDenoiserSettings(*m_instance, identifier, settings); }));
}

void Calls::dispatch()
{
    Identifier identifiers[kIdentifierNum];
    for (Identifier& identifier : identifiers) identifier = fuzz::arbitraryIdentifier(m_reader);
    // Long lists nearly always name a stranger or repeat one; short ones get through.
    const uint32_t identifierNum = m_reader.flag() ? m_reader.below(2) : m_reader.below(kIdentifierNum + 1);
    const DispatchDesc* dispatches = nullptr;
    uint32_t dispatchNum = 0;
    const Result result = GetComputeDispatches(*m_instance, m_reader.below(16) == 0 ? nullptr : identifiers,
                                               identifierNum, dispatches, dispatchNum);
    check(result);
    if (result != Result::SUCCESS) return;
    for (uint32_t i = 0; i < dispatchNum; i++) fuzz::checkDispatch(GetInstanceDesc(*m_instance), dispatches[i]);
}

void Calls::getRequirements(Identifier identifier)
{
    const ResourceRequirement* requirements = nullptr;
    uint32_t requirementNum = 0;
    const Result result = GetRequiredResources(*m_instance, identifier, requirements, requirementNum);
    check(result, false); // a const call may tell its refusal by its result alone
    if (result != Result::SUCCESS) return;
    for (uint32_t i = 0; i < requirementNum; i++)
        require(requirements[i].type < ResourceType::TRANSIENT_POOL && requirements[i].minFormat < Format::MAX_NUM,
                "a requirement is a slot of the user pool with a format");
}

void Calls::callSomething()
{
    const uint32_t call = m_reader.below(16);
    if (!m_instance || call == 0)
        create();
    else if (call < 5)
        setCommon();
    else if (call < 9)
        setDenoiser();
    else if (call < 14)
        dispatch();
    else
        getRequirements(fuzz::arbitraryIdentifier(m_reader));
}

void Calls::expectUsable()
{
    if (!m_instance) return;
    check(SetCommonSettings(*m_instance, test::makeCommon()));
    const InstanceDesc& desc = GetInstanceDesc(*m_instance);
    for (uint32_t i = 0; i < desc.denoisersNum; i++)
    {
        const DispatchDesc* dispatches = nullptr;
        uint32_t num = 0;
        const Result result = GetComputeDispatches(*m_instance, &desc.denoisers[i].identifier, 1, dispatches, num);
        require(result == Result::SUCCESS && num > 0, "a refused call leaves an instance that denoises");
        check(result);
    }
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    ByteReader reader(bytes, size);
    Calls calls(reader);
    while (!reader.isEmpty()) calls.callSomething();
    calls.expectUsable();
    return 0;
}
