// What an instance consists of: its denoisers with their places in the pools, the pipelines, the totals. Built once.
#pragma once
#include "expand.h"
#include "text.h"
#include <memory_resource>
#include <nrd/descs.h>
#include <vector>

namespace nrd
{
struct PoolPlace
{
    ResourceType pool = ResourceType::MAX_NUM;
    uint16_t index = 0;
    uint16_t pairedIndex = 0; // the other one of a ping-pong pair, else the same
};

// An image to be zeroed before the denoiser's first pass.
struct ClearTarget
{
    ResourceDesc resource = {};
    uint16_t pipeline = 0;
    uint16_t downsampleFactor = 1;
};

using Name = FixedText<80>; // "DENOISER - Pass"

struct CompiledDenoiser
{
    Identifier identifier = 0;
    uint16_t resolutionDivisor = 1;
    Program program;
    FixedList<PoolPlace, 32> places;   // of Program::textures
    FixedList<uint16_t, 20> pipelines; // of Program::passes with all switches off; bit i on = switch i
    FixedList<Name, 20> passNames;
    FixedList<ClearTarget, 72> clears;
    Name clearName;
    // The state of the denoiser
    FamilySettings settings;
    RequestHistory history;
    bool isRequested = false; // since the last common settings
};

struct Compiled
{
    explicit Compiled(std::pmr::memory_resource* memory);

    std::pmr::vector<CompiledDenoiser> denoisers; // and last of all what makes confidence, if anything does
    std::pmr::vector<DenoiserInfo> infos;
    std::pmr::vector<PipelineDesc> pipelines;
    std::pmr::vector<SpecializationConstant> constants; // of all pipelines
    std::pmr::vector<TextureDesc> permanentPool;
    std::pmr::vector<TextureDesc> transientPool;
    DescriptorPoolDesc totals = {};
    uint32_t dispatchMaxNum = 0; // of a frame in which every denoiser runs once with everything on
    uint32_t resourceMaxNum = 0;
};

// The description is valid. Throws std::bad_alloc.
void compile(const InstanceCreationDesc& desc, Compiled& compiled);
} // namespace nrd
