#!/usr/bin/env bash
# The tests from nothing: packages, a build, ctest.
set -euo pipefail

readonly usage="Usage: deploy/test.sh [release | debug | asan | tsan]
Installs what is missing (as root, or through sudo), builds and runs the tests.

  release  (the default)  all tests, optimised
  debug                   all tests, with assertions
  asan                    all tests under AddressSanitizer and UndefinedBehaviorSanitizer
  tsan                    the service's tests under ThreadSanitizer

  SUNDIAL_SCENES   another folder of real scenes than ../shared/scenes"

preset=${1:-release}
case $preset in
  release | debug | asan | tsan) ;;
  -h | --help) echo "$usage" && exit 0 ;;
  *) echo "test.sh: there is no preset '$preset'; see deploy/test.sh --help" >&2 && exit 2 ;;
esac
began=$SECONDS
cd "$(dirname "${BASH_SOURCE[0]}")/.."

targets=() selection=()
if [[ $preset == tsan ]]; then
  targets=(service_tests)
  selection=(--label-regex '^service$')
fi
deploy/packages.sh build run test
deploy/build.sh "$preset" "${targets[@]}"

status=0
ctest --preset "$preset" --output-on-failure --parallel 2 "${selection[@]}" || status=$?
echo "deploy/test.sh $preset: $((SECONDS - began)) s, $( ((status == 0)) && echo passed || echo FAILED)"
exit "$status"
