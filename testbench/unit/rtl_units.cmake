# hmlfc_rtl: the Verilated units of this build, as unit/units.hpp lists them.

# BLOCK_LOG2:MAX_DEPTH:AXI_DATA_BITS:OUTSTANDING of decode units, view units and DMAs, which have no depth and
# no reads. The first unit that fits a stream decodes it. The tests need a decode unit for each block size, and
# values of OUTSTANDING that are no power of two; ./run soak adds MAX_DEPTH = 8, as the tests of modules have.
set(decode_units "2:12:128:64" "1:12:64:5" "3:12:256:24")
set(view_units "2:12:128:32")
set(dma_units "1:12:64:5" "2:12:128:32" "3:12:256:5")
if(HMLFC_SOAK)
  list(APPEND decode_units "2:8:64:16")
  list(APPEND view_units "1:12:64:5" "3:12:256:24")
endif()
set(HMLFC_RTL_UNITS "" CACHE STRING
  "BLOCK_LOG2:MAX_DEPTH:AXI_DATA_BITS:OUTSTANDING of each Verilated decode unit; empty: those of the tests")
if(HMLFC_RTL_UNITS)
  set(decode_units ${HMLFC_RTL_UNITS})
endif()
# The decode units of 64 bits are the smallest, whose memories are replaced often; those of 256 are wide.
set(decode_64_parameters -GTILE_CONTEXTS=2 -GCACHES=1 -GCACHE_STRIPS=64 -GBLOCK_CLOCKS=2)
set(decode_256_parameters -GTILE_CONTEXTS=32)
set(decode_3_parameters -GSTRIP_READ=64)

# Waves double the time that a unit takes to compile, so that only the first decode unit has them.
option(HMLFC_RTL_WAVES "The first Verilated unit writes waves of failures" ${HMLFC_SOAK})
option(HMLFC_RTL_COVERAGE "Count lines, branches and toggles of the decode unit; excludes waves" OFF)
set(waves OFF)
set(instrument "")
if(HMLFC_RTL_COVERAGE)
  set(instrument COVERAGE)
  set(view_units "")
  set(dma_units "")
elseif(HMLFC_RTL_WAVES)
  set(waves ON)
  set(instrument TRACE_FST)
endif()

# The checker of other people's simulations at the pins of each decode unit (docs/checker.md): it sleeps
# unless the environment variable HMLFC_RTL_PLUSARGS wakes it. A count of lines is to be of the unit alone.
set(checker "")
if(NOT HMLFC_RTL_COVERAGE)
  set(checker
    "${CMAKE_CURRENT_SOURCE_DIR}/checker/hmlfc_checker.sv"
    "${CMAKE_CURRENT_SOURCE_DIR}/checker/hmlfc_checker_bind.sv")
endif()

# All units are in one library, so that Verilator's runtime is compiled once. A library needs a source of
# its own.
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/empty.cpp" "")
add_library(hmlfc_verilated STATIC "${CMAKE_CURRENT_BINARY_DIR}/empty.cpp")
set(HMLFC_RTL_INCLUDES "")
set(HMLFC_DECODE_MAKERS "")
set(HMLFC_VIEW_MAKERS "")
set(HMLFC_DMA_MAKERS "")
foreach(kind decode view dma)
  foreach(unit IN LISTS ${kind}_units)
    string(REGEX MATCH "^(.+):(.+):(.+):(.+)$" parts "${unit}")
    set(parameters -GBLOCK_LOG2=${CMAKE_MATCH_1} -GAXI_DATA_BITS=${CMAKE_MATCH_3})
    set(whole -GMAX_DEPTH=${CMAKE_MATCH_2} -GOUTSTANDING=${CMAKE_MATCH_4} ${${kind}_${CMAKE_MATCH_1}_parameters}
      ${${kind}_${CMAKE_MATCH_3}_parameters})
    string(REPLACE ":" "_" prefix "${kind}_${unit}")
    math(EXPR beat_bytes "${CMAKE_MATCH_3} / 8")
    set(values "{${CMAKE_MATCH_1}, ${CMAKE_MATCH_2}, ${beat_bytes}, ${CMAKE_MATCH_4}}")
    set(maker make_unit)
    set(sources "")
    if(kind STREQUAL decode)
      set(top hmlfc_decode_unit)
      list(APPEND parameters ${whole})
      set(sources ${checker})
    elseif(kind STREQUAL view)
      set(top hmlfc_view_unit)
      list(APPEND parameters ${whole} -GTRACE=0)
    else()
      set(top hmlfc_view_dma)
      set(maker make_dma)
    endif()
    verilate(hmlfc_verilated
      SOURCES "${PROJECT_SOURCE_DIR}/rtl/waivers.vlt" ${HMLFC_RTL_SOURCES} ${HMLFC_RTL_ASSERTIONS} ${sources}
      TOP_MODULE ${top}
      PREFIX ${prefix}
      INCLUDE_DIRS "${PROJECT_SOURCE_DIR}/rtl"
      ${instrument}
      OPT_FAST -O1  # -O3 compiles longer for runs 10 % faster
      OPT_SLOW -O0
      OPT_GLOBAL -O2
      VERILATOR_ARGS ${parameters} -Wall --x-assign unique --x-initial unique --assert --output-split 60000)
    string(APPEND HMLFC_RTL_INCLUDES "#include <${prefix}.h>\n")
    string(TOUPPER ${kind} makers)
    string(APPEND HMLFC_${makers}_MAKERS "      {${values}, &${maker}<${prefix}>},\n")
    if(instrument STREQUAL TRACE_FST)
      set(instrument "")
    endif()
  endforeach()
endforeach()

configure_file(unit/rtl_units.cpp.in rtl_units.cpp @ONLY)
add_library(hmlfc_rtl STATIC "${CMAKE_CURRENT_BINARY_DIR}/rtl_units.cpp")
if(waves)
  find_package(ZLIB REQUIRED)
  target_link_libraries(hmlfc_verilated PUBLIC ZLIB::ZLIB)
endif()
target_compile_definitions(hmlfc_rtl PRIVATE
  VM_COVERAGE=$<BOOL:${HMLFC_RTL_COVERAGE}> VM_TRACE=$<BOOL:${waves}>)
target_link_libraries(hmlfc_rtl PUBLIC hmlfc_bench hmlfc_verilated hmlfc_dpi)
