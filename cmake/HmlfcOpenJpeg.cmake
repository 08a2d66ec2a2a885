# Sources of Debian 12 for systems without packages of them. Nothing of them becomes part of the repository.
set(HMLFC_OPENJPEG "${PROJECT_BINARY_DIR}/openjpeg" CACHE PATH "folder of Debian's source archives of OpenJPEG 2.5.0")
set(HMLFC_PNG "${PROJECT_BINARY_DIR}/libpng" CACHE PATH "folder of Debian's source archives of libpng 1.6.39")

# hmlfc_fetch(FOUND FOLDER POOL ARCHIVE=SHA256...): gets the archives from where this system's packages come from; ON if
# they are there.
function(hmlfc_fetch found folder pool)
  set(${found} ON PARENT_SCOPE)
  execute_process(COMMAND apt-get indextargets --format "$(REPO_URI)" OUTPUT_VARIABLE archives)
  string(REGEX MATCHALL "[^\n]+" archives "${archives}")
  list(REMOVE_DUPLICATES archives)
  foreach(source ${ARGN})
    string(REPLACE "=" ";" source "${source}")
    list(POP_FRONT source name hash)
    set(file "${folder}/${name}")
    foreach(archive ${archives})
      if(NOT EXISTS "${file}")
        file(DOWNLOAD "${archive}pool/main/${pool}/${name}" "${file}.part" INACTIVITY_TIMEOUT 10 TIMEOUT 60 STATUS status)
        if(EXISTS "${file}.part" AND status MATCHES "^0;")
          file(RENAME "${file}.part" "${file}")
        endif()
      endif()
    endforeach()
    set(sum "")
    if(EXISTS "${file}")
      file(SHA256 "${file}" sum)
    endif()
    if(NOT sum STREQUAL hash)
      file(REMOVE "${file}" "${file}.part")
      set(${found} OFF PARENT_SCOPE)
      message(STATUS "${name} cannot be fetched (HMLFC_OPENJPEG, HMLFC_PNG: folders with such archives)")
    endif()
  endforeach()
endfunction()

function(hmlfc_fetch_openjpeg found)
  hmlfc_fetch(all "${HMLFC_OPENJPEG}" o/openjpeg2
    openjpeg2_2.5.0.orig.tar.xz=007e19d772c8b6b22e35379630b06ff3549e49ba719d96453607a36ad7b4de73
    openjpeg2_2.5.0-2+deb12u3.debian.tar.xz=36dedb0ca4c1659c173feac97c19b31985656f4cd112b1a4d54d54bc4133ad37)
  set(${found} ${all} PARENT_SCOPE)
endfunction()

function(hmlfc_fetch_png found)
  hmlfc_fetch(all "${HMLFC_PNG}" libp/libpng1.6
    libpng1.6_1.6.39.orig.tar.gz=a00e9d2f2f664186e4202db9299397f851aea71b36a35e74910b8820e380d441
    libpng1.6_1.6.39-2+deb12u5.debian.tar.xz=ab14906eda9fddf14cbb1e589b9ba7439c22e233dc3c5e3cf9356c9625565a82)
  set(${found} ${all} PARENT_SCOPE)
endfunction()

# hmlfc_unpack(ARCHIVES FOLDER): FOLDER/library becomes the source in the folder ARCHIVES, patched.
function(hmlfc_unpack archives folder)
  if(NOT EXISTS "${folder}/patched")
    file(REMOVE_RECURSE "${folder}")
    file(MAKE_DIRECTORY "${folder}")
    execute_process(WORKING_DIRECTORY "${folder}" COMMAND_ERROR_IS_FATAL ANY COMMAND sh -ec
      "for archive in '${archives}'/*.tar.?z; do '${CMAKE_COMMAND}' -E tar xf \"$archive\"; done; mv *-* library
      for name in $(grep -v '^#' debian/patches/series); do patch -s -p1 -d library -i \"../debian/patches/$name\"; done
      touch patched")
  endif()
endfunction()

function(hmlfc_unpack_openjpeg folder)
  hmlfc_unpack("${HMLFC_OPENJPEG}" "${folder}")
endfunction()
