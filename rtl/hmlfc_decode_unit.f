// The files of the decode unit and of the view unit around it: the package first, then each module after those in it.
// Tops: hmlfc_decode_unit, hmlfc_view_unit.
//
//   verilator waivers.vlt -F hmlfc_decode_unit.f
//   iverilog -g2012 -c hmlfc_decode_unit.f            in this folder
//
// The builds of this project read this list, and a test compares it with the folder.
//
// included: hmlfc_register_map.svh
// included: hmlfc_tables.svh
// left out: waivers.vlt, Verilator alone reads it, before this list

+incdir+.
hmlfc_pkg.sv
hmlfc_ram.sv
hmlfc_activity.sv
hmlfc_colour.sv
hmlfc_skid_buffer.sv
hmlfc_answer.sv
hmlfc_interpolate.sv
hmlfc_reconstruct.sv
hmlfc_compose.sv
hmlfc_divide.sv
hmlfc_multiply_add.sv
hmlfc_plane_size.sv
hmlfc_geometry.sv
hmlfc_aligned_read.sv
hmlfc_header.sv
hmlfc_loader.sv
hmlfc_registers.sv
hmlfc_control.sv
hmlfc_fifo.sv
hmlfc_images.sv
hmlfc_read_port.sv
hmlfc_vector_axis.sv
hmlfc_vector.sv
hmlfc_reference_ask.sv
hmlfc_reference_lines.sv
hmlfc_reference_window.sv
hmlfc_reference_lookup.sv
hmlfc_strip_fill.sv
hmlfc_reference_cache.sv
hmlfc_references.sv
hmlfc_requests.sv
hmlfc_motion_place.sv
hmlfc_tile_number.sv
hmlfc_motion_tile.sv
hmlfc_disparity_place.sv
hmlfc_disparity_ask.sv
hmlfc_quints.sv
hmlfc_trits.sv
hmlfc_bise_element.sv
hmlfc_bise_place.sv
hmlfc_element_reader.sv
hmlfc_disparity_blocks.sv
hmlfc_bise_bits.sv
hmlfc_disparity_parser.sv
hmlfc_record_ram.sv
hmlfc_tile_contexts.sv
hmlfc_tile_walk.sv
hmlfc_tile_loader.sv
hmlfc_tile_fetch.sv
hmlfc_disparity_store.sv
hmlfc_motion_blocks.sv
hmlfc_motion_parser.sv
hmlfc_motion_store.sv
hmlfc_bise_unpack.sv
hmlfc_residual.sv
hmlfc_residual_blocks.sv
hmlfc_tile_headers.sv
hmlfc_tile_mask.sv
hmlfc_tile_vectors.sv
hmlfc_vector_bounds.sv
hmlfc_residual_parser.sv
hmlfc_residual_store.sv
hmlfc_tile_ask.sv
hmlfc_tile_stores.sv
hmlfc_group_axis.sv
hmlfc_view.sv
hmlfc_widths.sv
hmlfc_decode_unit.sv
hmlfc_axil_split.sv
hmlfc_view_registers.sv
hmlfc_view_fetch.sv
hmlfc_view_queue.sv
hmlfc_view_scan.sv
hmlfc_view_place.sv
hmlfc_view_rows.sv
hmlfc_write_port.sv
hmlfc_view_writer.sv
hmlfc_strip_scan.sv
hmlfc_strip_collect.sv
hmlfc_strip_pack.sv
hmlfc_strip_writer.sv
hmlfc_view_dma.sv
hmlfc_view_unit.sv
