# hmlfc_rtl_faults: one Verilated unit of a copy of the RTL in which faults wait to be switched on,
# each by its number in the plusarg +fault=N, and the table of them (rtl_faults.hpp). The product's
# RTL has no code for faults.
include(unit/plant_fault.cmake)

# Values and tables.
hmlfc_plant_fault(wrong_table_entry hmlfc_tables.svh
  "HMLFC_PLAIN_BITS_TABLE[4 * level_code +: 4]" "HMLFC_PLAIN_BITS_TABLE[4 * (level_code == 6'd7 ? 6'd6 : level_code) +: 4]"
  "stage: " 3)
hmlfc_plant_fault(centre_of_levels_off_by_one hmlfc_residual.sv
  "{1'b0, level_count[VALUE_BITS:1]}" "{1'b0, level_count[VALUE_BITS:1]} + 1'b1" "stage: residual" 0)
hmlfc_plant_fault(rounding_off_by_one hmlfc_interpolate.sv
  "TOTAL_BITS'(64)" "TOTAL_BITS'(63)" "stage: reference" 3)
hmlfc_plant_fault(sign_ignored hmlfc_reconstruct.sv
  "motion && negative" "1'b0" "stage: prediction" 6)
hmlfc_plant_fault(sum_not_clamped hmlfc_reconstruct.sv
  "over_least[SUM_BITS-1]" "1'b0" "stage: sample" 1)

# Places in the stream and in references.
hmlfc_plant_fault(border_off_by_one hmlfc_reference_window.sv
  "size - 15'd1" "size - 15'd1 - 15'(size > 15'd2)" "stage: " 0)
hmlfc_plant_fault(quad_of_mask_skipped hmlfc_tile_mask.sv
  "quads[q]" "quads[q] && q != 5" "stage: " 0)
hmlfc_plant_fault(motion_block_of_wrong_row hmlfc_motion_blocks.sv
  "10'(row_0) * 10'(columns_0)" "10'(row_0) * 10'(columns_0 + 6'd1)" "stage: " 3)
hmlfc_plant_fault(disparity_left_of_border hmlfc_disparity_place.sv
  "left && own_x != 0" "left && own_x > 1" "stage: " 27)
hmlfc_plant_fault(record_of_the_next_tile hmlfc_tile_walk.sv
  "count == 7'd0 ? 7'd0 : count - 7'd1" "count" "stage: " 0)

# The width of addresses.
hmlfc_plant_fault(read_address_cut_to_32_bits hmlfc_read_port.sv
  "chosen_address[ADDRESS_BITS-1:BEAT_LOG2]" "{8'd0, chosen_address[31:BEAT_LOG2]}" "registers: error of LOAD" 0)
hmlfc_plant_fault(bit_39_of_the_area_dropped hmlfc_geometry.sv
  "sum[ADDRESS_BITS-1:0]" "{1'b0, sum[ADDRESS_BITS-2:0]}" "stage: " 6)
hmlfc_plant_fault(carry_to_bit_32_of_the_records_lost hmlfc_geometry.sv
  "stream_base + tile_offset[ADDRESS_BITS-1:0]"
  "{stream_base[ADDRESS_BITS-1:32], stream_base[31:0] + tile_offset[31:0]}" "stage: " 0)

# What is kept, and what moves.
hmlfc_plant_fault(root_entry_of_a_bus_error_kept hmlfc_tile_walk.sv
  "!read_error" "1'b1" "stage: error" 0)
hmlfc_plant_fault(stale_cache_tag hmlfc_reference_lookup.sv
  "tag == own" "1'b1" "stage: sample" 0)
hmlfc_plant_fault(dropped_beat hmlfc_read_port.sv
  "rst_n && m_axi_rvalid && owner_valid"
  "rst_n && m_axi_rvalid && owner_valid && m_axi_araddr[11:4] != 8'h5A" "answer: missing" 0)
hmlfc_plant_fault(wrong_tlast hmlfc_answer.sv
  "in_job.tlast" "in_job.last" "answer: tlast" 0)
hmlfc_plant_fault(chroma_corner hmlfc_answer.sv
  "32'(part[1])" "32'(part[0])" "answer: sample" 0)
hmlfc_plant_fault(counter_stands_still hmlfc_registers.sv
  "{4'd0, answered, read_bytes, 4'd0, stalled, 4'd0, in_flight, 4'd0, block_done}"
  "{5'd0, read_bytes, 4'd0, stalled, 4'd0, in_flight, 4'd0, block_done}" "registers: REQUESTS" 0)
hmlfc_plant_fault(block_counted_before_it_is_taken hmlfc_registers.sv
  "{28'd0, added[5*k +: 5]}" "({28'd0, added[5*k +: 5]} + 33'(k == 0 && stalled && !block_done))" "registers: BLOCKS" 0)
hmlfc_plant_fault(bus_error_of_the_beat_before hmlfc_read_port.sv
  "m_axi_rresp[1]" "(m_axi_rresp[1] || (data_error && data_valid != 0 && m_axi_rvalid))" "stage: error" 0)

# What a unit holds before its first reset.
hmlfc_plant_fault(loader_not_reset hmlfc_loader.sv
  "!rst_n" "1'b0" "registers: " 0)

# The clock, which stands still where `active` is low.
hmlfc_plant_fault(clock_stops_while_reading hmlfc_decode_unit.sv
  "{accessed, loading, !idle, reading}" "({accessed, loading, !idle, 1'b0} & {4{!reading}})" "protocol: " 0)

# The number of the fault comes from the plusarg.
hmlfc_faulty_text(hmlfc_decode_unit.sv text)
string(REPLACE "\nendmodule" "
  initial if ($value$plusargs(\"fault=%d\", hmlfc_fault_pkg::fault) == 0) hmlfc_fault_pkg::fault = 0;
\nendmodule" text "${text}")
set_property(GLOBAL PROPERTY HMLFC_FAULTY_hmlfc_decode_unit.sv "${text}")
set_property(GLOBAL PROPERTY HMLFC_FAULTY_hmlfc_fault_pkg.sv
  "package hmlfc_fault_pkg;\n  int fault;\nendpackage\n")
list(APPEND HMLFC_FAULT_FILES hmlfc_decode_unit.sv hmlfc_fault_pkg.sv)

hmlfc_write_faulty_files(faults "${HMLFC_RTL_SOURCES}" sources)

# Small blocks, little memory: quick to compile, and tiles and strips give way often.
hmlfc_verilate_unit(hmlfc_FaultyUnit FaultyUnit 1:12:64:4
  SOURCES ${sources}
  INCLUDE "${CMAKE_CURRENT_BINARY_DIR}/faults"
  ARGUMENTS -GTILE_CONTEXTS=2 -GCACHE_STRIPS=64 -Wno-lint)
configure_file(unit/rtl_faults.cpp.in rtl_faults.cpp @ONLY)
add_library(hmlfc_rtl_faults STATIC "${CMAKE_CURRENT_BINARY_DIR}/rtl_faults.cpp")
target_compile_definitions(hmlfc_rtl_faults PRIVATE VM_COVERAGE=0 VM_TRACE=0)
target_link_libraries(hmlfc_rtl_faults PUBLIC hmlfc_bench hmlfc_FaultyUnit)
