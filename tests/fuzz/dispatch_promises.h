// What must hold of every dispatch, whatever was asked for.
#pragma once
#include <nrd/nrd.h>

namespace fuzz
{
void checkDispatch(const nrd::InstanceDesc& instance, const nrd::DispatchDesc& dispatch);
} // namespace fuzz
