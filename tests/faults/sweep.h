// One fault after another over the calls of a session: each must come back as a result with a message, and the same
// call must succeed when it is made again.
#pragma once
#include "session.h"

namespace faults
{
// How faults are planned, and how the calls are made that meet them.
class Injector
{
public:
    virtual ~Injector() = default;
    virtual void failNth(size_t n) = 0; // of what the calls of Session::make do from now on
    virtual void stop() = 0;
    /// Makes calls of the session fail as planned, and checks what they say.
    virtual void attach(Session& session) = 0;
    size_t faultNum() const { return m_faultNum; } // since the beginning

protected:
    size_t m_faultNum = 0;
};

void sweepCreation(Injector& injector, const SessionDesc& desc);
void sweepResizing(Injector& injector, const SessionDesc& desc);
void sweepFrames(Injector& injector, const SessionDesc& desc);
void sweepFirstFrame(Injector& injector, const SessionDesc& desc); // which makes the pipelines; a session per fault
void sweepDiagnosis(Injector& injector, const SessionDesc& desc);
/// Frames whose inputs are dumped, each in turn.
void sweepDump(Injector& injector, const SessionDesc& desc);

/// The last of a few frames after a restart: equal for all sessions of this description, whatever they went through.
Outputs restart(Session& session);
const Outputs& expectedOf(const SessionDesc& desc); // of a session without faults

SessionDesc smallSet();             // a denoiser of each family, but RELAX
SessionDesc reblurAlone();          // of which the doctor knows all inputs
std::vector<SessionDesc> allSets(); // the small one; in the long form every denoiser alone as well
} // namespace faults
