#!/usr/bin/env bash
# The main job from nothing: packages, a build, and shadow maps held against ray-traced shadows, into out/.
set -euo pipefail

readonly usage="Usage: deploy/quickstart.sh
Installs what is missing (as root, or through sudo), builds, and compares shadow maps with ray-traced
shadows on a generated scene, and on the real ones of ../shared/scenes where they are. The pages are
out/SCENE/index.html.

  SUNDIAL_SCENES   another folder that holds apartment.glb and jungle.glb"

case ${1:-} in
  '') ;;
  -h | --help) echo "$usage" && exit 0 ;;
  *) echo "quickstart.sh: takes no '$1'; see deploy/quickstart.sh --help" >&2 && exit 2 ;;
esac

began=$SECONDS
here=$(pwd)
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scenes=${SUNDIAL_SCENES:-../shared/scenes}
[[ $scenes == /* || -z ${SUNDIAL_SCENES:-} ]] || scenes=$here/$scenes

deploy/packages.sh build run
deploy/build.sh release sundial sundiald

pages=()
# compare NAME SCENE OPTION...
compare() {
  local name=$1 scene=$2
  shift 2
  echo
  build/release/bin/sundial compare "$scene" -o "out/$name" --size 1024x1024 "$@" \
    --method sm,texels=1024 --method sm,texels=4096 --method dv --method ray-traced
  pages+=("$PWD/out/$name/index.html")
}

compare atrium builtin:atrium
if [[ -f $scenes/apartment.glb ]]; then
  compare apartment "$(realpath "$scenes")/apartment.glb" \
    --eye 12,7,3 --target 6,1,-6 --fov 55 --sun -0.5,-0.8,0.3 \
    --credit '"Apartment layout of a dream house" by Maxim Lukyanov (sketchfab.com), CC-BY-4.0'
fi
if [[ -f $scenes/jungle.glb ]]; then
  compare jungle "$(realpath "$scenes")/jungle.glb" \
    --credit '"Low Poly Environment Jungle Scene" by Lowpolyprincipal (sketchfab.com), CC-BY-4.0'
fi

echo
echo "Done in $((SECONDS - began)) s. Open in a browser:"
printf '  %s\n' "${pages[@]}"
