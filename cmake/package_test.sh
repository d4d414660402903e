#!/usr/bin/env bash
# Installs what BUILD_DIR has built into empty folders, and builds and runs a consumer in each way that the library can
# be taken home: find_package with static and with shared libraries, pkg-config, the .deb packages, add_subdirectory and
# FetchContent over an archive of the sources without a shader compiler. Closes with "N passed, N failed".
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
build=$(realpath "${BUILD_DIR:-build}")
jobs=${JOBS:-$(nproc)}
work=$build/package-test
consumer=$root/tests/package
passed=0 failed=0

# check NAME command...: one test; its output is shown if it fails.
check() {
    local name=$1 start=$SECONDS status
    shift
    set +e # in a condition nothing would stop at the first failure
    ( set -e; "$@" ) > "$work/$name.log" 2>&1
    status=$?
    set -e
    if [ $status -eq 0 ]; then
        passed=$((passed + 1))
        echo "passed  $name  $((SECONDS - start)) s"
    else
        failed=$((failed + 1))
        echo "FAILED  $name"
        tail -n 30 "$work/$name.log"
    fi
}

# run FOLDER: what a consumer built, with the version that the package says it has.
run() {
    "$1/consumer" "$version"
    if [ -x "$1/plugin_consumer" ]; then "$1/plugin_consumer"; fi
}

# absent PATTERN: nothing of standard input matches.
absent() { if grep -E "$1"; then return 1; fi; }

# configure_and_run NAME options...
configure_and_run() {
    local folder=$work/consumer-$1
    shift
    cmake -S "$consumer" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release "$@"
    cmake --build "$folder" -j "$jobs"
    run "$folder"
}

with_pkgconfig() { # PREFIX
    local prefix=$1 folder=$work/consumer-pkgconfig
    mkdir -p "$folder"
    export PKG_CONFIG_PATH=$prefix/lib/pkgconfig LD_LIBRARY_PATH=$prefix/lib
    local flags
    # Under /usr pkg-config drops its own folders; here the files are elsewhere and must be named.
    export PKG_CONFIG_SYSTEM_INCLUDE_PATH=- PKG_CONFIG_SYSTEM_LIBRARY_PATH=-
    flags=$(pkg-config --cflags --libs nrd-integration)
    test "$(pkg-config --modversion nrd)" = "$version"
    c++ -std=c++17 -Wall -Werror -DHAS_INTEGRATION "$consumer/consumer.cpp" $flags -o "$folder/consumer"
    c++ -std=c++17 -Wall -Werror "$consumer/consumer.cpp" -I"$prefix/include" "$prefix/lib/libnrd.a" \
        -o "$folder/consumer-static"
    cc -std=c99 -Wall -Wextra -Werror "$consumer/plugin_consumer.c" \
        $(pkg-config --cflags --libs nrd-plugin) \
        -o "$folder/plugin_consumer"
    run "$folder"
    "$folder/consumer-static" "$version"
}

# The examples; their pictures are those of the build folder's, which the tests hold against NrdIntegration's.
examples() { # FOLDER PREFIX
    "$1/native_handles" "$work/native_handles.raw"
    "$build/bin/nrd-example-native-handles" "$work/expected_native_handles.raw"
    cmp "$work/native_handles.raw" "$work/expected_native_handles.raw"
    "$build/bin/nrd-example-own-rhi" "$work/expected.raw"
    "$1/own_rhi" "$work/own_rhi.raw"
    "$1/white_box" "$2/share/nrd/shaders" "$work/white_box.raw"
    "$1/plugin_events" "$work/plugin_events.raw"
    local way
    for way in own_rhi white_box plugin_events; do cmp "$work/$way.raw" "$work/expected.raw"; done
}

# No shader compiler: what finds none must not need one.
from_sources() { # NAME options...
    local name=$1
    shift
    # One folder for both, as they build the same.
    configure_and_run sources "-DWAY=$name" "-DNRD_SOURCE=$work/source" "$@"
    absent "glslang|spirv-opt" < "$work/consumer-sources/build.ninja"
}

# Shared libraries have versioned names, export what the headers declare, and do not link the loader.
libraries_are_clean() { # PREFIX
    local library
    for library in nrd nrd_integration nrd_plugin; do
        readelf -d "$1/lib/lib$library.so" | grep -q "soname: \[lib$library\.so\.${version%.*}\]"
        readelf -d "$1/lib/lib$library.so" | absent libvulkan
        # All but nrd's own; the standard library's templates leave weak symbols.
        nm -DC --defined-only "$1/lib/lib$library.so" | sed -E '/ [Vu] .*std::/d; / nrd::| NrdPlugin/d' | absent .
        nm -DC --defined-only "$1/lib/lib$library.so" | absent 'rhi::|nrd::plugin::'
    done
}

files_are_there() { # PREFIX
    local file
    for file in shaders/nrd_shaders.json shaders/include/nrd_frontend.glsl NrdPlugin.cs spirv/nrd_shaders/ClearFloat.spv
    do
        test -f "$1/share/nrd/$file"
    done
}

unpack_debs() {
    (cd "$work" && cpack --config "$build/CPackConfig.cmake" -G DEB)
    mkdir "$work/root"
    local deb
    for deb in "$work"/nrd_*.deb "$work"/nrd-dev_*.deb; do dpkg -x "$deb" "$work/root"; done
    dpkg --field "$work"/nrd-dev_*.deb Depends | grep -q "nrd (= $version)"
    local contact
    contact=$(sed -n 's/^NRD_PACKAGE_CONTACT:STRING=//p' "$build/CMakeCache.txt")
    test "$(dpkg --field "$work"/nrd-dev_*.deb Maintainer)" = "$contact"
}

tar_up() {
    (cd "$work" && cpack --config "$build/CPackConfig.cmake" -G TGZ)
    mkdir "$work/source"
    tar -xzf "$work"/nrd-*-source.tar.gz -C "$work/source" --strip-components=1
    test -f "$work/source/CMakeLists.txt"
    test -d "$work/source/spirv/nrd_shaders"
}

cmake --build "$build" -j "$jobs" --target nrd_package nrd-example-native-handles \
    nrd-example-own-rhi > /dev/null
rm -rf "$work"
mkdir -p "$work"
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
prefix=$work/prefix
for component in runtime development; do
    cmake --install "$build" --prefix "$prefix" --component $component > "$work/install.log"
done
mv "$prefix" "$work/moved" # nothing may remember where it was installed
prefix=$work/moved

check files files_are_there "$prefix"
check libraries libraries_are_clean "$prefix"
check find_package-static configure_and_run static "-DCMAKE_PREFIX_PATH=$prefix" -DEXAMPLES=ON
check find_package-shared configure_and_run shared "-DCMAKE_PREFIX_PATH=$prefix" -DBUILD_SHARED_LIBS=ON
check examples examples "$work/consumer-static" "$prefix"
check pkgconfig with_pkgconfig "$prefix"
check deb unpack_debs
check deb-find_package configure_and_run deb "-DCMAKE_PREFIX_PATH=$work/root/usr"
check deb-pkgconfig with_pkgconfig "$work/root/usr"
check archives tar_up
check add_subdirectory from_sources add_subdirectory
check FetchContent from_sources FetchContent
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
