# Finds the library of Gmsh, which ships no CMake package in Debian 12: Gmsh::Headers.
#
# The program does not link the library: its start takes ten times as long as that of the program.
# It is loaded by name, Gmsh_SONAME, when a STEP file is to be meshed (mesh_io/gmsh/library.h).
find_path(Gmsh_INCLUDE_DIR gmshc.h)
find_library(Gmsh_LIBRARY gmsh)
mark_as_advanced(Gmsh_INCLUDE_DIR Gmsh_LIBRARY)

if(Gmsh_INCLUDE_DIR)
  file(STRINGS "${Gmsh_INCLUDE_DIR}/gmshc.h" _gmsh_version
       REGEX "^#define GMSH_API_VERSION +\"[0-9.]+\"")
  string(REGEX REPLACE ".*\"([0-9.]+)\".*" "\\1" Gmsh_VERSION "${_gmsh_version}")
endif()
if(Gmsh_LIBRARY)
  # libgmsh.so → libgmsh.so.4.8.4; links for the first two numbers come with the library itself.
  file(REAL_PATH "${Gmsh_LIBRARY}" _gmsh_file)
  cmake_path(GET _gmsh_file FILENAME Gmsh_SONAME)
  string(REGEX REPLACE "(\\.so\\.[0-9]+\\.[0-9]+)\\..*" "\\1" Gmsh_SONAME "${Gmsh_SONAME}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  Gmsh
  REQUIRED_VARS Gmsh_LIBRARY Gmsh_INCLUDE_DIR
  VERSION_VAR Gmsh_VERSION)

if(Gmsh_FOUND AND NOT TARGET Gmsh::Headers)
  add_library(Gmsh::Headers INTERFACE IMPORTED)
  set_target_properties(
    Gmsh::Headers
    PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${Gmsh_INCLUDE_DIR}"
               INTERFACE_COMPILE_DEFINITIONS "BUCKENS_GMSH_LIBRARY=\"${Gmsh_SONAME}\"")
endif()
