// Hot reload of the denoisers' shaders: watches a folder of sources, compiles what changed as the library's build does.
// Only in builds with NRD_HOT_RELOAD.
#pragma once
#include "examples/compile_shaders.h"
#include "window/viewer.h"

#include <chrono>
#include <filesystem>

namespace sample
{
class ShaderReload
{
public:
    /// The sources this program was built from.
    ShaderReload();

    /// Sources with the same files from now on, compiled at once.
    void watch(Viewer& viewer, const std::filesystem::path& folder);

    /// Looks for changed files now and then. The viewer's denoisers start anew with the new shaders; where one does not
    /// compile they stay, and the viewer's message is what the compiler says.
    void poll(Viewer& viewer);

private:
    std::filesystem::file_time_type newest() const;
    void compile(Viewer& viewer);

    std::filesystem::path m_folder;
    std::filesystem::file_time_type m_seen; // of the newest file
    std::chrono::steady_clock::time_point m_lastLook = std::chrono::steady_clock::now();
};
} // namespace sample
