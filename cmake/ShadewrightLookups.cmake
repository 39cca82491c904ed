# Generates the shaders of each combination of the three axes from templates with one include an axis, and the table by which
# the library finds them. Call shadewright_combination for each legal one, then shadewright_lookup_table once.

# One generated shader: TEMPLATE with @parameterization@ etc. of the calling scope, embedded as NAME and listed in LIST as KEY.
macro(_shadewright_generate template name list key)
  if(NOT TARGET shader_${name})
    configure_file("${template}" "${PROJECT_BINARY_DIR}/generated/${name}.${stage}" @ONLY)
    shadewright_shader(shadewright_render "${PROJECT_BINARY_DIR}/generated/${name}.${stage}" NAME ${name})
    set_property(GLOBAL APPEND_STRING PROPERTY shadewright_lookup_includes "#include \"shaders/${name}.h\"\n")
    set_property(GLOBAL APPEND_STRING PROPERTY ${list} "    {\"${key}\", ${name}},\n")
  endif()
endmacro()

function(shadewright_combination parameterization storage filter)
  set(room "${PROJECT_SOURCE_DIR}/src/shadow")
  set_property(GLOBAL APPEND PROPERTY shadewright_combinations ${parameterization}/${storage}/${filter})
  set(stage comp)
  _shadewright_generate("${room}/lookup.comp.in" lookup_${parameterization}_${storage}_${filter} shadewright_lookup_entries
                        ${parameterization}/${storage}/${filter})
  _shadewright_generate("${room}/oracle.comp.in" oracle_${parameterization} shadewright_oracle_entries ${parameterization})
  # Where straight edges bend, casters may be drawn by stages of the parameterization's and a fragment stage of the storage's.
  set(stage frag)
  set(bent "${room}/storage/${storage}/bent.frag.in")
  if(EXISTS "${bent}" AND EXISTS "${room}/parameterization/${parameterization}/bent_fragment.glsl")
    _shadewright_generate("${bent}" bent_${parameterization}_${storage} shadewright_caster_entries ${parameterization}/${storage}.bent)
  endif()
  set(stage comp)
  set(decisions "${room}/storage/${storage}/decisions.comp.in")
  if(EXISTS "${decisions}")
    _shadewright_generate("${decisions}" decisions_${parameterization}_${storage} shadewright_decision_entries
                          ${parameterization}/${storage})
  endif()
  foreach(stage vert tesc tese geom frag)
    set(casters "${room}/storage/${storage}/casters.${stage}.in")
    # A parameterization with a vertex stage of its own draws casters by it.
    if(EXISTS "${casters}" AND NOT EXISTS "${room}/parameterization/${parameterization}/casters.${stage}")
      _shadewright_generate("${casters}" casters_${parameterization}_${storage}_${stage} shadewright_caster_entries
                            ${parameterization}/${storage}.${stage})
    endif()
  endforeach()
endfunction()

function(shadewright_lookup_table)
  foreach(list lookup_includes lookup_entries oracle_entries decision_entries caster_entries)
    get_property(shadewright_${list} GLOBAL PROPERTY shadewright_${list})
  endforeach()
  set(entry "inline constexpr std::pair<std::string_view, std::span<const uint32_t>>")
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/shaders/shaders/lookup_table.h" CONTENT "#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
${shadewright_lookup_includes}
namespace shadewright::shaders {
${entry} lookups[] = {
${shadewright_lookup_entries}};
${entry} oracles[] = {
${shadewright_oracle_entries}};
${entry} decisions[] = {
${shadewright_decision_entries}};
${entry} casters[] = {
${shadewright_caster_entries}};
}
" @ONLY)
endfunction()

# For the test of what callers include: src/shadow/lookup_caller_for_test.comp.in with each look-up there is, embedded in TARGET, and the
# table "shaders/lookup_callers.h", by what is defined and included.
function(shadewright_lookup_callers target)
  set(headers "")
  set(entries "")
  macro(add_caller name)
    configure_file("${PROJECT_SOURCE_DIR}/src/shadow/lookup_caller_for_test.comp.in" "${PROJECT_BINARY_DIR}/generated/${name}.comp" @ONLY)
    shadewright_shader(${target} "${PROJECT_BINARY_DIR}/generated/${name}.comp" NAME ${name})
    string(APPEND headers "#include \"shaders/${name}.h\"\n")
    string(REPLACE "\"" "\\\"" key "${defines}${includes}")
    string(REPLACE "\n" "\\n" key "${key}")
    string(APPEND entries "    {\"${key}\", ${name}},\n")
  endmacro()
  set(defines "")
  get_property(combinations GLOBAL PROPERTY shadewright_combinations)
  foreach(combination ${combinations})
    string(REGEX REPLACE "([^/]+)/([^/]+)/([^/]+)" "#include \"shadow/parameterization/\\1/\\1.glsl\"
#include \"shadow/storage/\\2/\\2.glsl\"
#include \"shadow/filter/\\3/\\3.glsl\"
" includes ${combination})
    string(REPLACE "/" "_" name "caller_${combination}")
    add_caller(${name})
  endforeach()
  set(includes "#include \"shadow/precomputed/precomputed.glsl\"\n")
  foreach(access WINDOWS IMAGE ADDRESS)
    foreach(precision FLOAT DOUBLE)
      set(defines "#define PRECOMPUTED_${access}\n#define PRECOMPUTED_${precision}\n")
      string(TOLOWER caller_precomputed_${access}_${precision} name)
      add_caller(${name})
    endforeach()
  endforeach()
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/shaders/shaders/lookup_callers.h" CONTENT "#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
@headers@
namespace shadewright::shaders {
inline constexpr std::pair<std::string_view, std::span<const uint32_t>> lookup_callers[] = {
@entries@};
}
" @ONLY)
endfunction()
