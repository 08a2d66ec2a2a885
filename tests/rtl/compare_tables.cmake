# cmake -DGENERATOR=program -DTABLES=file -DWORK=folder [-DPLANT_FAULT=ON] -P compare_tables.cmake
#
# Compares TABLES, the file in the repository, with what GENERATOR prints. With PLANT_FAULT a number
# in a copy of TABLES is changed, and the comparison must find it.
file(MAKE_DIRECTORY "${WORK}")
execute_process(COMMAND "${GENERATOR}" OUTPUT_FILE "${WORK}/expected.svh" RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${GENERATOR} failed: ${status}")
endif()

file(READ "${TABLES}" content)
if(PLANT_FAULT)
  string(REGEX REPLACE "HMLFC_MAX_STEP_CODE = 15" "HMLFC_MAX_STEP_CODE = 14" changed "${content}")
  if(changed STREQUAL content)
    message(FATAL_ERROR "nothing to change in ${TABLES}")
  endif()
  set(content "${changed}")
endif()

file(READ "${WORK}/expected.svh" expected)
if(content STREQUAL expected)
  set(differs FALSE)
else()
  set(differs TRUE)
endif()

if(PLANT_FAULT AND NOT differs)
  message(FATAL_ERROR "a changed table was not found")
elseif(differs AND NOT PLANT_FAULT)
  message(FATAL_ERROR "${TABLES} is not what the model says: build the target rtl_tables")
endif()
