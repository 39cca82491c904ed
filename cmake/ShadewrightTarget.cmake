# Settings that every target of the project shares, and the two ways to add one: a layer of the library, and a test.

add_library(shadewright_options INTERFACE)
target_compile_features(shadewright_options INTERFACE cxx_std_20)
target_compile_options(shadewright_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Werror -ffp-contract=off)
target_compile_definitions(shadewright_options INTERFACE GLM_FORCE_DEPTH_ZERO_TO_ONE GLM_FORCE_EXPLICIT_CTOR)
if(SHADEWRIGHT_SANITIZE)
  target_compile_options(shadewright_options INTERFACE -fsanitize=${SHADEWRIGHT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(shadewright_options INTERFACE -fsanitize=${SHADEWRIGHT_SANITIZE})
endif()

# shadewright_test(NAME SOURCES... LIBRARIES... LABELS... [PRECOMPILED headers... | REUSE test]): one GoogleTest program, its cases
# registered with ctest one by one. REUSE takes the precompiled headers of another test.
function(shadewright_test name)
  if(NOT SHADEWRIGHT_TESTS)
    return()
  endif()
  cmake_parse_arguments(arg "" "REUSE" "SOURCES;LIBRARIES;LABELS;PRECOMPILED" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)  # what is tested is optimized; the tests build sooner
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} shadewright_options GTest::gtest_main)
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/src")
  if(arg_PRECOMPILED)
    target_precompile_headers(${name} PRIVATE ${arg_PRECOMPILED})
  elseif(arg_REUSE)
    target_precompile_headers(${name} REUSE_FROM ${arg_REUSE})
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES LABELS "${arg_LABELS}" TIMEOUT 600)
endfunction()
