#!/usr/bin/env bash
# Installs what the build and the tests need on Debian 12 or newer: only what is missing, with sudo only where needed.
# With --sanitize also Clang and the run time of its sanitizers.
set -euo pipefail

packages=(
    g++ cmake ninja-build pkg-config git ca-certificates
    glslang-tools glslang-dev spirv-tools
    libvulkan-dev mesa-vulkan-drivers vulkan-validationlayers
    libglm-dev libtinygltf-dev libstb-dev nlohmann-json3-dev libopenexr-dev libembree-dev libcli11-dev catch2
    gnuplot-nox               # for the plots of nrd-report
    libglfw3-dev libimgui-dev xvfb xauth # for the window of nrd-sample and its tests
    libtinyexr-dev zlib1g-dev # for the program that renders the recorded test sequences
)
case "${1:-}" in
    "") ;;
    --sanitize) packages+=(clang libclang-rt-dev llvm) ;; # llvm: names in the stacks that sanitizers print
    *) echo "usage: $0 [--sanitize]" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
    [ "$status" = "install ok installed" ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then exit 0; fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "These packages are missing and sudo is not here: ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
fi
echo "Installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
