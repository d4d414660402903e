// A number for everything that an object said or recorded: two runs with one digest did the same.
#pragma once
#include <cstdint>
#include <nrd/nrd.h>
#include <rhi/recording.h>
#include <string_view>

namespace test
{
class Digest
{
public:
    void add(std::string_view text) { addBytes(text.data(), text.size()); }
    void add(const char* text) { add(std::string_view(text)); }
    void add(uint64_t number) { addBytes(&number, sizeof(number)); }
    void add(nrd::Result result) { add(static_cast<uint64_t>(result)); }
    void add(const nrd::DispatchDesc& dispatch);
    void add(const rhi::RecordedCall& call);
    uint64_t value() const { return m_value; }

private:
    void addBytes(const void* bytes, size_t byteSize);

    uint64_t m_value = 14695981039346656037ull; // FNV-1a
};
} // namespace test
