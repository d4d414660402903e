// Uses what is installed: the descriptor library, and NrdIntegration where it was asked for.
#include <cstdio>
#include <cstring>
#include <nrd/nrd.h>
#ifdef HAS_INTEGRATION
#include <nrd/integration.h>
#endif

int main(int argc, char** argv)
{
    const nrd::LibraryDesc& library = nrd::GetLibraryDesc();
    char version[64];
    std::snprintf(version, sizeof(version), "%u.%u.%u", library.versionMajor, library.versionMinor,
                  library.versionBuild);
    if (argc > 1 && std::strcmp(argv[1], version) != 0) return 1; // what the package says its version is
    const nrd::DenoiserDesc denoiser = {0, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR};
    nrd::InstanceCreationDesc desc;
    desc.denoisers = &denoiser;
    desc.denoisersNum = 1;
    nrd::Instance* instance = nullptr;
    if (nrd::CreateInstance(desc, instance) != nrd::Result::SUCCESS) return 2;
    std::printf("nrd %s, %u pipelines\n", version, nrd::GetInstanceDesc(*instance).pipelinesNum);
    nrd::DestroyInstance(instance);
#ifdef HAS_INTEGRATION
    if (nrd::GetRequiredDeviceFeatures().apiVersion == 0) return 3;
    nrd::NrdIntegration integration;
    if (integration.Create({}, desc) != nrd::Result::INVALID_ARGUMENT) return 4; // there is no device
    std::printf("NrdIntegration says: %s\n", integration.GetLastMessage());
#endif
    return 0;
}
