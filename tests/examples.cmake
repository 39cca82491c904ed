# The ctest "examples": installs this build, then configures, builds and runs each example against the installation, as a user
# would. Called with EXAMPLES, BUILD, CONFIG, SOURCE, GENERATOR, COMPILER, LAUNCHER and GLSL (where the shaders go below the prefix).
cmake_minimum_required(VERSION 3.25)

set(work "${BUILD}/examples_test")
set(prefix "${work}/prefix")

# Runs a command, keeps what it prints in `output`, and ends the test with it if the command fails.
macro(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${what} failed (${result}):\n${output}")
  endif()
endmacro()

file(REMOVE_RECURSE "${work}")
run("install" ${CMAKE_COMMAND} --install "${BUILD}" --config "${CONFIG}" --prefix "${prefix}")

# Each file that published GLSL includes must be published too.
file(GLOB_RECURSE published "${prefix}/${GLSL}/*")
foreach(file ${published})
  file(STRINGS "${file}" includes REGEX "^#include \"")
  foreach(line ${includes})
    string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${line}")
    if(NOT EXISTS "${prefix}/${GLSL}/${included}")
      message(FATAL_ERROR "${file} includes ${included}, which is not installed; see cmake/ShadewrightInstall.cmake")
    endif()
  endforeach()
endforeach()

# The layer prints to standard output; with it, each message about a misuse or a race of the device is seen.
set(ENV{VK_INSTANCE_LAYERS} VK_LAYER_KHRONOS_validation)
set(ENV{VK_LAYER_ENABLES} VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT)
foreach(example ${EXAMPLES})
  set(folder "${work}/${example}")
  run("configuring ${example}" ${CMAKE_COMMAND} -S "${SOURCE}/examples/${example}" -B "${folder}" -G "${GENERATOR}"
      "-DCMAKE_BUILD_TYPE=${CONFIG}" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}"
      "-DCMAKE_PREFIX_PATH=${prefix}" "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Wconversion -Werror")
  if(example STREQUAL "query_reference")
    file(STRINGS "${folder}/CMakeCache.txt" vulkan REGEX "Vulkan")
    if(vulkan)
      message(FATAL_ERROR "core alone looked for Vulkan: ${vulkan}")
    endif()
  endif()
  run("building ${example}" ${CMAKE_COMMAND} --build "${folder}" --config "${CONFIG}")
  run("${example}" "${folder}/${example}")
  message("${output}")
  if(output MATCHES "Validation (Error|Warning)|VUID-|SYNC-HAZARD")
    message(FATAL_ERROR "${example}: the validation layer spoke")
  endif()
endforeach()
