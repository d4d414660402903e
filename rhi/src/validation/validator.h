// What all objects of one validating device share: the sink, who is alive, and which submissions are done.
#pragma once
#include "tracker.h"
#include <functional>
#include <memory>
#include <rhi/device.h>
#include <rhi/validation.h>
#include <string>
#include <unordered_map>
#include <vector>

namespace rhi::validation
{
/// The part of an object that outlives it: sets, views and command buffers that refer to it hold on to this.
struct Resource
{
    Resource(const char* kindName, const char* objectName) : kind(kindName), name(objectName) {}
    const char* kind; // "texture", ...
    std::string name;
    bool isAlive = true;
    uint64_t lastSubmission = 0; // number of the last submission that uses it
    uint64_t lastRecording = 0;  // identifier: a recording lists what it uses once

    std::string text() const { return std::string(kind) + " '" + name + "'"; }
};

class Validator
{
public:
    explicit Validator(ValidationSink sink) : m_sink(std::move(sink)) {}

    void report(const std::string& sentence) const
    {
        if (m_sink) m_sink(sentence);
    }
    /// Runs the checks and the creation of a factory; a misuse is reported and thrown on.
    template <class F> auto guarded(F&& create) const
    {
        try
        {
            return create();
        }
        catch (const Error& error)
        {
            const bool isMisuse = error.code() == ErrorCode::InvalidArgument ||
                                  error.code() == ErrorCode::Unsupported || error.code() == ErrorCode::InvalidShader;
            if (isMisuse) report(error.what());
            throw;
        }
    }

    void add(const Object* object, std::shared_ptr<Resource> resource);
    /// Marks the end of a life. `inner` is destroyed at once, or, if that is a misuse, when the GPU is done with it.
    void remove(const Object* object, std::unique_ptr<Object> inner, const std::string& misuse);
    /// False, and a report, if the object is gone or was made by another device.
    bool isUsable(const Object* object, const char* kind, const std::string& user) const;

    /// Marks the end of a life that has no object of its own underneath.
    void retire(const Object* object) { m_objects.at(object)->isAlive = false; }
    std::shared_ptr<Recording> newRecording();

    uint64_t lastSubmission() const { return m_lastSubmission; }
    uint64_t nextSubmission() { return ++m_lastSubmission; }
    uint64_t completed() const { return m_completed; }
    void complete(uint64_t submission);
    bool isPending(const Resource& resource) const { return resource.lastSubmission > m_completed; }
    /// One sentence about what still lives when the device goes.
    void reportLeaks() const;
    void buryAll() { m_graves.clear(); }

private:
    struct Grave
    {
        std::unique_ptr<Object> object;
        uint64_t until = 0; // submission after which it can go
    };
    ValidationSink m_sink;
    std::unordered_map<const Object*, std::shared_ptr<Resource>> m_objects; // the dead too, for their names
    std::vector<Grave> m_graves;
    uint64_t m_lastSubmission = 0;
    uint64_t m_completed = 0;
    uint64_t m_lastRecording = 0;
};
} // namespace rhi::validation
