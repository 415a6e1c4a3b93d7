# cmake --install BUILD --prefix X puts there the program, the headers that stand alone, and the
# CMake package `penumbra` with the target penumbra::headers.
include(CMakePackageConfigHelpers)

add_library(penumbra_headers INTERFACE)
add_library(penumbra::headers ALIAS penumbra_headers)
set_target_properties(penumbra_headers PROPERTIES EXPORT_NAME headers)
target_compile_features(penumbra_headers INTERFACE cxx_std_20)
target_include_directories(penumbra_headers INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

set(PENUMBRA_PACKAGE_DIR ${CMAKE_INSTALL_DATADIR}/cmake/penumbra)
install(TARGETS penumbra_headers EXPORT penumbra)
install(EXPORT penumbra NAMESPACE penumbra:: FILE penumbraTargets.cmake
  DESTINATION ${PENUMBRA_PACKAGE_DIR})
configure_package_config_file(cmake/penumbraConfig.cmake.in penumbraConfig.cmake
  INSTALL_DESTINATION ${PENUMBRA_PACKAGE_DIR})
write_basic_package_version_file(penumbraConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${PROJECT_BINARY_DIR}/penumbraConfig.cmake
  ${PROJECT_BINARY_DIR}/penumbraConfigVersion.cmake DESTINATION ${PENUMBRA_PACKAGE_DIR})

install(DIRECTORY include/penumbra DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN *.h)
install(FILES shaders/soft_shadow.glsl DESTINATION ${CMAKE_INSTALL_DATADIR}/penumbra/shaders)
# three.js for previews, where scripts/get-viewer has put it.
install(DIRECTORY ${PROJECT_BINARY_DIR}/share/penumbra/viewer
  DESTINATION ${CMAKE_INSTALL_DATADIR}/penumbra OPTIONAL)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(TARGET penumbra_program)
  install(TARGETS penumbra_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
