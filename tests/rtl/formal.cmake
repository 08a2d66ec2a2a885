# The proofs of rtl/formal: formal.NAME. Label: formal; soak as well for proofs of more than 10 s. Skipped where yosys or
# z3 is missing.

set(HMLFC_LONG_PROOFS answer element_reader reconstruct reference_lookup residual tile_contexts)

file(GLOB proofs CONFIGURE_DEPENDS "${RTL}/formal/*.sv")
foreach(file IN LISTS proofs)
  cmake_path(GET file STEM proof)
  add_test(NAME formal.${proof} COMMAND Python3::Interpreter -B "${RTL}/formal/prove.py" ${proof})
  set(labels formal)
  if(proof IN_LIST HMLFC_LONG_PROOFS)
    list(APPEND labels soak)
  endif()
  set_tests_properties(formal.${proof} PROPERTIES
    LABELS "${labels}" TIMEOUT 3600 SKIP_RETURN_CODE 77)
endforeach()
