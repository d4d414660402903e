// The replay's --set: any text gives settings or a SettingError with a sentence.
#include "fuzz.h"
#include "replay_settings.h"

namespace
{
constexpr const char* kValues[] = {"1",      "-1", "nan", "inf", "1e999", "65536", "4294967296", "true",
                                   "SIMPLE", "",   ",",   "1,2", "0x10",  "1e-45", " 1",         "AREA_5X5"};

// A key of the family with a value of some type, as many as it takes, before the damage.
std::string assignmentOf(const std::vector<sample::SettingField>& fields, fuzz::ByteReader& reader)
{
    const sample::SettingField& field = fields[reader.below(static_cast<uint32_t>(fields.size()))];
    const std::string value = kValues[reader.below(std::size(kValues))];
    std::string text = field.name + "=" + value;
    for (size_t i = 1; i < field.count; i++) text += "," + value;
    return text;
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    fuzz::ByteReader reader(bytes, size);
    sample::ReplaySettings settings;
    while (!reader.isEmpty())
    {
        const auto family = static_cast<sample::Family>(reader.below(5));
        const std::vector<sample::SettingField> fields = sample::settingFields(settings, family);
        fuzz::countCall();
        try
        {
            const std::string text = fuzz::damaged(assignmentOf(fields, reader), reader);
            sample::applySettings(settings, family, {sample::parseAssignment(text)});
        }
        catch (const sample::SettingError& error)
        {
            fuzz::require(*error.what() != 0, "a refused setting is explained");
        }
    }
    return 0;
}
