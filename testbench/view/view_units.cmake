# hmlfc_view_units: with Verilator view units, and the DMA alone for each block size.

# BLOCK_LOG2:MAX_DEPTH:AXI_DATA_BITS:OUTSTANDING of whole units, and of DMAs, which have no depth and no reads.
set(view_units "2:12:128:32")
if(HMLFC_SOAK)
  list(APPEND view_units "1:12:64:5" "3:12:128:24")
endif()
set(view_dmas "1:12:64:5" "2:12:128:32" "3:12:64:5")

# hmlfc_verilate_view(PREFIX TOP SOURCES file... ARGUMENTS argument...)
function(hmlfc_verilate_view prefix top)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "SOURCES;ARGUMENTS")
  verilate(hmlfc_verilated_view
    SOURCES ${arg_SOURCES}
    TOP_MODULE ${top}
    PREFIX ${prefix}
    INCLUDE_DIRS "${PROJECT_SOURCE_DIR}/rtl"
    OPT_FAST ${HMLFC_VERILATED_OPTIMISATION}
    OPT_SLOW -O0
    OPT_GLOBAL -O2
    VERILATOR_ARGS ${arg_ARGUMENTS} --x-assign unique --x-initial unique --assert --output-split 60000)
endfunction()

add_library(hmlfc_verilated_view STATIC "${CMAKE_CURRENT_BINARY_DIR}/empty.cpp")
set(HMLFC_VIEW_INCLUDES "")
set(HMLFC_VIEW_MAKERS "")
set(HMLFC_DMA_MAKERS "")
foreach(kind unit dma)
  foreach(unit IN LISTS view_${kind}s)
    string(REGEX MATCH "^(.+):(.+):(.+):(.+)$" parts "${unit}")
    string(REPLACE ":" "_" prefix "View_${kind}_${unit}")
    math(EXPR beat_bytes "${CMAKE_MATCH_3} / 8")
    set(maker "      {{${CMAKE_MATCH_1}, ${CMAKE_MATCH_2}, ${beat_bytes}, ${CMAKE_MATCH_4}}, &make_${kind}<${prefix}>},\n")
    set(parameters -GBLOCK_LOG2=${CMAKE_MATCH_1} -GAXI_DATA_BITS=${CMAKE_MATCH_3})
    if("${kind}" STREQUAL "unit")
      list(APPEND parameters -GMAX_DEPTH=${CMAKE_MATCH_2} -GOUTSTANDING=${CMAKE_MATCH_4} -GTRACE=0)
      string(APPEND HMLFC_VIEW_MAKERS "${maker}")
    else()
      string(APPEND HMLFC_DMA_MAKERS "${maker}")
    endif()
    string(APPEND HMLFC_VIEW_INCLUDES "#include <${prefix}.h>\n")
    hmlfc_verilate_view(${prefix} hmlfc_view_${kind}
      SOURCES "${PROJECT_SOURCE_DIR}/rtl/waivers.vlt" ${HMLFC_RTL_SOURCES} ${HMLFC_RTL_ASSERTIONS}
      ARGUMENTS ${parameters} -Wall)
  endforeach()
endforeach()

configure_file(view/view_units.cpp.in view_units.cpp @ONLY)
add_library(hmlfc_view_units STATIC "${CMAKE_CURRENT_BINARY_DIR}/view_units.cpp")
target_compile_definitions(hmlfc_view_units PRIVATE VM_COVERAGE=0 VM_TRACE=0)
target_link_libraries(hmlfc_view_units PUBLIC hmlfc_bench hmlfc_verilated_view)
