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
# Left out are the three that look at the sources, which have not changed since, and what the program does the same for
# instrumented or not. Renderings that differ by their kernels alone are not even built there.
build_and_test asan --exclude-regex '^(walls|headers|scenes)$|^(FullDisk|LitScenes)\.'
