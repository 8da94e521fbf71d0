#!/bin/sh
# Builds the scenes in Blender, renders them with Cycles and with ppm-vk and compares the two.
#   run.sh PPM_VK FOLDER [SCENE-VIEW...]       e.g. run.sh build/release/host/ppm-vk /tmp/blender room-wide
# Pictures of Cycles that lie in FOLDER already are kept. PASSES, SEEDS: of ppm-vk, by default 64 and "0 1". PYTHON: one with numpy.
set -e
here=$(cd "$(dirname "$0")" && pwd)
ppm_vk=$1 folder=$2
shift 2
[ $# -gt 0 ] || set -- room-wide room-elevation glass-table yard-yard yard-gate yard-annex

for name in "$@"; do
  scene=${name%-*} view=${name#*-} camera=${name#*-}
  case $name in
    room*) samples=512 exposure=-0.5 more= ;;
    glass*) samples=512 exposure=-1 more= ;;
    # candelas are 683 lm/W times W/sr; the Mapping node turns directions, --env-rotation the map
    yard-annex) samples=512 exposure=-0.5 camera=gate more="--scene annex --luminous-efficacy 683" ;;
    yard*) samples=512 exposure=-0.5
      more="--luminous-efficacy 683 --env $folder/sky.hdr --env-rotation -40 --env-strength 0.7" ;;
  esac
  if [ ! -e "$folder/$name-cycles.exr" ]; then
    blender -b --python-exit-code 1 --python "$here/make.py" -- "$scene" "$folder" \
      --samples $samples --views "$view" > "$folder/$name-blender.log"
  fi
  for seed in ${SEEDS:-0 1}; do
    "$ppm_vk" render "$folder/$scene.glb" -o "$folder/$name-ppm$seed.exr" --width 160 --height 120 --camera "$camera" \
      --passes "${PASSES:-64}" --photons 400000 --spp 16 --seed $seed --quiet $more
  done
  echo "== $name"
  other=$folder/$name-ppm1.exr
  [ -e "$other" ] || other=$folder/$name-ppm0.exr
  "${PYTHON:-python3}" "$here/compare.py" "$folder/$name-cycles.exr" "$folder/$name-ppm0.exr" --other "$other" \
    --exposure=$exposure --png "$folder/$name.png"
done
