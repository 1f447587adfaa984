#!/usr/bin/env bash
# Configures and builds: deploy/build.sh PRESET [TARGET]...   (all targets if none is named)
set -euo pipefail

(($#)) || { echo "build.sh: give a preset: release, debug, asan or tsan" >&2 && exit 2; }
readonly preset=$1
shift
cd "$(dirname "${BASH_SOURCE[0]}")/.."

options=()
[[ -z ${SUNDIAL_SCENES:-} ]] || options+=("-DSUNDIAL_SCENES=$(realpath "$SUNDIAL_SCENES")")
targets=()
(($# == 0)) || targets=(--target "$@")

log=$(mktemp)
trap 'rm -f "$log"' EXIT
cmake --preset "$preset" "${options[@]}" >"$log" 2>&1 || { cat "$log" >&2 && exit 1; }
# The compiler takes up to 1.5 GiB a file: no more of them at once than memory holds.
jobs=$(nproc)
memory=$(awk '/^MemAvailable/ {print int($2 / 1.5 / 1024 / 1024)}' /proc/meminfo)
((memory >= jobs)) || jobs=$((memory > 1 ? memory : 1))
cmake --build "build/$preset" --parallel "$jobs" "${targets[@]}"
