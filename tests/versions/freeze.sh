#!/usr/bin/env bash
# freeze.sh FOLDER: writes the interface of today's headers to FOLDER/interface.txt, enumerators with their values,
# fields with offset and size, and copies the example; once for each release. Add the folder to CMakeLists.txt.
set -euo pipefail
cd "$(dirname "$0")"
root=$(realpath ../..)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$1"
for header in "$root"/nrd/include/nrd/{types,settings,descs}.h "$root"/integration/include/nrd/{doctor,integration}.h; do
    awk -f list_interface.awk "$header"
done > "$work/list"
{
    echo '#include <cstddef>'
    echo '#include <cstdio>'
    echo '#include <nrd/integration.h>'
    echo 'using namespace nrd; int main() {'
    sed -E -e 's/^enum (.*) (.*)/std::printf("enum \1 \2 %u\\n", unsigned(\1::\2));/' \
        -e 's/^field (.*) (.*)/std::printf("field \1 \2 %zu %zu\\n", offsetof(\1, \2), sizeof(\1::\2));/' "$work/list"
    echo '}'
} > "$work/print.cpp"
"${CXX:-c++}" -std=c++17 -Wno-invalid-offsetof -I"$root/nrd/include" -I"$root/integration/include" "$work/print.cpp" \
    -o "$work/print"
"$work/print" > "$1/interface.txt"
cp "$root/sample/examples/native_handles.cpp" "$1/"
