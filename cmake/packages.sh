#!/bin/sh
# Installs the Debian packages that are missing: those that build and run the program, with the argument
# `tests` also those of its tests. Without anything missing it calls nothing and needs no rights.
set -eu

packages="g++ cmake ninja-build glslang-tools spirv-tools libvulkan-dev mesa-vulkan-drivers libglm-dev libfmt-dev
  libcli11-dev nlohmann-json3-dev libtinygltf-dev libdraco-dev libmeshoptimizer-dev libopenimageio-dev openimageio-tools libxxhash-dev libglfw3-dev"
if [ "${1:-}" = tests ]; then
  packages="$packages libgtest-dev libembree-dev vulkan-validationlayers python3 xvfb libxtst-dev"
fi

command -v dpkg-query >/dev/null || {
  echo "packages.sh: this is no Debian; see to the like of these yourself:" $packages >&2
  exit 0
}

missing=""
for package in $packages; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null) || status=absent
  [ "$status" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=""
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null || {
    echo "packages.sh: these packages are missing, and only root can install them:$missing" >&2
    exit 1
  }
  as_root=sudo
fi
echo "Installing$missing"
# A list that fails to refresh may still be good enough: the installation tells.
$as_root apt-get update -q || true
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing </dev/null
