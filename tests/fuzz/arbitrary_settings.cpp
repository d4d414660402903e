#include "arbitrary_settings.h"

#include <limits>

namespace fuzz
{
namespace
{
template <class T> void setArbitrary(T& value, ByteReader& reader)
{
    if constexpr (std::is_same_v<T, bool>)
        value = reader.flag();
    else
        value = reader.value<T>();
}

// Noise is refused at the first field; a mild value lets a call go through with one odd field.
template <class T> void setMild(T& value, ByteReader& reader)
{
    if constexpr (std::is_same_v<T, bool>)
        value = reader.flag();
    else if constexpr (std::is_floating_point_v<T>)
    {
        constexpr T kValues[] = {0,
                                 1,
                                 T(0.5),
                                 T(1e-30),
                                 T(1e30),
                                 T(-1),
                                 std::numeric_limits<T>::infinity(),
                                 std::numeric_limits<T>::quiet_NaN(),
                                 std::numeric_limits<T>::max(),
                                 T(3)};
        value = kValues[reader.below(std::size(kValues))];
    }
    else
        value = static_cast<T>(reader.below(64));
}

void changeField(sample::SettingField& field, ByteReader& reader)
{
    const size_t index = reader.below(static_cast<uint32_t>(field.count));
    const bool isMild = reader.flag();
    std::visit([&](auto* value) { isMild ? setMild(value[index], reader) : setArbitrary(value[index], reader); },
               field.target);
}
} // namespace

void changeSettings(sample::ReplaySettings& settings, sample::Family family, ByteReader& reader)
{
    std::vector<sample::SettingField> fields = sample::settingFields(settings, family);
    for (uint32_t changes = reader.below(4); changes > 0; changes--)
        changeField(fields[reader.below(static_cast<uint32_t>(fields.size()))], reader);
}
} // namespace fuzz
