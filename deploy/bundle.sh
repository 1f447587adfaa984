#!/usr/bin/env bash
# Packs sundial-bench with its shared libraries into a folder that runs on another x86-64 Linux.
set -euo pipefail

readonly usage="Usage: deploy/bundle.sh [--check ROOT] [DIRECTORY]
Builds sundial-bench, packs it with its libraries into DIRECTORY/sundial-bench (default: out/bundle) and into
DIRECTORY/sundial-bench.tar.gz, and runs it from another place. The target has glibc 2.36 or newer, a Vulkan
loader and a driver for Vulkan 1.3.

  --check ROOT   also runs it under that root by chroot (as root, or through sudo), e.g. one made by
                 debootstrap --variant=minbase --include=libvulkan1,mesa-vulkan-drivers bookworm ROOT

Example:
  deploy/bundle.sh && scp out/bundle/sundial-bench.tar.gz there:"

readonly most_mib=60
# The C library belongs to the system, the Vulkan loader to its driver.
readonly systems='^(linux-vdso|ld-linux-x86-64|libc|libm|libdl|librt|libpthread|libvulkan)\.so'
# A Mesa driver uses the C++ library too, and may need a newer one than ours: the system's comes first.
readonly second='^(libstdc\+\+|libgcc_s)\.so'

die() {
  echo "bundle.sh: $1" >&2
  exit "${2:-1}"
}

root='' directory=''
while (($#)); do
  case $1 in
    -h | --help) echo "$usage" && exit 0 ;;
    --check) (($# > 1)) || die "--check wants a folder" 2
      root=$(realpath "$2") && shift ;;
    -*) die "there is no '$1'; see deploy/bundle.sh --help" 2 ;;
    *) directory=$(realpath "$1") ;;
  esac
  shift
done
[[ -z $root || -x $root/bin/sh ]] || die "--check: $root is no root of a system" 2

cd "$(dirname "${BASH_SOURCE[0]}")/.."
directory=${directory:-$PWD/out/bundle}
readonly bundle=$directory/sundial-bench program=build/release/bin/sundial-bench

# shellcheck disable=SC2016  # $ORIGIN is the loader's, not the shell's
pack() {
  rm -rf "$bundle"
  mkdir -p "$bundle"/{bin,lib/second,licences}
  install -m 755 "$program" "$bundle/bin/"
  install -m 755 deploy/bundle/sundial-bench "$bundle/"
  cp LICENSE "$bundle/licences/sundial"

  local name file
  while read -r name file; do
    [[ ! $name =~ $systems ]] || continue
    if [[ $name =~ $second ]]; then
      install -m 644 "$file" "$bundle/lib/second/$name"
    else
      install -m 644 "$file" "$bundle/lib/$name"
      patchelf --set-rpath '$ORIGIN' "$bundle/lib/$name"
    fi
    # Where it comes from, and on what terms.
    local package
    package=$(dpkg-query -S "*/$(basename "$(realpath "$file")")" | sed 's/:.*//' | head -n 1)
    cp "/usr/share/doc/$package/copyright" "$bundle/licences/$package"
  done < <(ldd "$program" | awk '$2 == "=>" {print $1, $3}')

  find "$bundle/lib" -type f -exec strip --strip-unneeded {} +
  strip "$bundle/bin/sundial-bench"
  patchelf --set-rpath '$ORIGIN/../lib' "$bundle/bin/sundial-bench"
  tar -C "$directory" --sort=name --owner=0 --group=0 --numeric-owner -czf "$bundle.tar.gz" sundial-bench
}

# Every library is the system's or comes from the bundle.
check_libraries() {
  local name file
  while read -r name file; do
    [[ $name =~ $systems || $name =~ $second || $file == "$1"/* ]] || die "$name comes from '$file'"
  done < <(env -i ldd "$1/bin/sundial-bench" | awk '$2 == "=>" {print $1, $3}')
}

readonly trial=(--scene builtin:grid --size 64x64 --repetitions 1 --measures)

# From the archive, in another folder, with an empty environment.
check_here() {
  local place
  place=$(mktemp -d)
  tar -C "$place" -xzf "$bundle.tar.gz"
  mv "$place/sundial-bench" "$place/moved"
  check_libraries "$place/moved"
  (cd / && env -i "$place/moved/sundial-bench" "${trial[@]}") | wc -l |
    sed 's/$/ methods ran from another folder/'
  rm -rf "$place"
}

# Under another root, with its own view of mounts: /proc for the loader's $ORIGIN, /dev for a GPU.
check_there() {
  local as_root=() place=tmp/sundial-bundle.$$ status=0
  ((EUID == 0)) || as_root=(sudo)
  "${as_root[@]}" mkdir "$root/$place"
  "${as_root[@]}" tar -C "$root/$place" -xzf "$bundle.tar.gz"
  # shellcheck disable=SC2016  # for the shell within
  "${as_root[@]}" unshare --mount sh -c '
      root=$1 program=$2 && shift 2
      mount -t proc proc "$root/proc" && mount --rbind /dev "$root/dev" &&
        exec chroot "$root" /usr/bin/env -i "$program" "$@"' \
    sh "$root" "/$place/sundial-bench/sundial-bench" "${trial[@]}" | wc -l |
    sed "s|\$| methods ran under $root|" || status=$?
  "${as_root[@]}" rm -rf "${root:?}/$place"
  return "$status"
}

deploy/packages.sh build run bundle
deploy/build.sh release sundial-bench
pack
mib=$(du -sm --apparent-size "$bundle" | cut -f1)
((mib < most_mib)) || die "the bundle has $mib MiB, and may have $most_mib"
check_here
[[ -z $root ]] || check_there
echo "$bundle: $mib MiB, packed $(($(stat -c %s "$bundle.tar.gz") >> 20)) MiB"
