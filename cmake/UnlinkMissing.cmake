# Run by cmake --install: links of installed documents to files that are not installed become plain
# text. DATA is the folder share/hmlfc of the installation.

file(GLOB_RECURSE documents "${DATA}/docs/*.md" "${DATA}/vectors/*.md")
foreach(document ${documents})
  get_filename_component(folder "${document}" DIRECTORY)
  file(READ "${document}" text)
  # Without brackets, which have a meaning in lists.
  string(REPLACE "](" "@(" plain "${text}")
  string(REGEX MATCHALL "@\\([A-Za-z0-9_./-]+" links "${plain}")
  list(REMOVE_DUPLICATES links)
  set(unlinked "${text}")
  foreach(link ${links})
    string(SUBSTRING "${link}" 2 -1 path)
    if(NOT EXISTS "${folder}/${path}")
      string(REGEX REPLACE "\\[([^]]*)\\]\\(${path}[^)]*\\)" "\\1" unlinked "${unlinked}")
    endif()
  endforeach()
  if(NOT unlinked STREQUAL text)
    file(WRITE "${document}" "${unlinked}")
  endif()
endforeach()
