// A numbered test: a folder with test.json, which says what nrd-sample renders, from where, frame by frame.
#pragma once
#include "camera.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sample
{
/// How the camera comes to a key.
enum class Approach : uint8_t
{
    Smooth, // from the key before, evenly
    Jump,   // at once, and nobody says so
    Cut     // at once, with the history restarted
};

/// Where the camera is at a frame; roll is not kept.
struct CameraKey
{
    uint32_t frame = 0;
    std::optional<double> time; // seconds of animation; nullopt: as the frames per second have it
    glm::vec3 eye = glm::vec3(0.0f);
    glm::vec3 target = glm::vec3(0.0f, 0.0f, -1.0f);
    float verticalFov = 0.8f; // radians, (0; pi)
    float nearPlane = 0.05f;  // > 0, world units
    Approach approach = Approach::Smooth;
};

/// From a frame on a light of the scene shines this many times as much as in the file.
struct LightKey
{
    uint32_t frame = 0;
    uint32_t light = 0;  // index in the scene's list
    float factor = 1.0f; // >= 0
};

struct TestCase
{
    std::string name;                   // of the folder
    std::string what;                   // it shows, in a sentence
    std::vector<std::string> arguments; // of nrd-sample; files are relative to the folder
    std::vector<CameraKey> cameras;     // by frame; empty: the scene's own
    std::vector<LightKey> lights;
};

constexpr const char* kTestFile = "test.json";

/// Throws FileError, which names the file and what is wrong with it.
TestCase readTest(const std::filesystem::path& folder);
void writeTest(const std::filesystem::path& folder, const TestCase& test);

/// The folders with a test in `folder`, by name.
std::vector<std::filesystem::path> findTests(const std::filesystem::path& folder);
/// FOLDER/001, or what comes after the highest number there.
std::filesystem::path nextTest(const std::filesystem::path& folder);

/// Between the keys, held before the first and after the last. nullopt without keys.
std::optional<CameraKey> keyAt(const TestCase& test, uint32_t frame);
Camera cameraOf(const CameraKey& key, float aspect); // aspect: width / height
CameraKey keyOf(const Camera& camera);
} // namespace sample
