#include "validator.h"
#include <algorithm>

namespace rhi::validation
{
namespace
{
constexpr uint64_t kUntilDeviceGoes = ~uint64_t{0};
}

void Validator::add(const Object* object, std::shared_ptr<Resource> resource)
{
    m_objects[object] = std::move(resource);
}

void Validator::remove(const Object* object, std::unique_ptr<Object> inner, const std::string& misuse)
{
    Resource& resource = *m_objects.at(object);
    resource.isAlive = false;
    if (!misuse.empty())
    {
        report(misuse);
        m_graves.push_back({std::move(inner), kUntilDeviceGoes});
    }
    else if (isPending(resource))
    {
        report(resource.text() + " is destroyed while a submission that uses it is pending");
        m_graves.push_back({std::move(inner), resource.lastSubmission});
    }
}

bool Validator::isUsable(const Object* object, const char* kind, const std::string& user) const
{
    if (!object)
    {
        report(user + ": the " + kind + " is null");
        return false;
    }
    const auto found = m_objects.find(object);
    if (found == m_objects.end())
    {
        report(user + ": the " + kind + " was made by another device");
        return false;
    }
    if (!found->second->isAlive) report(user + ": " + found->second->text() + " was destroyed");
    return found->second->isAlive;
}

std::shared_ptr<Recording> Validator::newRecording()
{
    auto recording = std::make_shared<Recording>();
    recording->id = ++m_lastRecording;
    return recording;
}

void Validator::complete(uint64_t submission)
{
    m_completed = std::max(m_completed, submission);
    std::erase_if(m_graves, [&](const Grave& grave) { return grave.until <= m_completed; });
}

void Validator::reportLeaks() const
{
    size_t count = 0;
    std::string first;
    for (const auto& [object, resource] : m_objects)
    {
        if (!resource->isAlive) continue;
        const std::string text = resource->text();
        if (count++ == 0 || text < first) first = text;
    }
    if (count > 0)
        report("the device is destroyed while " + std::to_string(count) + " of its objects live, among them " + first);
}
} // namespace rhi::validation
