# Faults of the DMA, by their numbers in the plusarg +fault=N, as in unit/rtl_faults.cmake. RULE is how the finding of the
# bench must begin; the seed is not used.
include(unit/plant_fault.cmake)

hmlfc_plant_fault(strobe_of_a_byte_too_many hmlfc_view_rows.sv
  "6'(i) < packed_size" "6'(i) <= packed_size" "destination: " 0)
hmlfc_plant_fault(line_not_written_at_the_end hmlfc_view_writer.sv
  "rows_empty && held == 0" "rows_empty && held[0] == 0" "destination: " 0)
hmlfc_plant_fault(line_of_the_row_above hmlfc_view_writer.sv
  "numbers[row_entry] == put_line" "numbers[row_entry][5:0] == put_line[5:0]" "destination: " 0)
hmlfc_plant_fault(second_line_is_the_first hmlfc_view_writer.sv
  "second ? row_line_next : row_line" "row_line" "destination: " 0)
hmlfc_plant_fault(bitmap_bit_shifted hmlfc_view_writer.sv
  "{place.tile_y, place.tile_x}" "{place.tile_y, place.tile_x + 3'd1}" "destination: " 0)
hmlfc_plant_fault(tile_of_the_bitmap_not_counted hmlfc_view_place.sv
  "{10'd0, tiles_x, 2'd0}" "{11'd0, tiles_x, 1'b0}" "destination: " 0)
hmlfc_plant_fault(macro_row_starts_at_the_rectangle hmlfc_view_place.sv
  "above[0]" "1'b0" "protocol: a write is outside" 0)
hmlfc_plant_fault(errors_of_pixels_that_do_not_fit_ignored hmlfc_view_rows.sv
  "in_samples[16*i+8+:8] != 0" "1'b0" "status: " 0)
hmlfc_plant_fault(status_with_the_tag_of_the_next hmlfc_view_queue.sv
  "{write_errors, block_errors, 18'd0, first_error, result, tag}"
  "{write_errors, block_errors, 18'd0, first_error, result, tag + 32'd1}" "status: " 0)
hmlfc_plant_fault(status_at_the_place_of_the_next hmlfc_view_queue.sv
  "{20'd0, place, 4'd0}" "{20'd0, place + 16'd1, 4'd0}" "" 0)
hmlfc_plant_fault(write_errors_ignored hmlfc_write_port.sv
  "m_axi_bresp[1]" "1'b0" "status: " 0)
hmlfc_plant_fault(pages_of_bursts_not_trimmed hmlfc_write_port.sv
  "8'(more)" "8'(more + 1'b1)" "" 0)
hmlfc_plant_fault(write_address_cut_to_32_bits hmlfc_write_port.sv
  "{line, first, (6 - BEAT_BITS)'(0)}" "{8'd0, line[25:0], first, (6 - BEAT_BITS)'(0)}"
  "protocol: a write is outside" 0)
hmlfc_plant_fault(bit_39_of_the_ring_dropped hmlfc_view_queue.sv
  "ring_base + {18'd0, place, 6'd0}" "{1'b0, (ADDRESS_BITS - 1)'(ring_base + {18'd0, place, 6'd0})}" "status: " 0)
hmlfc_plant_fault(bitmap_with_high_bits_of_the_pixels hmlfc_view_writer.sv
  "view.bitmap[ADDRESS_BITS-1:3]" "{view.destination[ADDRESS_BITS-1:32], view.bitmap[31:3]}"
  "protocol: a write is outside" 0)
hmlfc_plant_fault(carry_to_bit_32_of_the_pixels_lost hmlfc_view_place.sv
  "base_2 + rows_2 + ADDRESS_BITS'({units_2, BLOCK_LOG2'(0)})"
  "{base_2[ADDRESS_BITS-1:32], 32'(base_2 + rows_2 + ADDRESS_BITS'({units_2, BLOCK_LOG2'(0)}))}"
  "protocol: a write is outside" 0)
hmlfc_plant_fault(last_row_of_strips_left_out hmlfc_strip_scan.sv
  "by == view.blocks.last_y" "by + 1'b1 >= view.blocks.last_y" "" 0)
hmlfc_plant_fault(least_of_the_strip_before hmlfc_strip_collect.sv
  "(begins[2] || low_2 < least)" "(low_2 < least)" "destination: " 0)
hmlfc_plant_fault(errors_of_residuals_not_stored hmlfc_strip_collect.sv
  "in_status != 0" "1'b0" "destination: " 0)
hmlfc_plant_fault(strips_wider_than_4_bits_raw hmlfc_strip_pack.sv
  "needed > 5'd14" "needed > 5'd4" "destination: " 0)
hmlfc_plant_fault(rest_of_a_strip_lost hmlfc_strip_pack.sv
  "!rest && valid[3] && ends[3] && whole" "1'b0 && whole" "" 0)
hmlfc_plant_fault(strip_in_part_after_abort hmlfc_view_dma.sv
  "view.residuals && strip_ask_valid && !(m_request_tready && strip_asked)" "1'b0" "" 0)
hmlfc_plant_fault(abort_goes_on_asking hmlfc_view_queue.sv
  "aborting && !request_waits" "1'b0" "hang: ABORT" 0)
hmlfc_plant_fault(clock_stops_before_the_interrupt hmlfc_view_dma.sv
  "accessed || irq_changes" "accessed" "hang: " 0)
hmlfc_plant_fault(write_port_not_reset hmlfc_write_port.sv
  "!rst_n" "1'b0" "" 0)

hmlfc_faulty_text(hmlfc_view_dma.sv text)
string(REPLACE "\nendmodule" "
  initial if ($value$plusargs(\"fault=%d\", hmlfc_fault_pkg::fault) == 0) hmlfc_fault_pkg::fault = 0;
\nendmodule" text "${text}")
set_property(GLOBAL PROPERTY HMLFC_FAULTY_hmlfc_view_dma.sv "${text}")
set_property(GLOBAL PROPERTY HMLFC_FAULTY_hmlfc_fault_pkg.sv
  "package hmlfc_fault_pkg;\n  int fault;\nendpackage\n")
list(APPEND HMLFC_FAULT_FILES hmlfc_view_dma.sv hmlfc_fault_pkg.sv)
hmlfc_write_faulty_files(view_faults "${HMLFC_RTL_SOURCES}" sources)
hmlfc_verilate_view(FaultyDma hmlfc_view_dma SOURCES ${sources}
  ARGUMENTS -GBLOCK_LOG2=1 -GAXI_DATA_BITS=64 -Wno-lint)
set(HMLFC_VIEW_FAULT_ROWS "${HMLFC_FAULT_ROWS}")
