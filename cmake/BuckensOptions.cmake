# Options of the build and the compile flags shared by everything in this project.
include(CMakeDependentOption)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo" FORCE)
endif()

option(BUCKENS_TESTS "Build the tests" ON)
option(BUCKENS_BENCH "Build the benchmark programs" OFF)
option(BUCKENS_VIEWER "Build the viewer page with npm" ON)
option(BUCKENS_GPL "Link libraries under the GPL: SPQR, CHOLMOD; mesh STEP files by Gmsh" ON)
option(BUCKENS_PETSC "Build the plug-in for iterative solves with PETSc (libpetsc-real-dev, libslepc-real-dev, libptscotch-dev)" OFF)
option(BUCKENS_MPI "The same, and runs over several processes with mpirun (openmpi-bin)" OFF)
option(BUCKENS_WERROR "Treat compiler warnings as errors" OFF)
option(BUCKENS_UNITY "Compile several sources of a module in one piece: quicker from nothing, slower after a change" OFF)
option(BUCKENS_NATIVE "Tune for the processor of this machine (binaries do not run elsewhere)" OFF)
option(BUCKENS_ASSERTIONS "Check BUCKENS_ASSERT and Eigen's assertions" OFF)
set(BUCKENS_SANITIZE "" CACHE STRING "Sanitizers to build with, e.g. address,undefined")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

find_program(BUCKENS_CCACHE ccache)
mark_as_advanced(BUCKENS_CCACHE)
if(BUCKENS_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER "${BUCKENS_CCACHE}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${BUCKENS_CCACHE}")
endif()

# With clang, lld links where it is installed: it joins the 65 000 groups of sections of the library in 1 s, GNU ld in 40 s, and
# links the program in 0.6 s instead of 4 s.
find_program(BUCKENS_LLD NAMES ld.lld-14 ld.lld)
mark_as_advanced(BUCKENS_LLD)
set(BUCKENS_LINKER "")
if(BUCKENS_LLD AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  set(BUCKENS_LINKER "--ld-path=${BUCKENS_LLD}")
  add_link_options(${BUCKENS_LINKER})
endif()

# Everything compiled here links buckens_options; it is never exported.
add_library(buckens_options INTERFACE)
target_compile_options(buckens_options INTERFACE -Wall -Wextra -Wshadow -Wconversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 sees uninitialised memory in the inside of Eigen's fixed-size transposes; it is mistaken.
  target_compile_options(buckens_options INTERFACE -Wno-maybe-uninitialized)
  # A fifth of GCC's time goes into collecting memory that these machines have: one GiB per process is
  # left alone.
  target_compile_options(buckens_options INTERFACE "SHELL:--param=ggc-min-heapsize=1048576"
                                                   "SHELL:--param=ggc-min-expand=100")
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # Of clang it is a part of -Wconversion, of GCC it is not.
  target_compile_options(buckens_options INTERFACE -Wno-sign-conversion)
endif()
if(BUCKENS_WERROR)
  target_compile_options(buckens_options INTERFACE -Werror)
endif()
# Threads are the caller's decision; Eigen must not start its own inside ours.
target_compile_definitions(buckens_options INTERFACE EIGEN_DONT_PARALLELIZE)
if(BUCKENS_ASSERTIONS)
  target_compile_definitions(buckens_options INTERFACE BUCKENS_ASSERTIONS=1)
  # Assertions follow NDEBUG in Eigen; -U comes after the flags of the build type.
  target_compile_options(buckens_options INTERFACE -UNDEBUG)
endif()
if(BUCKENS_SANITIZE)
  target_compile_options(buckens_options INTERFACE -fsanitize=${BUCKENS_SANITIZE}
                                                   -fno-omit-frame-pointer)
  target_link_options(buckens_options INTERFACE -fsanitize=${BUCKENS_SANITIZE})
endif()

# Replaces sources of a target by pieces: files that include up to `size` of them (0: all). Names in
# unnamed namespaces must differ within a piece. Sources with flags of their own stay apart, so those are
# to be set before.
#
# CMake's UNITY_BUILD writes absolute paths into its pieces. These hold paths below `base`, which must be
# an include directory of the target: another checkout makes the same pieces, and the compiler's cache
# knows them.
function(buckens_make_pieces target base size)
  get_target_property(sources ${target} SOURCES)
  set(left "")
  set(joined "")
  foreach(source IN LISTS sources)
    get_source_file_property(flags "${source}" COMPILE_OPTIONS)
    get_source_file_property(alone "${source}" SKIP_UNITY_BUILD_INCLUSION)
    cmake_path(IS_PREFIX base "${source}" is_below)
    if(flags OR alone OR NOT is_below)
      list(APPEND left "${source}")
    else()
      list(APPEND joined "${source}")
    endif()
  endforeach()
  # Pieces of about the same number of sources.
  list(LENGTH joined left_over)
  set(pieces 1)
  if(size GREATER 0)
    math(EXPR pieces "(${left_over} + ${size} - 1) / ${size}")
  endif()
  foreach(number RANGE ${pieces} 1 -1)
    list(LENGTH joined left_over)
    if(left_over EQUAL 0)
      break()
    endif()
    math(EXPR count "(${left_over} + ${number} - 1) / ${number}")
    set(text "")
    foreach(k RANGE 1 ${count})
      list(POP_FRONT joined source)
      cmake_path(RELATIVE_PATH source BASE_DIRECTORY "${base}" OUTPUT_VARIABLE path)
      string(APPEND text "#include \"${path}\"\n")
    endforeach()
    set(piece "${PROJECT_BINARY_DIR}/pieces/${target}/${number}.cpp")
    file(CONFIGURE OUTPUT "${piece}" CONTENT "${text}" @ONLY)
    list(APPEND left "${piece}")
  endforeach()
  set_property(TARGET ${target} PROPERTY SOURCES ${left})
endfunction()

# Pieces of `size` sources where BUCKENS_UNITY asks for them. Compiling is mostly reading headers and making templates,
# for each piece anew: one piece of 32 takes a seventh less time than two of sixteen, and a third less without optimisation.
function(buckens_in_pieces target base size)
  if(BUCKENS_UNITY)
    buckens_make_pieces(${target} "${base}" ${size})
  endif()
endfunction()
