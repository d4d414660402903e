// Reads scenes while the window stays alive.
#pragma once
#include "renderer.h"

#include <chrono>
#include <future>

namespace sample
{
class Loader
{
public:
    /// What was being loaded before is waited for and forgotten.
    void start(const Options& options);
    bool isBusy() const { return m_future.valid(); }
    bool isReady() const;
    /// The stage; throws what loadStage() throws.
    Stage take() { return m_future.get(); }

    const Options& options() const { return m_options; } // of the stage
    std::string name() const;
    double seconds() const; // since start()

private:
    Options m_options;
    std::future<Stage> m_future;
    std::chrono::steady_clock::time_point m_start;
};

/// Options that show a file or a built-in scene, or light with an environment, instead of what they did.
/// Throws SceneError for what is neither .gltf, .glb, .hdr nor .exr.
Options withFile(Options options, const std::filesystem::path& file);
Options withScene(Options options, const std::string& fileOrName);
} // namespace sample
