#!/usr/bin/env bash
# The Debian 12 packages that Sundial needs, and nothing else: installs those that are missing.
set -euo pipefail

readonly usage="Usage: deploy/packages.sh [--list] [GROUP]...
Installs by apt what is missing of the groups (default: build run). As root, or through sudo.

  build    compilers and libraries; also what the tests are compiled against, and npm for what a page embeds
  run      a Vulkan loader and Mesa's drivers
  test     Vulkan's validation layer, and the browser that tests a report's page
  bundle   what deploy/bundle.sh packs with
  lint     what deploy/lint.sh checks with

  --list   print the groups' packages instead

Example:
  deploy/packages.sh build run test"

declare -rA packages=(
  [build]="
    g++ cmake ninja-build pkg-config ccache
    libvulkan-dev glslang-tools spirv-tools
    libgrpc++-dev libprotobuf-dev protobuf-compiler protobuf-compiler-grpc libssl-dev
    libtinygltf-dev libmeshoptimizer-dev libembree-dev libtbb-dev
    libopenimageio-dev
    libglm-dev libcli11-dev libfmt-dev libspdlog-dev libtomlplusplus-dev nlohmann-json3-dev
    prometheus-cpp-dev
    nodejs npm
    libgtest-dev libbenchmark-dev"
  [run]="libvulkan1 mesa-vulkan-drivers"
  [test]="vulkan-validationlayers chromium"
  [bundle]="binutils patchelf"
  [lint]="clang-format clang-tidy-19 shellcheck"
)

die() {
  echo "packages.sh: $1" >&2
  exit "${2:-1}"
}

list=false
groups=()
for argument in "$@"; do
  case $argument in
    -h | --help) echo "$usage" && exit 0 ;;
    --list) list=true ;;
    build | run | test | bundle | lint) groups+=("$argument") ;;
    *) die "there is no group '$argument'; see deploy/packages.sh --help" 2 ;;
  esac
done
((${#groups[@]})) || groups=(build run)

wanted=()
for group in "${groups[@]}"; do
  read -ra names -d '' <<<"${packages[$group]}" || true  # to the end of the text, which is no error
  wanted+=("${names[@]}")
done
if $list; then
  printf '%s\n' "${wanted[@]}"
  exit 0
fi

command -v dpkg-query >/dev/null ||
  die "this is no Debian; install by other means what 'deploy/packages.sh --list' names"

missing=()
for package in "${wanted[@]}"; do
  # Node from elsewhere brings its own npm, which Debian's can't stand beside.
  [[ $package =~ ^(nodejs|npm)$ ]] && command -v node >/dev/null && command -v npm >/dev/null && continue
  [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] ||
    missing+=("$package")
done
((${#missing[@]})) || exit 0

as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || die "run as root, or install sudo; missing: ${missing[*]}"
  as_root=(sudo)
fi
echo "Installing ${missing[*]}"
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 "$@"; }
apt update
apt install -y --no-install-recommends "${missing[@]}" >/dev/null
