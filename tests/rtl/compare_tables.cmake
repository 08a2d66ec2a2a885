# cmake -DGENERATOR=program [-DARGUMENT=text] -DTABLES=file -DTARGET=target -DWORK=folder
#   [-DFAULT=text] -P compare_tables.cmake
#
# Compares TABLES, the file in the repository, with what GENERATOR prints; TARGET writes it anew. With
# FAULT the last digit of that text is changed in a copy of TABLES, and the comparison must find it.
file(MAKE_DIRECTORY "${WORK}")
execute_process(COMMAND "${GENERATOR}" ${ARGUMENT} OUTPUT_FILE "${WORK}/expected" RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${GENERATOR} failed: ${status}")
endif()

file(READ "${TABLES}" content)
if(FAULT)
  string(REGEX REPLACE "(${FAULT}[^;]*)[0-9]" "\\1x" changed "${content}")
  if(changed STREQUAL content)
    message(FATAL_ERROR "nothing to change in ${TABLES}")
  endif()
  set(content "${changed}")
endif()

file(READ "${WORK}/expected" expected)
if(content STREQUAL expected)
  set(differs FALSE)
else()
  set(differs TRUE)
endif()

if(FAULT AND NOT differs)
  message(FATAL_ERROR "a changed table was not found")
elseif(differs AND NOT FAULT)
  message(FATAL_ERROR "${TABLES} is not what ${GENERATOR} says: build the target ${TARGET}")
endif()
