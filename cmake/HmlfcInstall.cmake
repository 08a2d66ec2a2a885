# cmake --install: headers, library, binary, CMake package and pkg-config file.

include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/hmlfc")

install(TARGETS hmlfc EXPORT hmlfc-targets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(DIRECTORY model/include/hmlfc
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")
install(EXPORT hmlfc-targets NAMESPACE hmlfc:: DESTINATION "${package_dir}")

if(TARGET hmlfc_cli)
  file(RELATIVE_PATH library_from_binary
    "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}")
  set_target_properties(hmlfc_cli PROPERTIES INSTALL_RPATH "$ORIGIN/${library_from_binary}")
  install(TARGETS hmlfc_cli RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()

configure_package_config_file(cmake/hmlfc-config.cmake.in
  "${CMAKE_CURRENT_BINARY_DIR}/hmlfc-config.cmake"
  INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/hmlfc-config-version.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${CMAKE_CURRENT_BINARY_DIR}/hmlfc-config.cmake"
  "${CMAKE_CURRENT_BINARY_DIR}/hmlfc-config-version.cmake"
  DESTINATION "${package_dir}")

# A static library hands its own libraries on to whoever links it; a shared one keeps them.
if(BUILD_SHARED_LIBS)
  set(HMLFC_PC_REQUIRES_FIELD "Requires.private")
else()
  set(HMLFC_PC_REQUIRES_FIELD "Requires")
endif()
file(RELATIVE_PATH HMLFC_PC_PREFIX
  "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" HMLFC_PC_PREFIX "${HMLFC_PC_PREFIX}")
configure_file(cmake/hmlfc.pc.in "${CMAKE_CURRENT_BINARY_DIR}/hmlfc.pc" @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/hmlfc.pc"
  DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
