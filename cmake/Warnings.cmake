# Warnings for every target of this project; fatal where PPM_WARNINGS_ARE_ERRORS says so (the presets do).
option(PPM_WARNINGS_ARE_ERRORS "Stop the build at the first warning" OFF)

add_library(ppm_warnings INTERFACE)
target_compile_options(ppm_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                       $<$<BOOL:${PPM_WARNINGS_ARE_ERRORS}>:-Werror>)
