# The proofs of rtl/formal: formal.NAME, and formal.NAME_self_test, which passes when each fault that the
# proof names has a counterexample. Label: formal; soak as well for proofs of more than 10 s and for
# self-tests but one. Skipped where yosys or z3 is missing.

set(HMLFC_PROOFS
  answer
  bise_bits
  bise_element
  bise_place
  bise_unpack
  colour
  compose
  control
  decode_unit
  disparity_ask
  disparity_blocks
  disparity_parser
  disparity_place
  divide
  divide_step
  element_reader
  fifo
  fifo_order
  geometry
  group_axis
  header
  images
  interpolate
  loader
  motion_blocks
  motion_parser
  motion_tile
  multiply_add
  multiply_add_step
  plane_size
  quints
  ram
  ram_clock
  read_port
  read_port_step
  reconstruct
  record_ram
  record_ram_banks
  record_ram_window
  reference_ask
  reference_cache
  reference_lines
  reference_lookup
  reference_lookup_step
  reference_window
  references
  registers
  registers_step
  requests
  requests_jobs
  residual
  residual_blocks
  residual_parser
  skid_buffer
  stores
  strip_collect
  strip_fill
  strip_scan
  tile_ask
  tile_contexts
  tile_contexts_step
  tile_fetch
  tile_headers
  tile_loader
  tile_mask
  tile_number
  tile_stores
  tile_vectors
  tile_walk
  trits
  view
  view_dma
  view_fetch
  view_place
  view_place_address
  view_queue
  view_registers
  view_scan)
set(HMLFC_LONG_PROOFS answer bise_unpack element_reader geometry header interpolate motion_blocks motion_parser reconstruct reference_lookup residual residual_blocks strip_fill tile_contexts view_fetch)
set(HMLFC_SMOKE_TESTS trits)

foreach(proof IN LISTS HMLFC_PROOFS)
  set(prove Python3::Interpreter -B "${RTL}/formal/prove.py" ${proof})
  add_test(NAME formal.${proof} COMMAND ${prove})
  add_test(NAME formal.${proof}_self_test COMMAND ${prove} --fault)
  set(labels formal)
  if(proof IN_LIST HMLFC_LONG_PROOFS)
    list(APPEND labels soak)
  endif()
  set(self_test_labels formal soak)
  if(proof IN_LIST HMLFC_SMOKE_TESTS)
    set(self_test_labels formal)
  endif()
  set_tests_properties(formal.${proof} PROPERTIES LABELS "${labels}")
  set_tests_properties(formal.${proof}_self_test PROPERTIES LABELS "${self_test_labels}")
  set_tests_properties(formal.${proof} formal.${proof}_self_test PROPERTIES
    TIMEOUT 3600 SKIP_RETURN_CODE 77)
endforeach()
