# The parameters of the decode unit: what lies outside their intervals stops elaboration with the
# message of the top module, and the ends of the intervals pass Verilator's -Wall.

# hmlfc_elaboration_test(NAME MESSAGE PARAMETER=value...): MESSAGE is what must be said, or empty.
function(hmlfc_elaboration_test name message)
  set(command "${CMAKE_COMMAND}" "-DREASON=verilator is not installed"
    -P "${CMAKE_CURRENT_SOURCE_DIR}/skip.cmake")
  if(HMLFC_VERILATOR)
    list(TRANSFORM ARGN PREPEND -G)
    set(command "${HMLFC_VERILATOR}" --lint-only -Wall "${RTL}/waivers.vlt"
      -F "${RTL}/hmlfc_decode_unit.f" --top-module hmlfc_decode_unit ${ARGN})
  endif()
  add_test(NAME rtl.parameters.${name} COMMAND ${command})
  set_tests_properties(rtl.parameters.${name} PROPERTIES
    LABELS rtl TIMEOUT 120 SKIP_REGULAR_EXPRESSION "SKIPPED: ")
  if(message)
    set_tests_properties(rtl.parameters.${name} PROPERTIES
      PASS_REGULAR_EXPRESSION "USERERROR: [^\n]*${message}")
  endif()
endfunction()

find_program(HMLFC_VERILATOR verilator)
foreach(value 0 4)
  hmlfc_elaboration_test(block_log2_${value} "BLOCK_LOG2 is 1, 2 or 3" BLOCK_LOG2=${value})
endforeach()
foreach(value 7 13)
  hmlfc_elaboration_test(max_depth_${value} "MAX_DEPTH is 8 to 12" MAX_DEPTH=${value})
endforeach()
foreach(value 32 96 512)
  hmlfc_elaboration_test(axi_data_bits_${value} "AXI_DATA_BITS is 64, 128 or 256" AXI_DATA_BITS=${value})
endforeach()
foreach(value 3 65)
  hmlfc_elaboration_test(outstanding_${value} "OUTSTANDING is 4 to 64" OUTSTANDING=${value})
endforeach()
foreach(value 3 64)
  hmlfc_elaboration_test(tile_contexts_${value} "TILE_CONTEXTS is a power of two, 2 to 32"
    TILE_CONTEXTS=${value})
endforeach()
foreach(value 32 96 2048)
  hmlfc_elaboration_test(cache_strips_${value} "CACHE_STRIPS is a power of two, 64 to 1024"
    CACHE_STRIPS=${value})
endforeach()
hmlfc_elaboration_test(caches_3 "CACHES is 1 or 2" CACHES=3)
hmlfc_elaboration_test(strip_read_16 "STRIP_READ is 32 or 64" STRIP_READ=16)
hmlfc_elaboration_test(block_clocks_8 "BLOCK_CLOCKS is 1, 2 or 4, and at most the rows of a block" BLOCK_CLOCKS=8)
hmlfc_elaboration_test(trace_2 "TRACE is 0 or 1" TRACE=2)
hmlfc_elaboration_test(least "" BLOCK_LOG2=1 MAX_DEPTH=8 AXI_DATA_BITS=64 OUTSTANDING=4
  TILE_CONTEXTS=2 CACHES=1 CACHE_STRIPS=64 BLOCK_CLOCKS=2 TRACE=0)
hmlfc_elaboration_test(greatest "" BLOCK_LOG2=3 MAX_DEPTH=12 AXI_DATA_BITS=256 OUTSTANDING=64
  TILE_CONTEXTS=32 CACHE_STRIPS=1024 STRIP_READ=64)
find_program(HMLFC_YOSYS yosys)
set(trace_values 0 1)
set(trace_assertions -assert-none -assert-any)
set(traced_modules hmlfc_compose hmlfc_images)  # of the folder unit
set(traced_blocks g_trace g_place)

# What only the trace needs stands in blocks of their own: with TRACE 1 there are some, with 0 none.
foreach(value assertion IN ZIP_LISTS trace_values trace_assertions)
  foreach(module blocks IN ZIP_LISTS traced_modules traced_blocks)
    set(command "${CMAKE_COMMAND}" "-DREASON=yosys is not installed"
      -P "${CMAKE_CURRENT_SOURCE_DIR}/skip.cmake")
    if(HMLFC_YOSYS)
      set(command "${HMLFC_YOSYS}" -q
        -p "verilog_defaults -add -I${RTL}" -p "read_verilog -sv ${RTL}/hmlfc_pkg.sv ${RTL}/unit/${module}.sv"
        -p "chparam -set TRACE ${value} ${module}" -p "hierarchy -top ${module} -libdir ${RTL}/lib -libdir ${RTL}/unit"
        -p "proc" -p "select ${assertion} */${blocks}.*")
    endif()
    add_test(NAME rtl.parameters.${module}_trace_${value} COMMAND ${command})
    set_tests_properties(rtl.parameters.${module}_trace_${value} PROPERTIES
      LABELS rtl TIMEOUT 120 SKIP_REGULAR_EXPRESSION "SKIPPED: ")
  endforeach()
endforeach()
