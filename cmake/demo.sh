#!/bin/sh
# From a clone to a picture: installs what is missing, builds, and renders scenes/box.glb to box.png and box.exr
# in the repository's root, in about two minutes of rendering on two cores.
set -eu
cd "$(dirname "$0")/.."

sh cmake/packages.sh
cmake --preset release
cmake --build --preset release

echo "Rendering scenes/box.glb: 640 x 480, 4 eye paths a pixel, 256 passes of 100000 photon paths"
build/release/host/ppm-vk render scenes/box.glb --passes 256 -o box.png -o box.exr
echo "The pictures: $PWD/box.png (display), $PWD/box.exr (linear radiance)"
