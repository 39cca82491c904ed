# `cmake --install`: the libraries as shadewright::core and shadewright::render, the headers, and the GLSL that callers include.
include(CMakePackageConfigHelpers)

set(shadewright_package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/shadewright")
set(shadewright_glsl_folder "${CMAKE_INSTALL_DATADIR}/shadewright/glsl")

# One export set a component, so that a user of core loads nothing of render's.
# Debug and release libraries lie side by side: a program links the one that fits its own configuration (see gpu/device.h).
function(shadewright_install_component component)
  set_target_properties(shadewright_${component} PROPERTIES DEBUG_POSTFIX d)
  install(TARGETS shadewright_${component} EXPORT shadewright_${component})
  install(EXPORT shadewright_${component} NAMESPACE shadewright:: FILE shadewright-${component}.cmake
          DESTINATION "${shadewright_package_folder}")
endfunction()

# Headers of layers that are not installed stay out: compare's, and Vulkan's where it was not built.
function(shadewright_install_headers)
  foreach(part ${ARGN})
    if(IS_DIRECTORY "${PROJECT_SOURCE_DIR}/include/shadewright/${part}")
      install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/shadewright/${part}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/shadewright")
    else()
      install(FILES "${PROJECT_SOURCE_DIR}/include/shadewright/${part}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/shadewright")
    endif()
  endforeach()
endfunction()

shadewright_install_component(core)
shadewright_install_headers(allocation.h error.h files.h progress.h geometry image raytrace scene voxel)

if(SHADEWRIGHT_RENDER)
  shadewright_install_component(render)
  shadewright_install_headers(gpu render shadow)

  # What callers include in shaders of their own: each .glsl, and the headers that these share with C++.
  file(GLOB_RECURSE published CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/src"
       "${PROJECT_SOURCE_DIR}/src/*.glsl" "${PROJECT_SOURCE_DIR}/src/shared.h" "${PROJECT_SOURCE_DIR}/src/position_error.h")
  foreach(file ${published})
    get_filename_component(folder "${file}" DIRECTORY)
    install(FILES "${PROJECT_SOURCE_DIR}/src/${file}" DESTINATION "${shadewright_glsl_folder}/${folder}")
  endforeach()
endif()

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/shadewrightConfig.cmake.in" "${PROJECT_BINARY_DIR}/shadewrightConfig.cmake"
                              INSTALL_DESTINATION "${shadewright_package_folder}" PATH_VARS shadewright_glsl_folder)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/shadewrightConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/shadewrightConfig.cmake" "${PROJECT_BINARY_DIR}/shadewrightConfigVersion.cmake"
        DESTINATION "${shadewright_package_folder}")

# The examples, built outside the build tree against an installation of this build, and run. A sanitized static library can't be
# linked into a program without the sanitizer.
if(SHADEWRIGHT_TESTS AND NOT SHADEWRIGHT_SANITIZE)
  set(examples query_reference)
  if(SHADEWRIGHT_RENDER)
    list(APPEND examples own_device)
  endif()
  add_test(NAME examples
           COMMAND ${CMAKE_COMMAND} "-DEXAMPLES=${examples}" "-DBUILD=${PROJECT_BINARY_DIR}" "-DCONFIG=$<CONFIG>" "-DSOURCE=${PROJECT_SOURCE_DIR}"
                   "-DGENERATOR=${CMAKE_GENERATOR}" "-DCOMPILER=${CMAKE_CXX_COMPILER}" "-DLAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}"
                   "-DGLSL=${shadewright_glsl_folder}" -P "${PROJECT_SOURCE_DIR}/tests/examples.cmake")
  set_tests_properties(examples PROPERTIES LABELS render TIMEOUT 600)
endif()
