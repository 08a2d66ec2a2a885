# hmlfc_rtl: the decode unit, Verilated once for each entry of HMLFC_RTL_UNITS, and rtl_units().

find_package(ZLIB REQUIRED)  # of FST waves

# The package first, the top with the rest.
set(HMLFC_RTL_PACKAGE "${PROJECT_SOURCE_DIR}/rtl/hmlfc_pkg.sv")
list(REMOVE_ITEM HMLFC_RTL_SOURCES "${HMLFC_RTL_PACKAGE}")
if(EXISTS "${HMLFC_RTL_PACKAGE}")
  list(PREPEND HMLFC_RTL_SOURCES "${PROJECT_SOURCE_DIR}/rtl/waivers.vlt" "${HMLFC_RTL_PACKAGE}")
endif()

# A library needs a source of its own.
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/empty.cpp" "")

# With coverage the code is large, and compiles slowly: no waves then.
option(HMLFC_RTL_COVERAGE "Count lines, branches and toggles of the decode unit" OFF)
set(instruments TRACE_FST)
set(optimise -O3)
set(optimise_slow -O1)
if(HMLFC_RTL_COVERAGE)
  set(instruments COVERAGE)
  set(optimise -O1)
  set(optimise_slow -O0)
endif()

set(HMLFC_RTL_INCLUDES "")
set(HMLFC_RTL_MAKERS "")
set(HMLFC_RTL_LIBRARIES "")
foreach(unit IN LISTS HMLFC_RTL_UNITS)
  string(REPLACE ":" ";" parts "${unit}")
  list(GET parts 0 block_log2)
  list(GET parts 1 max_depth)
  list(GET parts 2 data_bits)
  list(GET parts 3 outstanding)
  math(EXPR beat_bytes "${data_bits} / 8")
  set(prefix "Unit_${block_log2}_${max_depth}_${data_bits}")
  # The warnings of the project do not hold for what Verilator writes.
  add_library(hmlfc_${prefix} STATIC "${CMAKE_CURRENT_BINARY_DIR}/empty.cpp")
  verilate(hmlfc_${prefix}
    SOURCES ${HMLFC_RTL_SOURCES}
    TOP_MODULE hmlfc_decode_unit
    PREFIX ${prefix}
    INCLUDE_DIRS "${PROJECT_SOURCE_DIR}/rtl"
    ${instruments}
    OPT_FAST ${optimise}
    OPT_SLOW ${optimise_slow}
    OPT_GLOBAL -O2
    VERILATOR_ARGS -GBLOCK_LOG2=${block_log2} -GMAX_DEPTH=${max_depth}
      -GAXI_DATA_BITS=${data_bits} -GOUTSTANDING=${outstanding}
      -Wall --x-assign fast --x-initial fast --noassert)
  string(APPEND HMLFC_RTL_INCLUDES "#include \"${prefix}.h\"\n")
  string(APPEND HMLFC_RTL_MAKERS
    "      {\"rtl\", {${block_log2}, ${max_depth}, ${beat_bytes}, ${outstanding}},\n"
    "       &make_unit<${prefix}>},\n")
  list(APPEND HMLFC_RTL_LIBRARIES hmlfc_${prefix})
endforeach()

configure_file(rtl_units.cpp.in rtl_units.cpp @ONLY)
add_library(hmlfc_rtl STATIC "${CMAKE_CURRENT_BINARY_DIR}/rtl_units.cpp")
target_compile_definitions(hmlfc_rtl PRIVATE
  VM_COVERAGE=$<BOOL:${HMLFC_RTL_COVERAGE}> VM_TRACE=$<NOT:$<BOOL:${HMLFC_RTL_COVERAGE}>>)
target_link_libraries(hmlfc_rtl PUBLIC hmlfc_bench ${HMLFC_RTL_LIBRARIES} ZLIB::ZLIB)
