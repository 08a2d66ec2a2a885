# The proofs of rtl/formal: formal.NAME, and formal.NAME_self_test, which passes when each fault that the
# proof names has a counterexample. Label: formal; soak as well for those of more than a minute.
# Skipped where yosys or z3 is missing.

set(HMLFC_PROOFS
  answer
  bise_bits
  bise_element
  bise_place
  bise_unpack
  colour
  compose
  divide
  fifo
  interpolate
  quints
  read_port
  reconstruct
  registers
  requests
  residual
  skid_buffer
  trits)
set(HMLFC_LONG_PROOFS bise_unpack)

foreach(proof IN LISTS HMLFC_PROOFS)
  set(prove Python3::Interpreter -B "${RTL}/formal/prove.py" ${proof})
  set(labels formal)
  if(proof IN_LIST HMLFC_LONG_PROOFS)
    list(APPEND labels soak)
  endif()
  add_test(NAME formal.${proof} COMMAND ${prove})
  add_test(NAME formal.${proof}_self_test COMMAND ${prove} --fault)
  set_tests_properties(formal.${proof} formal.${proof}_self_test PROPERTIES
    LABELS "${labels}" TIMEOUT 600 SKIP_RETURN_CODE 77)
endforeach()
