#!/usr/bin/env bash
# Installs the .deb packages of what BUILD_DIR has built with apt on a fresh Debian, in a folder that debootstrap fills,
# and builds and runs the consumer there: find_package, then pkg-config. Needs root, debootstrap and the network; about
# 700 MB of disk. ROOT_DIR may hold a fresh Debian already.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$(realpath "${BUILD_DIR:-build}")
work=$build/apt-test
root=${ROOT_DIR:-$work/root}
rm -rf "$work/packages"
mkdir -p "$work/packages"

[ -x "$root/usr/bin/apt-get" ] || debootstrap --variant=minbase bookworm "$root"
cmake --build "$build" --target nrd_package > /dev/null
(cd "$work/packages" && cpack --config "$build/CPackConfig.cmake" -G DEB > /dev/null)
rm -rf "$root/tmp/nrd"
mkdir -p "$root/tmp/nrd"
cp "$work"/packages/*.deb tests/package/* "$root/tmp/nrd/"

env -i DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin:/sbin:/bin chroot "$root" bash -euo pipefail -c '
cd /tmp/nrd
apt-get update -qq
apt-get install -y -qq --no-install-recommends ./nrd*.deb > install.log 2>&1 || { tail install.log; exit 1; }
apt-get install -y -qq --no-install-recommends g++ cmake make pkg-config > tools.log 2>&1 || { tail tools.log; exit 1; }
version=$(dpkg-query -W -f "\${Version}" nrd)
cmake -S . -B build > configure.log
cmake --build build > build.log
build/consumer "$version"
build/plugin_consumer
g++ -std=c++17 -DHAS_INTEGRATION consumer.cpp $(pkg-config --cflags --libs nrd-integration) -o consumer
./consumer "$version"
apt-get remove -y -qq nrd > remove.log 2>&1
test ! -e /usr/lib/libnrd.so.0.1
'
echo "installed with apt, found by CMake and pkg-config, removed"
