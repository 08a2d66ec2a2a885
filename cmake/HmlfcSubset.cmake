# hmlfc_add_subset(NAME FROM PREFIX...): a static library NAME of the sources of target FROM that begin
# with one of the PREFIXes, each of which must match, built with its own settings. Its users see the
# internal headers.
function(hmlfc_add_subset name from)
  get_target_property(sources ${from} SOURCES)
  get_target_property(folder ${from} SOURCE_DIR)
  set(chosen "")
  foreach(prefix ${ARGN})
    set(matching ${sources})
    list(FILTER matching INCLUDE REGEX "^${prefix}")
    if(NOT matching)
      message(FATAL_ERROR "${name}: ${from} has no source ${prefix}*")
    endif()
    list(APPEND chosen ${matching})
  endforeach()
  list(REMOVE_DUPLICATES chosen)
  list(TRANSFORM chosen PREPEND "${folder}/")
  add_library(${name} STATIC EXCLUDE_FROM_ALL ${chosen})
  target_include_directories(${name} PUBLIC
    "${PROJECT_SOURCE_DIR}/model/include" "${PROJECT_SOURCE_DIR}/model" "${PROJECT_SOURCE_DIR}/tools")
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_link_libraries(${name} PRIVATE hmlfc_warnings PUBLIC tl::expected)
endfunction()
