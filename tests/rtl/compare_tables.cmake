# cmake -DGENERATOR=program [-DARGUMENT=text] -DTABLES=file -DTARGET=target -DWORK=folder
#   -P compare_tables.cmake
#
# Compares TABLES, the file in the repository, with what GENERATOR prints; TARGET writes it anew.
file(MAKE_DIRECTORY "${WORK}")
separate_arguments(ARGUMENT)
execute_process(COMMAND "${GENERATOR}" ${ARGUMENT} OUTPUT_FILE "${WORK}/expected" RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${GENERATOR} failed: ${status}")
endif()

file(READ "${WORK}/expected" expected)
file(READ "${TABLES}" content)
string(COMPARE EQUAL "${content}" "${expected}" equal)
if(NOT equal)
  message(FATAL_ERROR "${TABLES} is not what ${GENERATOR} says: build the target ${TARGET}")
endif()
