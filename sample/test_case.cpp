#include "test_case.h"

#include "image_io.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

namespace sample
{
namespace
{
using Json = nlohmann::ordered_json;

constexpr const char* kApproaches[] = {"smooth", "jump", "cut"};

Json toJson(const glm::vec3& v) { return {v.x, v.y, v.z}; }

glm::vec3 toVector(const Json& json)
{
    const auto v = json.get<std::array<float, 3>>();
    return {v[0], v[1], v[2]};
}

void require(bool isFine, const char* sentence)
{
    if (!isFine) throw FileError(sentence);
}

CameraKey cameraFrom(const Json& json)
{
    CameraKey key;
    key.frame = json.at("frame").get<uint32_t>();
    if (json.contains("time")) key.time = json.at("time").get<double>();
    key.eye = toVector(json.at("eye"));
    key.target = toVector(json.at("target"));
    key.verticalFov = json.value("verticalFov", key.verticalFov);
    key.nearPlane = json.value("nearPlane", key.nearPlane);
    const std::string approach = json.value("approach", kApproaches[0]);
    const auto* found = std::find(std::begin(kApproaches), std::end(kApproaches), approach);
    require(found != std::end(kApproaches), "a camera's approach is neither smooth, jump nor cut");
    key.approach = Approach(found - std::begin(kApproaches));
    require(glm::length(key.target - key.eye) > 0.0f, "a camera's eye and target are one point");
    require(key.verticalFov > 0.0f && key.verticalFov < 3.14f, "a camera's verticalFov is not in (0; 3.14)");
    require(key.nearPlane > 0.0f, "a camera's nearPlane is not above 0");
    return key;
}

Json toJson(const CameraKey& key)
{
    Json json = {{"frame", key.frame}};
    if (key.time) json["time"] = *key.time;
    json["eye"] = toJson(key.eye);
    json["target"] = toJson(key.target);
    json["verticalFov"] = key.verticalFov;
    json["nearPlane"] = key.nearPlane;
    if (key.approach != Approach::Smooth) json["approach"] = kApproaches[size_t(key.approach)];
    return json;
}

LightKey lightFrom(const Json& json)
{
    const LightKey key = {json.at("frame").get<uint32_t>(), json.at("light").get<uint32_t>(),
                          json.at("factor").get<float>()};
    require(key.factor >= 0.0f && std::isfinite(key.factor), "a light's factor is below 0 or not finite");
    return key;
}

TestCase testFrom(const Json& json)
{
    TestCase test;
    test.what = json.value("what", "");
    test.arguments = json.at("arguments").get<std::vector<std::string>>();
    for (const Json& camera : json.value("cameras", Json::array())) test.cameras.push_back(cameraFrom(camera));
    for (const Json& light : json.value("lights", Json::array())) test.lights.push_back(lightFrom(light));
    const auto isEarlier = [](const CameraKey& a, const CameraKey& b) { return a.frame <= b.frame; };
    require(std::adjacent_find(test.cameras.begin(), test.cameras.end(),
                               [&](const CameraKey& a, const CameraKey& b)
                               { return isEarlier(b, a); }) == test.cameras.end(),
            "the cameras' frames do not grow");
    return test;
}
} // namespace

TestCase readTest(const std::filesystem::path& folder)
{
    const std::filesystem::path file = folder / kTestFile;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw FileError(file.string() + " cannot be opened");
    try
    {
        TestCase test = testFrom(Json::parse(stream));
        test.name = folder.filename().string();
        return test;
    }
    catch (const Json::exception& error)
    {
        throw FileError(file.string() + " is no test: " + error.what());
    }
    catch (const FileError& error)
    {
        throw FileError(file.string() + ": " + error.what());
    }
}

void writeTest(const std::filesystem::path& folder, const TestCase& test)
{
    Json json = {{"what", test.what}, {"arguments", test.arguments}};
    for (const CameraKey& key : test.cameras) json["cameras"].push_back(toJson(key));
    for (const LightKey& key : test.lights)
        json["lights"].push_back({{"frame", key.frame}, {"light", key.light}, {"factor", key.factor}});
    std::filesystem::create_directories(folder);
    std::ofstream stream(folder / kTestFile, std::ios::binary);
    stream << json.dump(1) << '\n';
    if (!stream.flush()) throw FileError((folder / kTestFile).string() + " cannot be written");
}

std::vector<std::filesystem::path> findTests(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> found;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        if (std::filesystem::exists(entry.path() / kTestFile)) found.push_back(entry.path());
    if (error) throw FileError(folder.string() + " cannot be read: " + error.message());
    std::sort(found.begin(), found.end());
    return found;
}

std::filesystem::path nextTest(const std::filesystem::path& folder)
{
    unsigned highest = 0;
    std::error_code none; // a folder that is not there yet has no tests
    for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    {
        unsigned number = 0;
        if (std::sscanf(entry.path().filename().c_str(), "%u", &number) == 1) highest = std::max(highest, number);
    }
    char name[16];
    std::snprintf(name, sizeof(name), "%03u", highest + 1);
    return folder / name;
}

std::optional<CameraKey> keyAt(const TestCase& test, uint32_t frame)
{
    if (test.cameras.empty()) return {};
    const auto after =
        std::find_if(test.cameras.begin(), test.cameras.end(), [&](const CameraKey& key) { return key.frame > frame; });
    if (after == test.cameras.begin()) return test.cameras.front();
    const CameraKey& from = *(after - 1);
    CameraKey key = from;
    key.frame = frame;
    if (from.frame != frame) key.approach = Approach::Smooth; // it came there earlier
    if (from.frame != frame) key.time.reset();
    if (after == test.cameras.end() || after->approach != Approach::Smooth) return key;
    const float share = float(frame - from.frame) / float(after->frame - from.frame);
    key.eye = glm::mix(from.eye, after->eye, share);
    key.target = glm::mix(from.target, after->target, share);
    key.verticalFov = glm::mix(from.verticalFov, after->verticalFov, share);
    if (from.time && after->time) key.time = *from.time + double(share) * (*after->time - *from.time);
    return key;
}

Camera cameraOf(const CameraKey& key, float aspect)
{
    return lookAt(key.eye, key.target, key.verticalFov, aspect, key.nearPlane);
}

CameraKey keyOf(const Camera& camera)
{
    const glm::mat4 viewToWorld = glm::inverse(camera.worldToView);
    CameraKey key;
    key.eye = glm::vec3(viewToWorld[3]);
    key.target = key.eye - glm::vec3(viewToWorld[2]);
    key.verticalFov = 2.0f * std::atan(camera.tanHalfFovY);
    key.nearPlane = -camera.viewToClip[3][2];
    return key;
}
} // namespace sample
