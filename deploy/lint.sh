#!/usr/bin/env bash
# Formatting, static analysis and shell scripts, checked. Anything found is an error.
set -euo pipefail

readonly usage="Usage: deploy/lint.sh [FILE]...
Checks the formatting of all C++ (clang-format 14), all shell scripts (shellcheck) and, by clang-tidy, the
C++ files named, or all. Needs a release build (deploy/build.sh release), whose commands it reads.

Example:
  deploy/lint.sh \$(git diff --name-only main -- '*.cpp')"

case ${1:-} in
  -h | --help) echo "$usage" && exit 0 ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."
deploy/packages.sh build lint
# What the compile commands name must be there: generated headers too.
deploy/build.sh release sundial_shader_headers sundial_proto

files=("$@")
((${#files[@]})) || mapfile -t files < <(git ls-files '*.cpp')

status=0
git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run -Werror || status=1
git ls-files '*.sh' .ci/run deploy/bundle/sundial-bench | xargs shellcheck || status=1
# clang-tidy 14, Debian's own choice, can't read GCC 12's <expected>.
printf '%s\n' "${files[@]}" |
  xargs -P "$(nproc)" -n 4 clang-tidy-19 -p build/release --quiet 2> >(grep -vE '^[0-9]+ warnings' >&2) || status=1
((status == 0)) || { echo "lint.sh: found something; see above" >&2 && exit 1; }
echo "lint.sh: ${#files[@]} files are clean"
