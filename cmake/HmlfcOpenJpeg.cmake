# OpenJPEG as Debian 12 has it, for processors without a package of it. Nothing of it becomes part of the repository.
set(HMLFC_OPENJPEG "${PROJECT_BINARY_DIR}/openjpeg" CACHE PATH "folder of Debian's source archives of OpenJPEG 2.5.0")

# hmlfc_fetch_openjpeg(FOUND): gets its two archives from where this system's packages come from; ON if they are there.
function(hmlfc_fetch_openjpeg found)
  set(${found} ON PARENT_SCOPE)
  execute_process(COMMAND apt-get indextargets --format "$(REPO_URI)" OUTPUT_VARIABLE archives)
  string(REGEX MATCHALL "[^\n]+" archives "${archives}")
  list(REMOVE_DUPLICATES archives)
  set(names openjpeg2_2.5.0.orig.tar.xz openjpeg2_2.5.0-2+deb12u3.debian.tar.xz)
  set(hashes 007e19d772c8b6b22e35379630b06ff3549e49ba719d96453607a36ad7b4de73
    36dedb0ca4c1659c173feac97c19b31985656f4cd112b1a4d54d54bc4133ad37)
  foreach(name hash IN ZIP_LISTS names hashes)
    set(file "${HMLFC_OPENJPEG}/${name}")
    foreach(archive ${archives})
      if(NOT EXISTS "${file}")
        file(DOWNLOAD "${archive}pool/main/o/openjpeg2/${name}" "${file}.part" INACTIVITY_TIMEOUT 10 TIMEOUT 60 STATUS status)
        if(EXISTS "${file}.part" AND status MATCHES "^0;")
          file(RENAME "${file}.part" "${file}")
        endif()
      endif()
    endforeach()
    if(EXISTS "${file}")
      file(SHA256 "${file}" sum)
    endif()
    if(NOT sum STREQUAL hash)
      file(REMOVE "${file}" "${file}.part")
      set(${found} OFF PARENT_SCOPE)
      message(STATUS "${name} of OpenJPEG cannot be fetched (HMLFC_OPENJPEG: a folder with it)")
    endif()
  endforeach()
endfunction()

# hmlfc_unpack_openjpeg(FOLDER): FOLDER/library becomes its source, patched.
function(hmlfc_unpack_openjpeg folder)
  if(NOT EXISTS "${folder}/patched")
    file(REMOVE_RECURSE "${folder}")
    file(MAKE_DIRECTORY "${folder}")
    execute_process(WORKING_DIRECTORY "${folder}" COMMAND_ERROR_IS_FATAL ANY COMMAND sh -ec
      "for archive in '${HMLFC_OPENJPEG}'/*.tar.xz; do '${CMAKE_COMMAND}' -E tar xf \"$archive\"; done; mv openjpeg-* library
      for name in $(grep -v '^#' debian/patches/series); do patch -s -p1 -d library -i \"../debian/patches/$name\"; done
      touch patched")
  endif()
endfunction()
