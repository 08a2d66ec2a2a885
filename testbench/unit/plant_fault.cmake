# Faults in copies of RTL files, each switched on by its number. A list of faults includes this file first.

# hmlfc_plant_fault(NAME FILE OLD NEW RULE SEED): fault NAME is the expression NEW in the place of
# OLD, which the file has once. RULE is how the finding of the bench must begin, SEED the stream of
# the regression that is tried first.
set(HMLFC_FAULT_COUNT 0)
set(HMLFC_FAULT_ROWS "")
set(HMLFC_FAULT_FILES "")
function(hmlfc_plant_fault name module old new rule seed)
  hmlfc_faulty_text("${module}" text)
  string(FIND "${text}" "${old}" first)
  string(FIND "${text}" "${old}" last REVERSE)
  if(first EQUAL -1 OR NOT first EQUAL last)
    message(FATAL_ERROR "fault ${name}: ${module} must have '${old}' once; adapt rtl_faults.cmake")
  endif()
  math(EXPR number "${HMLFC_FAULT_COUNT} + 1")
  string(REPLACE "${old}" "(hmlfc_fault_pkg::fault == ${number} ? ${new} : ${old})" text "${text}")
  set_property(GLOBAL PROPERTY HMLFC_FAULTY_${module} "${text}")
  list(APPEND HMLFC_FAULT_FILES "${module}")
  list(REMOVE_DUPLICATES HMLFC_FAULT_FILES)
  set(HMLFC_FAULT_FILES "${HMLFC_FAULT_FILES}" PARENT_SCOPE)
  set(HMLFC_FAULT_COUNT ${number} PARENT_SCOPE)
  set(HMLFC_FAULT_ROWS
    "${HMLFC_FAULT_ROWS}    {${number}, \"${name}\", \"${module}\", \"${rule}\", ${seed}},\n"
    PARENT_SCOPE)
endfunction()

# hmlfc_faulty_text(FILE VARIABLE): the text of FILE with the faults planted so far.
function(hmlfc_faulty_text module variable)
  get_property(text GLOBAL PROPERTY HMLFC_FAULTY_${module})
  if(NOT text)
    file(GLOB path "${PROJECT_SOURCE_DIR}/rtl/*/${module}")
    file(READ "${path}" text)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
  endif()
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# hmlfc_write_faulty_files(FOLDER SOURCES VARIABLE): writes copies of what has faults to FOLDER of the build, where they change;
# VARIABLE is SOURCES with them in the place of the product's.
function(hmlfc_write_faulty_files name product variable)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/${name}")
  set(sources "${folder}/hmlfc_fault_pkg.sv")
  foreach(file IN LISTS HMLFC_FAULT_FILES)
    hmlfc_faulty_text("${file}" text)
    file(CONFIGURE OUTPUT "${folder}/${file}" CONTENT "${text}" @ONLY)
  endforeach()
  foreach(source IN LISTS product)
    get_filename_component(file "${source}" NAME)
    if(file IN_LIST HMLFC_FAULT_FILES)
      set(source "${folder}/${file}")
    endif()
    list(APPEND sources "${source}")
  endforeach()
  set(${variable} "${sources}" PARENT_SCOPE)
endfunction()
