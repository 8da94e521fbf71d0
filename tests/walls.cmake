# Fails where an include leaves its room by path, where a library is used outside the room that hides it, or where a source
# does not begin with its own header, which shows that the header needs nothing before it.
# Script mode: SOURCE is the repository.
set(faults "")

# A header's beginning and the only rooms that may name it.
set(owned
  "CLI/=cli" "OpenImageIO/=image|scene" "OpenEXR/=" "tiny_gltf=scene" "draco/=scene" "meshoptimizer=scene" "vulkan/=gpu"
  "nlohmann/=bench|cli|compare|render|scene" "embree3/=" "xxhash=base" "GLFW/=view" "GL/=")

file(GLOB_RECURSE files RELATIVE ${SOURCE} ${SOURCE}/host/*.hpp ${SOURCE}/host/*.cpp
     ${SOURCE}/shaders/*.h ${SOURCE}/shaders/*.glsl ${SOURCE}/shaders/*.comp)
list(LENGTH files count)
if(count LESS 20)
  message(FATAL_ERROR "only ${count} files are found in ${SOURCE}")
endif()

foreach(file IN LISTS files)
  file(STRINGS ${SOURCE}/${file} includes REGEX "^[ \t]*#[ \t]*include")
  string(REGEX REPLACE "[.]cpp$" ".hpp" header ${file})
  if(file MATCHES "[.]cpp$" AND EXISTS ${SOURCE}/${header})
    cmake_path(GET header FILENAME header)
    list(GET includes 0 first)
    if(NOT first STREQUAL "#include \"${header}\"")
      list(APPEND faults "${file}: ${first}: its own header, ${header}, comes first")
    endif()
  endif()
  foreach(include IN LISTS includes)
    if(include MATCHES "\"\\.|/\\.\\.?/")
      list(APPEND faults "${file}: ${include}: a path instead of a room's file name")
    endif()
    if(file MATCHES "^shaders/shared/" AND include MATCHES "\"" AND NOT include MATCHES "\"shared/")
      list(APPEND faults "${file}: ${include}: shared text includes only itself")
    endif()
    foreach(entry IN LISTS owned)
      string(REGEX MATCH "^([^=]*)=(.*)$" ignored "${entry}")
      set(header "${CMAKE_MATCH_1}")
      set(rooms "${CMAKE_MATCH_2}")
      string(REGEX MATCH "include[ \t]*[<\"]${header}" uses "${include}")
      if(uses AND NOT file MATCHES "^host/(${rooms})/")
        list(APPEND faults "${file}: ${include}: belongs to host/${rooms}")
      endif()
    endforeach()
  endforeach()
endforeach()

if(faults)
  list(JOIN faults "\n  " text)
  message(FATAL_ERROR "walls broken:\n  ${text}")
endif()
message(STATUS "${count} files keep within their rooms")
