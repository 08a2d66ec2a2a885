# HMLFC_RTL_SOURCES: the files of the decode unit in the order of their list, rtl/hmlfc_decode_unit.f.
# HMLFC_RTL_HEADERS: those that they include. HMLFC_RTL_ASSERTIONS: the rules of the channels, and where they hold.

set(rtl "${PROJECT_SOURCE_DIR}/rtl")
file(STRINGS "${rtl}/hmlfc_decode_unit.f" HMLFC_RTL_SOURCES REGEX "^[^/+]")
file(STRINGS "${rtl}/hmlfc_decode_unit.f" HMLFC_RTL_HEADERS REGEX "^// included: ")
list(TRANSFORM HMLFC_RTL_HEADERS REPLACE "^// included: " "")
list(TRANSFORM HMLFC_RTL_SOURCES PREPEND "${rtl}/")
list(TRANSFORM HMLFC_RTL_HEADERS PREPEND "${rtl}/")
set_property(DIRECTORY "${PROJECT_SOURCE_DIR}" APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  "${rtl}/hmlfc_decode_unit.f")
file(GLOB HMLFC_RTL_ASSERTIONS CONFIGURE_DEPENDS "${rtl}/kit/*_assertions.sv")
