# Warnings for every target of this project; fatal where PPM_WARNINGS_ARE_ERRORS says so (the presets do).
option(PPM_WARNINGS_ARE_ERRORS "Stop the build at the first warning" OFF)

add_library(ppm_warnings INTERFACE)
target_compile_options(ppm_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                       $<$<BOOL:${PPM_WARNINGS_ARE_ERRORS}>:-Werror>)
# GCC 12 warns of string and vector operations in its own library that cannot happen (GCC bugs 105329, 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(ppm_warnings INTERFACE -Wno-restrict -Wno-stringop-overflow)
endif()
