# The compiler, unless CC and CXX or a toolchain name another one: clang 14 where it is installed. It compiles in half of the
# time that GCC 12 takes, and the program is no slower (docs/developers/benchmarks.md). Read before project().
if(CMAKE_CXX_COMPILER
   OR CMAKE_TOOLCHAIN_FILE
   OR DEFINED ENV{CXX}
   OR DEFINED ENV{CC})
  return()
endif()
find_program(BUCKENS_CLANG NAMES clang-14)
find_program(BUCKENS_CLANGXX NAMES clang++-14)
mark_as_advanced(BUCKENS_CLANG BUCKENS_CLANGXX)
if(BUCKENS_CLANG AND BUCKENS_CLANGXX)
  set(CMAKE_C_COMPILER "${BUCKENS_CLANG}")
  set(CMAKE_CXX_COMPILER "${BUCKENS_CLANGXX}")
endif()
