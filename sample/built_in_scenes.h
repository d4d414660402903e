// The scenes that are built in code, by name.
#pragma once
#include "scene.h"

#include <span>
#include <string_view>

namespace sample
{
struct BuiltInScene
{
    const char* name;
    Scene (*make)();
};

/// The first one is the default.
std::span<const BuiltInScene> builtInScenes();

/// Null when there is none of that name.
const BuiltInScene* findBuiltInScene(std::string_view name);
} // namespace sample
