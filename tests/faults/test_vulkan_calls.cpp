// Every call of Vulkan that can fail is made to fail, one at a time.
#include "catch.h"
#include "hooks.h"
#include "injection.h"
#include "long_form.h"
#include "sweep.h"
#include "validated_device.h"
#include <algorithm>
#include <cstdio>
#include <cstring>

using namespace faults;

namespace
{
// Names of objects are for debuggers: without them everything goes on.
bool isHarmless(const char* function) { return std::strcmp(function, "vkSetDebugUtilsObjectNameEXT") == 0; }

class VulkanInjector final : public Injector
{
public:
    explicit VulkanInjector(size_t variant) : m_variant(variant) {}
    void failNth(size_t n) override { faults::failNth(n, m_variant); }
    void stop() override { faults::stop(); }
    void attach(Session& session) override
    {
        session.make = [this, &session](const char* name, const Session::Call& call)
        {
            while (isFailing(session, name, call)) m_faultNum++;
        };
    }

private:
    bool isFailing(Session& session, const char* name, const Session::Call& call)
    {
        (void)takeFault();
        const Census before = census();
        const nrd::Result result = call();
        const Fault fault = takeFault();
        const std::string message = session.message();
        INFO(name << ", " << (fault.function ? fault.function : "no fault") << ", VkResult " << fault.result << ": "
                  << message);
        if (!fault.function)
            REQUIRE(result == nrd::Result::SUCCESS);
        else if (isHarmless(fault.function))
            REQUIRE(result == nrd::Result::SUCCESS);
        else
        {
            REQUIRE(result != nrd::Result::SUCCESS);
            CHECK(message == session.integration.GetLastMessage());
            CHECK(std::count(message.begin(), message.end(), '\'') >= 2); // the object by its name
            if (std::strcmp(name, "Create") == 0) CHECK(toString(census()) == toString(before));
            if (std::strcmp(name, "Create") == 0) CHECK_FALSE(session.integration.IsCreated());
        }
        m_faultNum += fault.function && isHarmless(fault.function);
        return fault.function && !isHarmless(fault.function);
    }

    size_t m_variant;
};

void requireNothingAlive()
{
    const Census now = census();
    INFO(toString(now));
    CHECK(now.alive.empty());
    CHECK(now.memoryBytes == 0);
    CHECK(now.foreign == 0);
    test::failOnMessages();
    for (const std::string& name : unhooked()) FAIL_CHECK("no hook for " << name);
}

using Sweep = void (*)(Injector&, const SessionDesc&);

size_t faultsIn(Sweep sweep, const SessionDesc& desc, size_t variant)
{
    VulkanInjector injector(variant);
    sweep(injector, desc);
    requireNothingAlive();
    return injector.faultNum();
}

size_t faultsIn(Sweep sweep)
{
    size_t faultNum = 0;
    size_t variant = 0;
    for (const SessionDesc& desc : allSets()) faultNum += faultsIn(sweep, desc, variant++);
    // Each call with each of its results.
    for (variant = 1; variant < (test::isLong() ? 3u : 1u); variant++) faultNum += faultsIn(sweep, smallSet(), variant);
    return faultNum;
}
} // namespace

TEST_CASE("every call of Vulkan that fails in Create comes back as a result, and nothing leaks", "[gpu]")
{
    size_t faultNum = faultsIn(sweepCreation);
    SessionDesc pipelines = smallSet();
    pipelines.denoisers = {nrd::Denoiser::REFERENCE};
    pipelines.createDefaultPipelines = true;
    faultNum += faultsIn(sweepCreation, pipelines, 0);
    std::printf("FIGURE Faults of Vulkan in Create: %zu survived and reported\n", faultNum);
}

TEST_CASE("every call of Vulkan that fails in Resize leaves the old size in use", "[gpu]")
{
    const size_t faultNum = faultsIn(sweepResizing);
    std::printf("FIGURE Faults of Vulkan in Resize: %zu survived and reported\n", faultNum);
}

TEST_CASE("every call of Vulkan that fails in a frame can be made again in that frame", "[gpu]")
{
    const size_t faultNum = faultsIn(sweepFrames);
    std::printf("FIGURE Faults of Vulkan in frames: %zu survived and reported\n", faultNum);
}

TEST_CASE("every call of Vulkan that fails in a diagnosis can be made again in that frame", "[gpu]")
{
    std::printf("FIGURE Faults of Vulkan in diagnoses: %zu survived and reported\n",
                faultsIn(sweepDiagnosis, reblurAlone(), 0));
}

TEST_CASE("every call of Vulkan that fails in a dump can be made again in that frame", "[gpu]")
{
    std::printf("FIGURE Faults of Vulkan in dumps: %zu survived and reported\n", faultsIn(sweepDump, reblurAlone(), 0));
}

TEST_CASE("every pipeline, layout, sampler and view that fails at first is made at the second attempt", "[gpu]")
{
    size_t faultNum = 0;
    for (const SessionDesc& desc : allSets())
    {
        const Outputs& expected = expectedOf(desc);
        Session session(desc);
        VulkanInjector injector(0);
        injector.attach(session);
        session.create();
        failEachOnce();
        for (int frame = 0; frame < 2; frame++) session.frame(frame);
        stop();
        CHECK(isSame(restart(session), expected));
        session.destroy();
        faultNum += injector.faultNum();
        requireNothingAlive();
    }
    CHECK(faultNum > 0);
    std::printf("FIGURE Faults of Vulkan in pipelines and views: %zu survived and reported\n", faultNum);
}
