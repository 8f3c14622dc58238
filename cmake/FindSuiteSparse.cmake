# Finds SuiteSparse, which ships no CMake package in Debian 12.
#
#   find_package(SuiteSparse COMPONENTS CHOLMOD KLU SPQR ...)
#
# Components: AMD BTF CAMD CCOLAMD CHOLMOD COLAMD KLU SPQR.
# Defines SuiteSparse_VERSION and an imported target SuiteSparse::<COMPONENT> each, with the
# libraries it needs.
set(_suitesparse_needs_BTF "")
set(_suitesparse_needs_CHOLMOD AMD CAMD CCOLAMD COLAMD)
set(_suitesparse_needs_KLU AMD BTF COLAMD)
set(_suitesparse_needs_SPQR CHOLMOD)
set(_suitesparse_header_SPQR SuiteSparseQR.hpp)

find_path(SuiteSparse_INCLUDE_DIR SuiteSparse_config.h PATH_SUFFIXES suitesparse)
find_library(SuiteSparse_CONFIG_LIBRARY suitesparseconfig)
mark_as_advanced(SuiteSparse_INCLUDE_DIR SuiteSparse_CONFIG_LIBRARY)

if(SuiteSparse_INCLUDE_DIR)
  file(STRINGS "${SuiteSparse_INCLUDE_DIR}/SuiteSparse_config.h" _suitesparse_lines
       REGEX "^#define SUITESPARSE_(MAIN|SUB|SUBSUB)_VERSION +[0-9]+")
  string(REGEX REPLACE "[^0-9;]" "" _suitesparse_numbers "${_suitesparse_lines}")
  string(REPLACE ";" "." SuiteSparse_VERSION "${_suitesparse_numbers}")
endif()

function(_suitesparse_target component)
  if(TARGET SuiteSparse::${component})
    return()
  endif()
  string(TOLOWER ${component} name)
  set(header ${name}.h)
  if(DEFINED _suitesparse_header_${component})
    set(header ${_suitesparse_header_${component}})
  endif()
  find_library(SuiteSparse_${component}_LIBRARY ${name})
  mark_as_advanced(SuiteSparse_${component}_LIBRARY)
  if(NOT SuiteSparse_${component}_LIBRARY OR NOT EXISTS "${SuiteSparse_INCLUDE_DIR}/${header}")
    return()
  endif()
  add_library(SuiteSparse::${component} UNKNOWN IMPORTED)
  set_target_properties(
    SuiteSparse::${component}
    PROPERTIES IMPORTED_LOCATION "${SuiteSparse_${component}_LIBRARY}"
               INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}"
               INTERFACE_LINK_LIBRARIES "${SuiteSparse_CONFIG_LIBRARY}")
  foreach(needed IN LISTS _suitesparse_needs_${component})
    _suitesparse_target(${needed})
    target_link_libraries(SuiteSparse::${component} INTERFACE SuiteSparse::${needed})
  endforeach()
endfunction()

foreach(_component IN LISTS SuiteSparse_FIND_COMPONENTS)
  if(SuiteSparse_INCLUDE_DIR AND SuiteSparse_CONFIG_LIBRARY)
    _suitesparse_target(${_component})
  endif()
  if(TARGET SuiteSparse::${_component})
    set(SuiteSparse_${_component}_FOUND TRUE)
  endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  SuiteSparse
  REQUIRED_VARS SuiteSparse_INCLUDE_DIR SuiteSparse_CONFIG_LIBRARY
  VERSION_VAR SuiteSparse_VERSION
  HANDLE_COMPONENTS)
