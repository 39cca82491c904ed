# shadewright_shader(TARGET FILE [NAME name] [DEFINES names...]): compiles one GLSL file (WHAT.STAGE or generated) to SPIR-V and embeds it as the
# header "shaders/NAME.h" with `shadewright::shaders::NAME`, a constexpr array of words. NAME defaults to the file's name with
# dots as underscores. Includes are searched in src/ and include/, so that C++ and GLSL share their structs' headers.
find_program(GLSLC glslc REQUIRED)

function(shadewright_shader target file)
  cmake_parse_arguments(arg "" "NAME" "DEFINES" ${ARGN})
  list(TRANSFORM arg_DEFINES PREPEND "-D")
  get_filename_component(source "${file}" ABSOLUTE)
  if(NOT arg_NAME)
    get_filename_component(arg_NAME "${file}" NAME)
    string(REPLACE "." "_" arg_NAME "${arg_NAME}")
  endif()
  set(folder "${PROJECT_BINARY_DIR}/shaders/shaders")
  set(words "${folder}/${arg_NAME}.words")
  file(MAKE_DIRECTORY "${folder}")
  file(WRITE "${folder}/${arg_NAME}.h.in" "#pragma once
#include <cstdint>
namespace shadewright::shaders {
inline constexpr uint32_t ${arg_NAME}[] =
#include \"shaders/${arg_NAME}.words\"
;
}
")
  configure_file("${folder}/${arg_NAME}.h.in" "${folder}/${arg_NAME}.h" COPYONLY)
  add_custom_command(
    OUTPUT "${words}"
    COMMAND ${GLSLC} --target-env=vulkan1.3 -O -Werror -mfmt=c -MD -MF "${words}.d" -MT "${words}"
            ${arg_DEFINES} -I "${PROJECT_SOURCE_DIR}/src" -I "${PROJECT_SOURCE_DIR}/include" -o "${words}" "${source}"
    DEPENDS "${source}"
    DEPFILE "${words}.d"
    COMMENT "Shader ${arg_NAME}"
    VERBATIM)
  # A target of its own: the command may stand in another folder than the library that embeds its result.
  add_custom_target(shader_${arg_NAME} DEPENDS "${words}")
  add_dependencies(${target} shader_${arg_NAME})
endfunction()
