# Finds the serial C library of HDF5 as Debian lays it out: target HDF5Serial::C.
# CMake's own FindHDF5 wants the language C in every project that uses buckens and links what the
# library was built with; a shared library needs neither.
find_path(HDF5Serial_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(HDF5Serial_LIBRARY NAMES hdf5_serial hdf5 PATH_SUFFIXES hdf5/serial)
mark_as_advanced(HDF5Serial_INCLUDE_DIR HDF5Serial_LIBRARY)

if(HDF5Serial_INCLUDE_DIR)
  file(GLOB _hdf5_config "${HDF5Serial_INCLUDE_DIR}/H5public.h")
  if(_hdf5_config)
    file(STRINGS "${_hdf5_config}" _hdf5_line REGEX "^#define H5_VERS_(MAJOR|MINOR|RELEASE)[ \t]")
    string(REGEX REPLACE "/\\*[^*]*\\*/" "" _hdf5_line "${_hdf5_line}")
    string(REGEX MATCHALL "(MAJOR|MINOR|RELEASE)[ \t]+[0-9]+" _hdf5_numbers "${_hdf5_line}")
    string(REGEX REPLACE "[A-Z \t]" "" _hdf5_numbers "${_hdf5_numbers}")
    string(REPLACE ";" "." HDF5Serial_VERSION "${_hdf5_numbers}")
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  HDF5Serial
  REQUIRED_VARS HDF5Serial_LIBRARY HDF5Serial_INCLUDE_DIR
  VERSION_VAR HDF5Serial_VERSION)

if(HDF5Serial_FOUND AND NOT TARGET HDF5Serial::C)
  add_library(HDF5Serial::C UNKNOWN IMPORTED)
  set_target_properties(
    HDF5Serial::C PROPERTIES IMPORTED_LOCATION "${HDF5Serial_LIBRARY}"
                             INTERFACE_INCLUDE_DIRECTORIES "${HDF5Serial_INCLUDE_DIR}")
endif()
