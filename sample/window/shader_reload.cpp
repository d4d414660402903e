#include "window/shader_reload.h"

namespace sample
{
namespace
{
constexpr std::chrono::milliseconds kInterval(500);
}

ShaderReload::ShaderReload() : m_folder(NRD_SHADER_SOURCES), m_seen(newest()) {}

std::filesystem::file_time_type ShaderReload::newest() const
{
    std::filesystem::file_time_type time = std::filesystem::file_time_type::min();
    std::error_code error; // a file that an editor is just replacing is seen the next time
    for (auto entry = std::filesystem::recursive_directory_iterator(m_folder, error);
         entry != std::filesystem::recursive_directory_iterator(); entry.increment(error))
        if (const auto changed = entry->last_write_time(error); !error) time = std::max(time, changed);
    return time;
}

void ShaderReload::watch(Viewer& viewer, const std::filesystem::path& folder)
{
    m_folder = folder;
    m_seen = newest();
    compile(viewer);
}

void ShaderReload::poll(Viewer& viewer)
{
    const auto now = std::chrono::steady_clock::now();
    if (now - m_lastLook < kInterval) return;
    m_lastLook = now;
    const auto changed = newest();
    if (changed == m_seen) return;
    m_seen = changed;
    compile(viewer);
}

void ShaderReload::compile(Viewer& viewer)
{
    try
    {
        const example::ShaderCompiler compiler(m_folder.string(), NRD_SHADER_MANIFEST);
        ShaderModules modules;
        for (const std::string& name : viewer.shaders()) modules[name] = compiler.compile(name);
        viewer.setShaders(std::move(modules));
        viewer.setMessage("");
    }
    catch (const std::exception& error)
    {
        viewer.setMessage(std::string("shaders are as before: ") + error.what());
    }
}
} // namespace sample
