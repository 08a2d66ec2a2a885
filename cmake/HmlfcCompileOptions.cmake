# Compiler and linker settings of every target of this project. None of them reaches an installed
# package: they are directory-wide or come from interface targets of the build alone.

set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# Targets that link this one (as $<BUILD_INTERFACE:hmlfc_warnings>) get the project's warnings.
add_library(hmlfc_warnings INTERFACE)
target_compile_options(hmlfc_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${HMLFC_WERROR}>:-Werror>)

# No implicit fused multiply-add: floating point in the scenes and in the encoder's decisions gives
# the same result on every instruction set.
add_compile_options(-ffp-contract=off)

# hmlfc_compile_together(TARGET...): its sources in a few large units, where HMLFC_UNITY is on. Headers
# of templates (CLI11, nlohmann-json, GoogleTest) then cost their time once, not once a file. Each file
# includes what it uses all the same: presets other than `release` compile it alone.
function(hmlfc_compile_together)
  set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ${HMLFC_UNITY} UNITY_BUILD_BATCH_SIZE 15)
endfunction()

# hmlfc_compile_quickly(TARGET...): the same, and with few optimisations.
function(hmlfc_compile_quickly)
  hmlfc_compile_together(${ARGN})
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

if(HMLFC_SANITIZE)
  add_compile_options(-fsanitize=${HMLFC_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${HMLFC_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # warns of GCC's own <regex> in such a build
    add_compile_options(-Wno-maybe-uninitialized)
  endif()
endif()

if(HMLFC_COVERAGE)
  add_compile_options(--coverage -fprofile-update=atomic)
  add_link_options(--coverage)
endif()

# The two tools below only make builds faster; each is used where it is installed.
find_program(HMLFC_CCACHE ccache)
if(HMLFC_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${HMLFC_CCACHE}")
endif()

include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=mold HMLFC_HAS_MOLD)
if(HMLFC_HAS_MOLD)
  add_link_options(-fuse-ld=mold)
endif()
