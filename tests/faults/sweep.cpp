#include "sweep.h"
#include "catch.h"
#include "long_form.h"
#include "validated_device.h"
#include <filesystem>
#include <map>

namespace faults
{
namespace
{
constexpr glm::ivec2 kSize{40, 24};
constexpr glm::ivec2 kOtherSize{33, 25};

/// `body` once for each n, until no fault comes of it.
template <class Body> void forEachFault(Injector& injector, Body&& body)
{
    constexpr size_t kMany = 20000;
    size_t n = 1;
    for (; n < kMany; n++)
    {
        INFO("fault at " << n);
        const size_t before = injector.faultNum();
        injector.failNth(n);
        body(n);
        injector.stop();
        if (injector.faultNum() == before) break;
    }
    CHECK(n > 1);
    CHECK(n < kMany);
    test::failOnMessages();
}
} // namespace

SessionDesc smallSet()
{
    SessionDesc desc;
    desc.denoisers = {nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR, nrd::Denoiser::SIGMA_SHADOW, nrd::Denoiser::REFERENCE};
    desc.size = kSize;
    desc.isGpuTimingEnabled = true;
    desc.isPassTracingEnabled = true;
    return desc;
}

SessionDesc reblurAlone()
{
    SessionDesc desc = smallSet();
    desc.denoisers = {nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR};
    return desc;
}

std::vector<SessionDesc> allSets()
{
    std::vector<SessionDesc> sets = {smallSet()};
    if (!test::isLong()) return sets;
    for (const nrd::Denoiser denoiser : options::allDenoisers())
    {
        SessionDesc desc = smallSet();
        desc.denoisers = {denoiser};
        sets.push_back(desc);
    }
    return sets;
}

Outputs restart(Session& session)
{
    session.resize(kOtherSize);
    session.resize(kSize);
    constexpr int kFirst = 1 << 20; // after any frame that was
    for (int frame = 0; frame < 3; frame++) session.frame(kFirst + frame);
    return session.finish().back();
}

const Outputs& expectedOf(const SessionDesc& desc)
{
    static std::map<std::vector<nrd::Denoiser>, Outputs> known;
    Outputs& expected = known[desc.denoisers];
    if (!expected.empty()) return expected;
    Session session(desc);
    session.create();
    return expected = restart(session);
}

void sweepCreation(Injector& injector, const SessionDesc& desc)
{
    Session session(desc);
    injector.attach(session);
    forEachFault(injector,
                 [&](size_t)
                 {
                     session.create();
                     session.destroy();
                 });
}

void sweepResizing(Injector& injector, const SessionDesc& desc)
{
    const Outputs& expected = expectedOf(desc);
    Session session(desc);
    injector.attach(session);
    session.create();
    int index = 0;
    session.frame(index++);
    forEachFault(injector,
                 [&](size_t n)
                 {
                     session.resize(n % 2 == 0 ? kSize : kOtherSize);
                     injector.stop();
                     constexpr size_t kSome = 8; // of all resizes are put to use at once
                     if (n % kSome == 0) session.frame(index++);
                 });
    CHECK(isSame(restart(session), expected));
}

void sweepFirstFrame(Injector& injector, const SessionDesc& desc)
{
    const Outputs& expected = expectedOf(desc);
    Session session(desc);
    injector.attach(session);
    forEachFault(injector,
                 [&](size_t n)
                 {
                     injector.stop();
                     session.create();
                     injector.failNth(n);
                     session.frame(0);
                     injector.stop();
                     (void)session.finish();
                     session.destroy();
                 });
    session.create();
    CHECK(isSame(restart(session), expected));
}

void sweepFrames(Injector& injector, const SessionDesc& desc)
{
    const Outputs& expected = expectedOf(desc);
    Session session(desc);
    injector.attach(session);
    session.create();
    int index = 0;
    for (; index < 2; index++) session.frame(index); // makes the pipelines
    forEachFault(injector,
                 [&](size_t)
                 {
                     session.generation++;
                     session.frame(index++);
                     (void)session.finish();
                 });
    CHECK(isSame(restart(session), expected));
}

void sweepDiagnosis(Injector& injector, const SessionDesc& desc)
{
    SessionDesc diagnosed = desc;
    diagnosed.isDiagnosed = true;
    Session session(diagnosed);
    injector.attach(session);
    session.create();
    int index = 0;
    session.frame(index++); // makes the pipelines of the denoisers
    (void)session.finish();
    session.diagnose();
    forEachFault(injector,
                 [&](size_t)
                 {
                     session.frame(index++);
                     (void)session.finish();
                     session.diagnose();
                 });
}

void sweepDump(Injector& injector, const SessionDesc& desc)
{
    SessionDesc dumped = desc;
    const std::string folder = (std::filesystem::temp_directory_path() / "nrd-test-faults-dump").string();
    dumped.dumpFolder = folder.c_str();
    Session session(dumped);
    injector.attach(session);
    session.create();
    int index = 0;
    session.frame(index++);
    (void)session.finish();
    forEachFault(injector,
                 [&](size_t)
                 {
                     session.frame(index++);
                     (void)session.finish();
                 });
    session.destroy();
    std::filesystem::remove_all(folder);
}
} // namespace faults
