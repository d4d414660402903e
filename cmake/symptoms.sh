#!/usr/bin/env bash
# Makes the pictures of nrd/docs/symptoms.md anew: one capture of the sample, replayed with one fault at a time.
set -euo pipefail
cd "$(dirname "$0")/.."
bin=${BUILD_DIR:-build}/bin
out=${1:-nrd/docs/symptoms}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$bin/nrd-sample" --headless --size 384x216 --fps 8 --frames 12 --capture "$work/capture" --reference-spp 0 > /dev/null

# replay NAME key=value...: the last picture as NAME.png, or the overlay if it is asked for.
replay() {
    local name=$1 picture=denoised
    shift
    case "$*" in *enableValidation*) picture=validation ;; esac
    "$bin/nrd-replay" "$work/capture" --denoiser REBLUR_DIFFUSE_SPECULAR --out "$work/$name" ${*:+--set "$@"} > /dev/null
    cp "$work/$name/${picture}_0011.png" "$out/$name.png"
}

mkdir -p "$out"
replay good
replay restarts accumulationMode=RESTART
replay range denoisingRange=3.2
replay corner rectSize=192,108 rectSizePrev=192,108
replay overlay enableValidation=true
replay overlay-motion enableValidation=true motionVectorScale=-1,-1,0
