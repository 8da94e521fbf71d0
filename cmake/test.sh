#!/bin/sh
# Installs what is missing, then builds and runs all tests twice: optimised, and under AddressSanitizer and UBSan.
# Stops with a non-zero status at the first part that fails.
set -eu
cd "$(dirname "$0")/.."

sh cmake/packages.sh tests
# Other versions format otherwise.
if command -v clang-format >/dev/null && clang-format --version | grep -q "version 14"; then
  git ls-files '*.cpp' '*.hpp' '*.h' | xargs clang-format --dry-run -Werror
fi

build_and_test() {
  preset=$1
  shift
  echo "== $preset"
  cmake --preset "$preset"
  cmake --build --preset "$preset"
  ctest --test-dir "build/$preset" --output-on-failure --no-tests=error --parallel 2 "$@"
}

build_and_test ci
# Left out are the three that look at the sources, which have not changed since, and renderings and tables that differ by
# their scenes or methods alone, or are made again: what the host does is the same for all, and kernels are not instrumented.
same_host_code='Albedos|All|Balls|Cameras|Ceilings|Coatings|Cones|Finishes|Glasses|Guests|Interfaces|Kinds|Panes|Scenes|Skies|Vessels'
repetitions='Methods/Reproducible|Methods/PlannedMemory|Repeat|Invariance'
pictures='Bdpt|CoatedLamp|Convergence|Coverage|Depth|Energy|Environments|Gather|Lights|LitScenes|Media|MirrorImage|Mlt|Nearest|PhotonMap|PhotonMapOfRoom|Room|RoughGlass|ShadingNormals|SkyView|UnlitPictures'
build_and_test asan --exclude-regex "^(walls|headers|scenes)\$|^($same_host_code|Table/Agreement.*)/|^($pictures|$repetitions|FullDisk)\."
