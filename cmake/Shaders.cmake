# ppm_add_shaders(TARGET NAMES NAME... [PLAIN NAME...]): compiles shaders/NAME.comp (or DIRECTORY/NAME.comp) to
# SPIR-V, simplifies it with spirv-opt, checks it with spirv-val and embeds it in the static library TARGET.
#
# Each shader becomes a `const ppm::gpu::Shader ppm::shaders::NAME` declared in the generated header TARGET.hpp;
# the .spv files stay in the build tree for reading. A touched include rebuilds just the shaders that use it (depfile).
# Those of PLAIN are compiled once more, with PPM_PLAIN_SCENE defined (shaders/lib/scene_kinds.glsl), as NAME_plain.
find_program(PPM_GLSLANG glslangValidator REQUIRED)
find_program(PPM_SPIRV_VAL spirv-val REQUIRED)
find_program(PPM_SPIRV_OPT spirv-opt REQUIRED)

function(ppm_add_shaders TARGET)
  cmake_parse_arguments(ARG "" "DIRECTORY" "NAMES;PLAIN" ${ARGN})
  if(NOT ARG_DIRECTORY)
    set(ARG_DIRECTORY ${PROJECT_SOURCE_DIR}/shaders)
  endif()
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${TARGET}.spirv)
  file(MAKE_DIRECTORY ${out})
  set(declarations "")
  set(sources "")
  set(variants ${ARG_PLAIN})
  list(TRANSFORM variants APPEND "_plain")
  foreach(variant IN LISTS ARG_NAMES variants)
    set(name ${variant})
    set(definitions "")
    if(variant IN_LIST variants)
      string(REGEX REPLACE "_plain$" "" name ${variant})
      set(definitions -DPPM_PLAIN_SCENE)
    endif()
    set(spv ${out}/${variant}.spv)
    add_custom_command(
      OUTPUT ${spv}
      COMMAND ${PPM_GLSLANG} --quiet --target-env vulkan1.2 ${definitions} -I${PROJECT_SOURCE_DIR}/shaders
              --depfile ${spv}.d -o ${spv} ${ARG_DIRECTORY}/${name}.comp
      COMMAND ${CMAKE_COMMAND} -DSPIRV_OPT=${PPM_SPIRV_OPT} -DFILE=${spv} -P ${PROJECT_SOURCE_DIR}/cmake/OptimizeSpirv.cmake
      COMMAND ${PPM_SPIRV_VAL} --target-env vulkan1.2 --scalar-block-layout ${spv}
      DEPENDS ${ARG_DIRECTORY}/${name}.comp ${PROJECT_SOURCE_DIR}/cmake/OptimizeSpirv.cmake
      DEPFILE ${spv}.d
      VERBATIM)
    add_custom_command(
      OUTPUT ${out}/${variant}.cpp
      COMMAND ${CMAKE_COMMAND} -DINPUT=${spv} -DOUTPUT=${out}/${variant}.cpp -DVARIANT=${variant} -DNAME=${name}
              -DHEADER=${TARGET}.hpp
              -P ${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake
      DEPENDS ${spv} ${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake
      VERBATIM)
    list(APPEND sources ${out}/${variant}.cpp)
    string(APPEND declarations "extern const ppm::gpu::Shader ${variant};\n")
  endforeach()
  file(CONFIGURE OUTPUT ${out}/${TARGET}.hpp CONTENT
    "// Generated: the shaders of ${TARGET} as SPIR-V.\n#pragma once\n#include \"shader.hpp\"\n\nnamespace ppm::shaders {\n@declarations@}  // namespace ppm::shaders\n" @ONLY)
  add_library(${TARGET} STATIC ${sources})
  target_include_directories(${TARGET} PUBLIC ${out})
  target_link_libraries(${TARGET} PUBLIC ppm_shader_type)
endfunction()
