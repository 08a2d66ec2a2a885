// The files of the decode unit and of the view unit around it: the package first, then each module after those in it. Modules of the
// decode unit are in unit/, those around it in view/, what both are made of in lib/.
// Tops: hmlfc_decode_unit, hmlfc_view_unit.
//
//   verilator waivers.vlt -F hmlfc_decode_unit.f
//
// The builds of this project read this list, and a test compares it with the folders.
//
// included: hmlfc_register_map.svh
// included: hmlfc_tables.svh
// left out: waivers.vlt, Verilator alone reads it, before this list

+incdir+.
hmlfc_pkg.sv
lib/hmlfc_ram.sv
lib/hmlfc_activity.sv
unit/hmlfc_colour.sv
lib/hmlfc_skid_buffer.sv
unit/hmlfc_answer.sv
unit/hmlfc_between.sv
unit/hmlfc_interpolate.sv
unit/hmlfc_reconstruct.sv
unit/hmlfc_compose.sv
lib/hmlfc_divide.sv
lib/hmlfc_multiply_add.sv
unit/hmlfc_plane_size.sv
unit/hmlfc_geometry.sv
unit/hmlfc_header.sv
unit/hmlfc_loader.sv
unit/hmlfc_registers.sv
unit/hmlfc_control.sv
lib/hmlfc_fifo.sv
unit/hmlfc_images.sv
lib/hmlfc_read_port.sv
unit/hmlfc_vector_axis.sv
unit/hmlfc_vector.sv
unit/hmlfc_reference_ask.sv
unit/hmlfc_reference_lines.sv
unit/hmlfc_window_axis.sv
unit/hmlfc_reference_lookup.sv
unit/hmlfc_strip_unpack.sv
unit/hmlfc_strip_fill.sv
unit/hmlfc_reference_cache.sv
unit/hmlfc_references.sv
unit/hmlfc_requests.sv
unit/hmlfc_motion_place.sv
unit/hmlfc_tile_number.sv
unit/hmlfc_motion_tile.sv
unit/hmlfc_disparity_place.sv
unit/hmlfc_disparity_ask.sv
unit/hmlfc_quints.sv
unit/hmlfc_trits.sv
unit/hmlfc_bise_element.sv
unit/hmlfc_bise_place.sv
unit/hmlfc_element_reader.sv
unit/hmlfc_disparity_blocks.sv
unit/hmlfc_bise_bits.sv
unit/hmlfc_disparity_parser.sv
unit/hmlfc_record_ram.sv
unit/hmlfc_tile_contexts.sv
unit/hmlfc_index_reads.sv
unit/hmlfc_mask_count.sv
unit/hmlfc_tile_walk.sv
unit/hmlfc_tile_fetch.sv
unit/hmlfc_motion_blocks.sv
unit/hmlfc_motion_parser.sv
unit/hmlfc_bise_unpack.sv
unit/hmlfc_residual.sv
unit/hmlfc_residual_blocks.sv
unit/hmlfc_tile_headers.sv
unit/hmlfc_tile_mask.sv
unit/hmlfc_tile_vectors.sv
unit/hmlfc_vector_bounds.sv
unit/hmlfc_residual_parser.sv
unit/hmlfc_tile_store.sv
unit/hmlfc_tile_ask.sv
unit/hmlfc_tile_stores.sv
unit/hmlfc_group_axis.sv
unit/hmlfc_view.sv
unit/hmlfc_widths.sv
unit/hmlfc_decode_unit.sv
lib/hmlfc_axil_split.sv
view/hmlfc_view_registers.sv
view/hmlfc_view_fetch.sv
view/hmlfc_view_queue.sv
view/hmlfc_view_scan.sv
view/hmlfc_view_place.sv
view/hmlfc_view_rows.sv
lib/hmlfc_write_port.sv
view/hmlfc_view_writer.sv
view/hmlfc_strip_scan.sv
view/hmlfc_strip_collect.sv
view/hmlfc_strip_pack.sv
view/hmlfc_strip_writer.sv
view/hmlfc_view_guard.sv
view/hmlfc_view_dma.sv
view/hmlfc_view_unit.sv
