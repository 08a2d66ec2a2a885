# hmlfc_rtl: the decode unit, Verilated once for each entry of HMLFC_RTL_UNITS, and rtl_units().
# Without Verilator testbench/CMakeLists.txt makes an empty one.

# The first unit that fits a stream decodes it. The tests need one for each block size, and values of
# OUTSTANDING that are no power of two; ./run soak adds MAX_DEPTH = 8, for which the tests have the
# modules of the datapath.
set(units "2:12:128:32" "1:12:64:5" "3:12:128:24")
if(HMLFC_SOAK)
  list(APPEND units "2:8:64:16")
endif()
set(HMLFC_RTL_UNITS "" CACHE STRING
  "BLOCK_LOG2:MAX_DEPTH:AXI_DATA_BITS:OUTSTANDING of each Verilated unit; empty: those of the tests")
if(HMLFC_RTL_UNITS)
  set(units ${HMLFC_RTL_UNITS})
endif()

# Waves double the time that a unit takes to compile, so that only the first has them.
option(HMLFC_RTL_WAVES "The first Verilated unit writes waves of failures" ${HMLFC_SOAK})
option(HMLFC_RTL_COVERAGE "Count lines, branches and toggles of the decode unit; excludes waves" OFF)

# A library needs a source of its own.
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/empty.cpp" "")

# hmlfc_verilate_unit(TARGET PREFIX BLOCK_LOG2:MAX_DEPTH:AXI_DATA_BITS:OUTSTANDING
#                     SOURCES file... [INCLUDE folder] [INSTRUMENT TRACE_FST or COVERAGE]
#                     [ARGUMENTS argument...])
# Verilator's class PREFIX of the unit in the static library TARGET, which is made if need be. Included
# files come from the INCLUDE folder, if it has them.
function(hmlfc_verilate_unit target prefix unit)
  cmake_parse_arguments(PARSE_ARGV 3 arg "" "INCLUDE;INSTRUMENT" "SOURCES;ARGUMENTS")
  string(REPLACE ":" ";" values "${unit}")
  set(parameters "")
  foreach(name value IN ZIP_LISTS HMLFC_UNIT_PARAMETERS values)
    list(APPEND parameters -G${name}=${value})
  endforeach()
  if(NOT TARGET ${target})
    add_library(${target} STATIC "${CMAKE_CURRENT_BINARY_DIR}/empty.cpp")
  endif()
  verilate(${target}
    SOURCES ${arg_SOURCES}
    TOP_MODULE hmlfc_decode_unit
    PREFIX ${prefix}
    INCLUDE_DIRS ${arg_INCLUDE} "${PROJECT_SOURCE_DIR}/rtl"
    ${arg_INSTRUMENT}
    OPT_FAST ${HMLFC_VERILATED_OPTIMISATION}
    OPT_SLOW -O0
    OPT_GLOBAL -O2
    VERILATOR_ARGS ${parameters} ${arg_ARGUMENTS}
      --x-assign unique --x-initial unique --assert --output-split 60000)
endfunction()
set(HMLFC_UNIT_PARAMETERS BLOCK_LOG2 MAX_DEPTH AXI_DATA_BITS OUTSTANDING)
set(HMLFC_VERILATED_OPTIMISATION -O1)  # -O3 compiles longer for runs 10 % faster

# The checker of other people's simulations at the pins of each unit (docs/checker.md): it sleeps unless
# the environment variable HMLFC_RTL_PLUSARGS wakes it. A count of lines is to be of the unit alone.
set(HMLFC_CHECKER_SOURCES "")
if(NOT HMLFC_RTL_COVERAGE)
  set(HMLFC_CHECKER_SOURCES
    "${CMAKE_CURRENT_SOURCE_DIR}/checker/hmlfc_checker.sv"
    "${CMAKE_CURRENT_SOURCE_DIR}/checker/hmlfc_checker_bind.sv")
endif()

# All units in one library: Verilator's runtime is compiled once.
set(HMLFC_RTL_INCLUDES "")
set(HMLFC_RTL_MAKERS "")
set(instrument "")
if(HMLFC_RTL_COVERAGE)
  set(instrument COVERAGE)
elseif(HMLFC_RTL_WAVES)
  set(instrument TRACE_FST)
endif()
foreach(unit IN LISTS units)
  string(REPLACE ":" "_" prefix "Unit_${unit}")
  hmlfc_verilate_unit(hmlfc_verilated ${prefix} ${unit}
    SOURCES "${PROJECT_SOURCE_DIR}/rtl/waivers.vlt" ${HMLFC_RTL_SOURCES} ${HMLFC_RTL_ASSERTIONS} ${HMLFC_CHECKER_SOURCES}
    INSTRUMENT ${instrument} ARGUMENTS -Wall)
  string(REGEX MATCH "^(.+):(.+):(.+):(.+)$" parts "${unit}")
  math(EXPR beat_bytes "${CMAKE_MATCH_3} / 8")
  string(APPEND HMLFC_RTL_INCLUDES "#include \"${prefix}.h\"\n")
  string(APPEND HMLFC_RTL_MAKERS
    "      {\"rtl\", {${CMAKE_MATCH_1}, ${CMAKE_MATCH_2}, ${beat_bytes}, ${CMAKE_MATCH_4}},\n"
    "       &make_unit<${prefix}>},\n")
  if(instrument STREQUAL TRACE_FST)
    set(instrument "")
  endif()
endforeach()

configure_file(unit/rtl_units.cpp.in rtl_units.cpp @ONLY)
add_library(hmlfc_rtl STATIC "${CMAKE_CURRENT_BINARY_DIR}/rtl_units.cpp")
set(waves OFF)
if(HMLFC_RTL_WAVES AND NOT HMLFC_RTL_COVERAGE)
  set(waves ON)
  find_package(ZLIB REQUIRED)
  target_link_libraries(hmlfc_verilated PUBLIC ZLIB::ZLIB)
endif()
target_compile_definitions(hmlfc_rtl PRIVATE
  VM_COVERAGE=$<BOOL:${HMLFC_RTL_COVERAGE}> VM_TRACE=$<BOOL:${waves}>)
target_link_libraries(hmlfc_rtl PUBLIC hmlfc_bench hmlfc_verilated hmlfc_dpi)
