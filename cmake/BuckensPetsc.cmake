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
pkg_check_modules(slepc REQUIRED IMPORTED_TARGET slepc>=3.18)

# PETSc itself is in a library that the plug-in loads when one of its solvers is asked for: with what it brings along, it takes memory in each process.
function(add_buckens_plugin name)
  file(GLOB sources CONFIGURE_DEPENDS ${ARGN})
  add_library(${name} MODULE ${sources})
  set_target_properties(${name} PROPERTIES CXX_VISIBILITY_PRESET hidden LIBRARY_OUTPUT_DIRECTORY
                                                                        "${PROJECT_BINARY_DIR}/lib")
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/src")
  target_link_libraries(${name} PRIVATE buckens_options MPI::MPI_C)
  install(TARGETS ${name} LIBRARY DESTINATION lib/buckens COMPONENT program)
endfunction()

add_buckens_plugin(buckens_petsc_solvers "${PROJECT_SOURCE_DIR}/plugins/petsc/solvers/*.cpp")
target_link_libraries(buckens_petsc_solvers PRIVATE PkgConfig::slepc PkgConfig::petsc)

add_buckens_plugin(buckens_petsc "${PROJECT_SOURCE_DIR}/plugins/petsc/*.cpp")
find_path(mumps_headers dmumps_c.h REQUIRED)
find_library(mumps_library dmumps REQUIRED)
find_path(ptscotch_headers ptscotch.h PATH_SUFFIXES scotch REQUIRED)
find_library(ptscotch_library ptscotch REQUIRED)
find_library(scotch_library scotch REQUIRED)
find_library(ptscotch_errors ptscotcherr REQUIRED)
target_include_directories(buckens_petsc SYSTEM PRIVATE ${mumps_headers} ${ptscotch_headers}
                                                        ${petsc_INCLUDE_DIRS})
target_link_libraries(buckens_petsc PRIVATE ${mumps_library} ${ptscotch_library} ${scotch_library}
                                            ${ptscotch_errors} ${CMAKE_DL_LIBS})
add_dependencies(buckens_petsc buckens_petsc_solvers)
