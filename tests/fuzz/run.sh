#!/bin/sh
# Builds the fuzzer of the loader in build/fuzz and runs it: `sh tests/fuzz/run.sh [SECONDS]` (600). What it finds
# lies in build/fuzz/findings; minimise it with -minimize_crash=1, mend the cause and keep the file in
# tests/fuzz/findings, which the test fuzz_replay feeds to every build.
set -eu
cd "$(dirname "$0")/../.."

cmake -S . -B build/fuzz -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=clang++ -DPPM_FUZZ=ON
cmake --build build/fuzz --target ppm_fuzz_gltf ppm_fuzz_replay
mkdir -p build/fuzz/corpus build/fuzz/findings
build/fuzz/tests/fuzz/ppm_fuzz_replay --write build/fuzz/seeds
# Reports go to a file: stderr is shut while an image is decoded.
ASAN_OPTIONS=log_path=build/fuzz/findings/report:allocator_may_return_null=0 \
  build/fuzz/tests/fuzz/ppm_fuzz_gltf -max_total_time="${1:-600}" -max_len=16384 -len_control=0 -timeout=10 \
  -rss_limit_mb=2000 -malloc_limit_mb=1000 -artifact_prefix=build/fuzz/findings/ build/fuzz/corpus build/fuzz/seeds
