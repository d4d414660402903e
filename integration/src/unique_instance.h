// An owned instance of the descriptor library.
#pragma once
#include <memory>
#include <nrd/nrd.h>

namespace nrd
{
struct InstanceDeleter
{
    void operator()(Instance* instance) const { DestroyInstance(instance); }
};
using UniqueInstance = std::unique_ptr<Instance, InstanceDeleter>;
} // namespace nrd
