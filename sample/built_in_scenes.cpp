#include "built_in_scenes.h"
#include "scene_bumps.h"
#include "scene_cornell.h"
#include "scene_mirror.h"
#include "scene_panes.h"
#include "scene_rooms.h"
#include "scene_veils.h"

namespace sample
{
namespace
{
constexpr BuiltInScene kScenes[] = {
    {"cornell", makeCornellBox},     {"bumps", makeBumps}, {"panes", makePanes}, {"mirror", makeMirrorYard},
    {"mirror-twin", makeMirrorTwin}, {"veils", makeVeils}, {"rooms", makeRooms}};
} // namespace

std::span<const BuiltInScene> builtInScenes() { return kScenes; }

const BuiltInScene* findBuiltInScene(std::string_view name)
{
    for (const BuiltInScene& scene : kScenes)
        if (scene.name == name) return &scene;
    return nullptr;
}
} // namespace sample
