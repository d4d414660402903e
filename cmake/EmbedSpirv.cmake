# Script: INPUT (.spv) -> OUTPUT (.cpp) with the words of module NAME in NAMESPACE.
file(READ "${INPUT}" hex HEX)
string(LENGTH "${hex}" length)
math(EXPR byte_size "${length} / 2")
# SPIR-V is stored little-endian: the four bytes of a word are turned round.
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1,\n" words "${hex}")
file(WRITE "${OUTPUT}"
"#include <cstddef>
#include <cstdint>

namespace ${NAMESPACE}
{
extern const uint32_t k${NAME}[];
extern const size_t k${NAME}Size;
const uint32_t k${NAME}[] = {
${words}};
const size_t k${NAME}Size = ${byte_size};
} // namespace ${NAMESPACE}
")
