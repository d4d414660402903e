#include "name_choice.h"

#include <nrd/nrd.h>

#include <algorithm>

namespace sample
{
std::regex parseNames(const char* option, const std::string& expression)
{
    try
    {
        return std::regex(expression);
    }
    catch (const std::regex_error&)
    {
        throw SettingError(std::string(option) + " " + expression + ": expected a regular expression");
    }
}

std::vector<const ReplayDenoiser*> selectDenoisers(const std::string& expression)
{
    const std::regex names = parseNames("--denoisers", expression);
    const nrd::LibraryDesc& library = nrd::GetLibraryDesc();
    const nrd::Denoiser* last = library.supportedDenoisers + library.supportedDenoisersNum;
    std::vector<const ReplayDenoiser*> selected;
    for (const ReplayDenoiser& denoiser : replayDenoisers())
    {
        const bool isSupported = std::find(library.supportedDenoisers, last, denoiser.denoiser) != last;
        if (isSupported && std::regex_match(denoiser.name, names)) selected.push_back(&denoiser);
    }
    if (selected.empty())
        throw SettingError("--denoisers " + expression + ": no denoiser of this build has such a name");
    return selected;
}
} // namespace sample
