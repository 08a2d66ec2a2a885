# hmlfc_add_subset(NAME FROM REGEX): a static library NAME of the sources of target FROM that match
# REGEX, built with settings of its own. Its users see the internal headers.
function(hmlfc_add_subset name from regex)
  get_target_property(sources ${from} SOURCES)
  get_target_property(folder ${from} SOURCE_DIR)
  list(FILTER sources INCLUDE REGEX "${regex}")
  list(TRANSFORM sources PREPEND "${folder}/")
  add_library(${name} STATIC EXCLUDE_FROM_ALL ${sources})
  target_include_directories(${name} PUBLIC
    "${PROJECT_SOURCE_DIR}/model/include" "${PROJECT_SOURCE_DIR}/model" "${PROJECT_SOURCE_DIR}/tools")
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_link_libraries(${name} PRIVATE hmlfc_warnings PUBLIC tl::expected)
endfunction()
