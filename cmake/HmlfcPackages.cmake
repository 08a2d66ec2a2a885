# Debian packages (./run package): one for each component that has a name here. CPack finds the libraries that
# programs need (shlibdeps).

get_cmake_property(components COMPONENTS)
if("Unspecified" IN_LIST components)
  message(FATAL_ERROR "an install() without COMPONENT: its files would be in no package")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The HMLFC authors")
set(CPACK_PACKAGE_CONTACT "HMLFC maintainers <maintainers@hmlfc.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # or it would begin every description
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
# `cpack` takes what is built; ./run package builds it before.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(exact "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
file(STRINGS vectors/manifest.json suite REGEX "vectors_version")
string(REGEX REPLACE ".*: \"(.*)\".*" "\\1" suite "${suite}")

# hmlfc_package(COMPONENT NAME SECTION SUMMARY TEXT): TEXT is the rest of the description.
function(hmlfc_package component name section summary text)
  string(TOUPPER ${component} upper)
  foreach(setting
      "CPACK_DEBIAN_${upper}_PACKAGE_NAME=${name}"
      "CPACK_DEBIAN_${upper}_PACKAGE_SECTION=${section}"
      "CPACK_DEBIAN_${upper}_DESCRIPTION=${summary}\n${text}")
    string(REGEX MATCH "^([A-Z_]+)=(.*)$" _ "${setting}")
    set(${CMAKE_MATCH_1} "${CMAKE_MATCH_2}" PARENT_SCOPE)
  endforeach()
  install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${name}" RENAME copyright
    COMPONENT ${component})
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
endfunction()

set(soversion "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
hmlfc_package(library libhmlfc${soversion} libs "random access to light fields: shared library"
  "Decodes and encodes HMLFC streams of version 1 and renders frames of them.")
hmlfc_package(dev libhmlfc-dev libdevel "random access to light fields: C++ and C headers"
  "Headers, static libraries, CMake package and pkg-config file.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "libhmlfc${soversion} ${exact}, libexpected-dev, libopenjp2-7-dev, libtbb-dev, libhwy-dev")
hmlfc_package(tools hmlfc graphics "random access to light fields: command line"
  "Encodes, decodes, renders, converts and inspects light fields, and checks\ndecoders of the format.")
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS "hmlfc-vectors")
hmlfc_package(vectors hmlfc-vectors science "random access to light fields: conformance suite ${suite}"
  "Streams with the samples and errors that decoders must give, their documents,\nand a slow decoder in Python.")
set(CPACK_DEBIAN_VECTORS_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_VECTORS_PACKAGE_SUGGESTS "hmlfc, python3")
hmlfc_package(rtl hmlfc-rtl electronics "random access to light fields: decode unit in SystemVerilog"
  "The decode unit, its driver in C, and the checker that runs the golden model\nin a simulation.")
if(TARGET hmlfc_python)
  hmlfc_package(python python3-hmlfc python "random access to light fields: package for Python"
    "Views and parts of views as NumPy arrays.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3-numpy")
endif()

include(CPack)
