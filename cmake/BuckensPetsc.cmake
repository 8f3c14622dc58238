# The multigrid solver for iterative solves, and factors over several processes: a plug-in that is loaded when somebody asks for it. Nothing else links PETSc, MPI and what they bring along (docs/developers/iterative.md).
if(NOT BUCKENS_PETSC AND NOT BUCKENS_MPI)
  return()
endif()

find_package(PkgConfig REQUIRED)
find_package(MPI REQUIRED COMPONENTS C)
if(BUCKENS_MPI AND NOT MPIEXEC_EXECUTABLE)
  message(FATAL_ERROR "BUCKENS_MPI: there is no mpirun; install openmpi-bin, or switch the option off")
endif()
pkg_check_modules(petsc REQUIRED IMPORTED_TARGET petsc>=3.18)

file(GLOB petsc_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/plugins/petsc/*.cpp")
add_library(buckens_petsc MODULE ${petsc_sources})
set_target_properties(
  buckens_petsc PROPERTIES CXX_VISIBILITY_PRESET hidden LIBRARY_OUTPUT_DIRECTORY
                                                        "${PROJECT_BINARY_DIR}/lib")
target_include_directories(buckens_petsc PRIVATE "${PROJECT_SOURCE_DIR}/src")
find_path(mumps_headers dmumps_c.h REQUIRED)
find_library(mumps_library dmumps REQUIRED)
target_include_directories(buckens_petsc SYSTEM PRIVATE ${mumps_headers})
target_link_libraries(buckens_petsc PRIVATE buckens_options PkgConfig::petsc ${mumps_library} MPI::MPI_C)
install(TARGETS buckens_petsc LIBRARY DESTINATION lib/buckens COMPONENT program)
