# ppm_embed_text(VARIABLE INPUT FILE HEADER H NAMESPACE NS NAME N): VARIABLE is a source file, made anew whenever FILE
# changes, that defines `const std::string_view NS::N`, which H declares, as the file's bytes.
# Script mode (-P): writes that file; INPUT, OUTPUT, HEADER, NAMESPACE and NAME as above.
if(CMAKE_SCRIPT_MODE_FILE)
  file(READ ${INPUT} bytes HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(REGEX REPLACE "((0x..,)(0x..,)(0x..,)(0x..,)(0x..,)(0x..,)(0x..,)(0x..,))" "\\1\n" bytes "${bytes}")
  file(WRITE ${OUTPUT}
    "#include \"${HEADER}\"\n\nnamespace {\nconst unsigned char bytes[] = {\n${bytes}\n};\n}  // namespace\n\nnamespace ${NAMESPACE} {\nconst std::string_view ${NAME}(reinterpret_cast<const char*>(bytes), sizeof bytes);\n}  // namespace ${NAMESPACE}\n")
  return()
endif()

set(PPM_EMBED_TEXT_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(ppm_embed_text VARIABLE)
  cmake_parse_arguments(ARG "" "INPUT;HEADER;NAMESPACE;NAME" "" ${ARGN})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${VARIABLE}.cpp)
  add_custom_command(
    OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DINPUT=${ARG_INPUT} -DOUTPUT=${source} -DHEADER=${ARG_HEADER} -DNAMESPACE=${ARG_NAMESPACE}
            -DNAME=${ARG_NAME} -P ${PPM_EMBED_TEXT_SCRIPT}
    DEPENDS ${ARG_INPUT} ${PPM_EMBED_TEXT_SCRIPT}
    VERBATIM)
  set(${VARIABLE} ${source} PARENT_SCOPE)
endfunction()
