#include "window/loader.h"

namespace sample
{
void Loader::start(const Options& options)
{
    if (m_future.valid()) m_future.wait();
    m_options = options;
    m_start = std::chrono::steady_clock::now();
    m_future = std::async(std::launch::async, [options] { return loadStage(options); });
}

bool Loader::isReady() const
{
    return m_future.valid() && m_future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::string Loader::name() const
{
    if (!m_options.scene.empty()) return m_options.scene.filename().string();
    return (m_options.builtIn ? *m_options.builtIn : builtInScenes().front()).name;
}

double Loader::seconds() const
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
}

Options withScene(Options options, const std::string& fileOrName)
{
    options.builtIn = findBuiltInScene(fileOrName);
    options.scene = options.builtIn ? std::filesystem::path() : std::filesystem::path(fileOrName);
    return options;
}

Options withFile(Options options, const std::filesystem::path& file)
{
    const std::string extension = file.extension().string();
    if (extension == ".gltf" || extension == ".glb") return withScene(std::move(options), file.string());
    if (extension != ".hdr" && extension != ".exr")
        throw SceneError("'" + file.string() + "' is neither a scene (.gltf, .glb) nor an environment (.hdr, .exr)");
    options.environment = file;
    return options;
}
} // namespace sample
