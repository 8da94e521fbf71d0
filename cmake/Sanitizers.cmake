# AddressSanitizer and UndefinedBehaviorSanitizer for all targets of the build tree.
option(PPM_SANITIZE "Instrument everything with ASan and UBSan" OFF)
option(PPM_FUZZ "Build the fuzzer of the loader, everything instrumented (needs clang)" OFF)

if(PPM_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
    message(FATAL_ERROR "PPM_FUZZ needs clang: add -DCMAKE_CXX_COMPILER=clang++")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)
  set(PPM_SANITIZE ON)
endif()
if(PPM_SANITIZE)
  add_compile_options(-fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all -fno-omit-frame-pointer -O1 -g1)
  add_link_options(-fsanitize=address,undefined)
endif()

# The instrumented build is slow where headers are heavy: these rooms compile several files at a time.
function(ppm_build_instrumented_together)
  if(PPM_SANITIZE AND NOT PPM_FUZZ)
    set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ON)
  endif()
endfunction()

# And these without optimisation, since they hardly compute.
function(ppm_build_instrumented_quickly)
  ppm_build_instrumented_together(${ARGN})
  if(PPM_SANITIZE AND NOT PPM_FUZZ)
    foreach(target ${ARGN})
      target_compile_options(${target} PRIVATE -O0)
    endforeach()
  endif()
endfunction()
