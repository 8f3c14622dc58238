# Options of the build and the compile flags shared by everything in this project.
include(CMakeDependentOption)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo" FORCE)
endif()

option(BUCKENS_TESTS "Build the tests" ON)
option(BUCKENS_BENCH "Build the benchmark programs" OFF)
option(BUCKENS_VIEWER "Build the viewer page with npm" ON)
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

# Everything compiled here links buckens_options; it is never exported.
add_library(buckens_options INTERFACE)
target_compile_options(buckens_options INTERFACE -Wall -Wextra -Wshadow -Wconversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 sees uninitialised memory in the inside of Eigen's fixed-size transposes; it is mistaken.
  target_compile_options(buckens_options INTERFACE -Wno-maybe-uninitialized)
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

# Sources of one target in pieces of eight. Names in unnamed namespaces must differ within a module.
function(buckens_in_pieces target)
  if(BUCKENS_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  endif()
endfunction()
