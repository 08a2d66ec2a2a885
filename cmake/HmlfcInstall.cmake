# cmake --install: headers, static and shared library, binary, CMake package and pkg-config file,
# the conformance suite with its documents, the decode unit with its integration kit, and the checker for simulators.
# The components library, dev, tools, vectors, python and rtl are Debian packages of HmlfcPackages.cmake.

include(CMakePackageConfigHelpers)

# ./run builds only what its command needs.
install(CODE "if(NOT EXISTS \"$<TARGET_FILE:hmlfc_shared>\")
  message(FATAL_ERROR \"First build what is installed: cmake --build ${PROJECT_BINARY_DIR} --target hmlfc_installed\")
endif()" COMPONENT dev)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/hmlfc")

# Sets of their own: a user of one needs neither the file nor the dependencies of the other.
foreach(kind static shared)
  set(target hmlfc)
  if(kind STREQUAL "shared")
    set(target hmlfc_shared)
  endif()
  install(TARGETS ${target} EXPORT hmlfc-${kind}
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library NAMELINK_COMPONENT dev
    INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
  install(EXPORT hmlfc-${kind} NAMESPACE hmlfc:: DESTINATION "${package_dir}" COMPONENT dev)
endforeach()
if(HMLFC_GPU)
  install(TARGETS hmlfc_gpu EXPORT hmlfc-gpu
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev
    INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
  install(EXPORT hmlfc-gpu NAMESPACE hmlfc:: DESTINATION "${package_dir}" COMPONENT dev)
  install(DIRECTORY gpu_ref/include/hmlfc DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT dev)
endif()
if(NOT tl-expected_FOUND)
  install(DIRECTORY fallback/tl-expected/tl DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT dev)
endif()
if(HMLFC_WGSL)
  install(DIRECTORY "${HMLFC_WGSL}/" DESTINATION "${CMAKE_INSTALL_DATADIR}/hmlfc/wgsl" COMPONENT tools)
endif()
install(DIRECTORY model/include/hmlfc
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT dev
  FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")

# What find_package and pkg-config look for with the library: what this build has found.
set(HMLFC_DEPENDENCIES "")
set(HMLFC_PC_REQUIRES libopenjp2)
foreach(found TBB=tbb hwy=libhwy)
  string(REPLACE "=" ";" names ${found})
  list(POP_FRONT names name)
  if(${name}_TARGET AND ${name}_FOUND)
    list(APPEND HMLFC_DEPENDENCIES ${name})
    list(APPEND HMLFC_PC_REQUIRES ${names})
  endif()
endforeach()
list(JOIN HMLFC_PC_REQUIRES " " HMLFC_PC_REQUIRES)
configure_package_config_file(cmake/hmlfc-config.cmake.in
  "${CMAKE_CURRENT_BINARY_DIR}/hmlfc-config.cmake"
  INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/hmlfc-config-version.cmake"
  COMPATIBILITY SameMajorVersion)
install(FILES
  "${CMAKE_CURRENT_BINARY_DIR}/hmlfc-config.cmake"
  "${CMAKE_CURRENT_BINARY_DIR}/hmlfc-config-version.cmake"
  DESTINATION "${package_dir}" COMPONENT dev)

file(RELATIVE_PATH HMLFC_PC_PREFIX
  "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" HMLFC_PC_PREFIX "${HMLFC_PC_PREFIX}")
configure_file(cmake/hmlfc.pc.in "${CMAKE_CURRENT_BINARY_DIR}/hmlfc.pc" @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/hmlfc.pc"
  DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT dev)

if(NOT HMLFC_TOOLS)
  return()
endif()
if(TARGET hmlfc_cli)
  install(TARGETS hmlfc_cli RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT tools)
  # The conformance suite, which the program finds there.
  install(DIRECTORY vectors DESTINATION "${CMAKE_INSTALL_DATADIR}/hmlfc" COMPONENT vectors)
  install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/hmlfc/vectors" COMPONENT vectors)
endif()

# The package for Python, where Debian's interpreter looks for it if the prefix is /usr.
if(TARGET hmlfc_python)
  set(python_dir "lib/python3/dist-packages/hmlfc")
  install(TARGETS hmlfc_python LIBRARY DESTINATION "${python_dir}" COMPONENT python)
  install(DIRECTORY tools/python/hmlfc/ DESTINATION "${python_dir}" COMPONENT python
    FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
endif()

# For simulators (docs/checker.md): the golden model behind DPI-C, the checker and its example.
if(TARGET hmlfc_dpi_shared)
  install(TARGETS hmlfc_dpi_shared LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT rtl)
  install(FILES tools/dut/hmlfc_checker.h
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/hmlfc" COMPONENT rtl)
  install(DIRECTORY testbench/checker/ DESTINATION "${CMAKE_INSTALL_DATADIR}/hmlfc/checker"
    COMPONENT rtl)
endif()

# From nothing to a claim (docs/conformance.md): documents, examples of decoders, and the slow decoder
# that one of them runs. The folders are those of the repository, so that links lead somewhere.
install(PROGRAMS examples/line_decoder.py examples/primitives.py
  DESTINATION "${CMAKE_INSTALL_DATADIR}/hmlfc/examples" COMPONENT vectors)
install(DIRECTORY examples/primitives
  DESTINATION "${CMAKE_INSTALL_DATADIR}/hmlfc/examples" COMPONENT vectors)
install(FILES examples/other_decoder.cpp examples/other_decoder.h examples/wrap_decoder.c
  DESTINATION "${CMAKE_INSTALL_DATADIR}/hmlfc/examples" COMPONENT vectors)
install(FILES
  docs/conformance.md docs/line_protocol.md docs/primitives.md docs/specification.md
  DESTINATION "${CMAKE_INSTALL_DATADIR}/hmlfc/docs" COMPONENT vectors)
install(DIRECTORY tests/naive_decoder DESTINATION "${CMAKE_INSTALL_DATADIR}/hmlfc/tests" COMPONENT vectors
  FILES_MATCHING PATTERN "*.py" PATTERN "tests" EXCLUDE PATTERN "__pycache__" EXCLUDE)
install(CODE "get_filename_component(DATA
  \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/hmlfc\" ABSOLUTE)" COMPONENT vectors)
install(SCRIPT cmake/UnlinkMissing.cmake COMPONENT vectors)

set(rtl_dir "${CMAKE_INSTALL_DATADIR}/hmlfc/rtl")
install(FILES
  ${HMLFC_RTL_HEADERS}
  rtl/hmlfc_decode_unit.core
  rtl/hmlfc_decode_unit.f
  rtl/hmlfc_pkg.sv
  rtl/registers.json
  rtl/view_registers.json
  rtl/waivers.vlt
  DESTINATION "${rtl_dir}" COMPONENT rtl)
install(DIRECTORY rtl/lib rtl/unit rtl/view rtl/driver rtl/example DESTINATION "${rtl_dir}" COMPONENT rtl)
install(FILES
  ${HMLFC_RTL_ASSERTIONS}
  rtl/kit/hmlfc_decode_unit.rdl
  rtl/kit/hmlfc_decode_unit.sdc
  rtl/kit/hmlfc_view_queue.rdl
  DESTINATION "${rtl_dir}/kit" COMPONENT rtl)

# What the rules above install.
add_custom_target(hmlfc_installed)
foreach(target hmlfc hmlfc_shared hmlfc_gpu hmlfc_cli hmlfc_python hmlfc_dpi_shared hmlfc_wgsl hmlfc_site)
  if(TARGET ${target})
    add_dependencies(hmlfc_installed ${target})
  endif()
endforeach()
