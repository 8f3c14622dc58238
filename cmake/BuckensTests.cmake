# Tests, found by globbing:
#   src/buckens/<module>/test/*_test.cpp  -> <module>_test      label unit
#   plugins/petsc/test/*_test.cpp         -> petsc_test         label unit
#   verification/*/*_test.cpp             -> verification_test  label verify
#   verification/monolithic/*.cpp         -> buckens_monolithic, a library for those
#   tests/test_*.py                       -> pytest, label cli
#   tools/check_*                         -> structural checks  label structure
#   tests/kill/*.cpp                      -> programs used by those
# The install test stands in BuckensInstall.cmake, the viewer's in BuckensViewer.cmake.
if(NOT BUCKENS_TESTS)
  return()
endif()

find_package(GTest REQUIRED)
include(GoogleTest)
# Debian's interpreter, whatever else stands on PATH: it has h5py and pytest from packages.
find_program(BUCKENS_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(NOT BUCKENS_PYTHON)
  find_program(BUCKENS_PYTHON python3 REQUIRED)
endif()

# Where the checkout lies stands in one object alone (src/buckens/base/test/source_directory.h).
file(CONFIGURE OUTPUT "${BUCKENS_GENERATED_DIR}/source_directory.cpp" CONTENT
     "#include \"buckens/base/test/source_directory.h\"\nconst char* const buckens::test::kSourceDirectory = \"@PROJECT_SOURCE_DIR@\";\n" @ONLY)
add_library(buckens_source_directory OBJECT "${BUCKENS_GENERATED_DIR}/source_directory.cpp")
target_link_libraries(buckens_source_directory PRIVATE buckens_common)

# Tests are compiled without optimisation, which takes half as long; a third of a clean build is tests. These few compute
# much themselves.
set(BUCKENS_COMPUTING_TESTS
    src/buckens/fem/test/shell_block_test src/buckens/fem/test/solid_convergence_test
    src/buckens/loads/test/polyhedron_touch_test src/buckens/spatial/test/capsule_touch_test
    src/buckens/spatial/test/cylinder_touch_test verification/planar_levels/planar_levels_test)
foreach(source IN LISTS BUCKENS_COMPUTING_TESTS)
  set_source_files_properties("${PROJECT_SOURCE_DIR}/${source}.cpp" PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
endforeach()

# buckens_test(name label library source...)
function(buckens_test name label library)
  add_executable(${name} ${ARGN} $<TARGET_OBJECTS:buckens_source_directory>)
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${library} buckens_common nlohmann_json::nlohmann_json
                                        GTest::gmock GTest::gtest GTest::gtest_main)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O0>)
  buckens_link_library_first(${name} ${library})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/test")
  # One entry per program: starting a process per test case costs more than the tests.
  add_test(NAME ${name} COMMAND ${name} --gtest_brief=1
           WORKING_DIRECTORY "${PROJECT_BINARY_DIR}/test")
  set_tests_properties(${name} PROPERTIES LABELS ${label} TIMEOUT 600)
endfunction()

get_property(modules GLOBAL PROPERTY BUCKENS_MODULES)
foreach(module IN LISTS modules)
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/buckens/${module}/test/*.cpp")
  if(sources)
    buckens_test(${module}_test unit buckens_${module} ${sources})
    buckens_in_pieces(${module}_test "${PROJECT_SOURCE_DIR}/src" 32)
  endif()
endforeach()

# The slow alternative for a step, with which those tests compare: optimised, unlike tests.
file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/verification/monolithic/*.cpp")
add_library(buckens_monolithic STATIC EXCLUDE_FROM_ALL ${sources})
target_include_directories(buckens_monolithic PUBLIC "${PROJECT_SOURCE_DIR}")
target_link_libraries(buckens_monolithic PUBLIC buckens buckens_common)
buckens_in_pieces(buckens_monolithic "${PROJECT_SOURCE_DIR}" 0)

file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/verification/*/*_test.cpp"
     "${PROJECT_SOURCE_DIR}/verification/*.cpp")
if(sources)
  buckens_test(verification_test verify buckens ${sources})
  target_link_libraries(verification_test PRIVATE buckens_monolithic)
  buckens_link_library_first(verification_test buckens_monolithic)
  buckens_in_pieces(verification_test "${PROJECT_SOURCE_DIR}" 32)
endif()

# What of the plug-in needs none of its libraries.
file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/plugins/petsc/test/*_test.cpp")
buckens_test(petsc_test unit buckens_base ${sources}
  "${PROJECT_SOURCE_DIR}/plugins/petsc/arrays_aside.cpp" "${PROJECT_SOURCE_DIR}/plugins/petsc/factor_room.cpp"
  "${PROJECT_SOURCE_DIR}/plugins/petsc/kept_columns.cpp" "${PROJECT_SOURCE_DIR}/plugins/petsc/mesh_share.cpp"
  "${PROJECT_SOURCE_DIR}/plugins/petsc/nameless_file.cpp"
  "${PROJECT_SOURCE_DIR}/plugins/petsc/pages_on_disk.cpp")

file(GLOB kill_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/kill/*.cpp")
foreach(source IN LISTS kill_sources)
  cmake_path(GET source STEM name)
  add_executable(${name} ${source})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/test")
  target_link_libraries(${name} PRIVATE buckens buckens_common)
endforeach()

# What a loss of power leaves, for tests/test_power_loss.py.
add_library(kept_by_disk MODULE "${PROJECT_SOURCE_DIR}/tests/power/kept_by_disk.cpp")
set_target_properties(kept_by_disk PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/test")
target_link_libraries(kept_by_disk PRIVATE buckens_common ${CMAKE_DL_LIBS})

# What goes wrong in one of several processes, for tests/test_mpi_failures.py.
foreach(name failing_search lacking_memory)
  add_library(${name} MODULE "${PROJECT_SOURCE_DIR}/tests/failures/${name}.cpp")
  set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/test")
  target_link_libraries(${name} PRIVATE buckens_common)
endforeach()

# Files that take some seconds, or that load the Python module: an entry each, with the seconds of the processor that a run
# takes, by which ctest starts the longest first and both processors end together. A number need not be kept exact.
set(BUCKENS_LONG_TESTS
    ball_bristles 22 continue 43 damaged_results 13 docs_commands 17 docs_site 30 example_warnings 49 examples 8 kill 38
    machine_methods 22 mesh_contact 11 mesh_pairs 20 mpi 60 mpi_division 30 mpi_failures 15 mpi_frames 15 mpi_matrices 50
    mpi_modes 50 mpi_vectors 10 packages 11 python 5 python_arrays 5 python_checkpoints 15 python_examples 30 python_memory 15
    python_mistakes 5 python_package 20 python_results 12 python_signals 5 python_verbs 5 rigid_group_statics 16 rigid_towers 52
    rigid_wedges 24 run 20 save_state 51 shards 7 solver 20 step_bodies 12 step_parts 78 study_arguments 6 study_dask 25
    study_mpi 8 study_progress 5 study_runs 20 study_samples 5 sweep 12)
# Others share a process: to start Python with pytest and NumPy takes longer than most of them. Six take some eight seconds.
set(BUCKENS_FILES_PER_PROCESS 6)
set(BUCKENS_PROCESS_SECONDS 8)
set(BUCKENS_LONG_PROGRAMS
    analysis_test 14 fem_test 8 linalg_test 49 loads_test 6 model_file_test 9 run_store_test 12 verification_test 110)

# buckens_python_test(cost source...): cli.NAME, or cli.NAME.NAME… of several
function(buckens_python_test cost)
  set(names "")
  foreach(source IN LISTS ARGN)
    cmake_path(GET source STEM name)
    string(REGEX REPLACE "^test_" "" name "${name}")
    list(APPEND names "${name}")
  endforeach()
  list(JOIN names "." name)
  add_test(NAME cli.${name} COMMAND ${BUCKENS_PYTHON} -m pytest -q -p no:cacheprovider ${ARGN})
  set_tests_properties(
    cli.${name}
    PROPERTIES
      LABELS cli TIMEOUT 900 COST ${cost}
      ENVIRONMENT
      "BUCKENS_PROGRAM=${PROJECT_BINARY_DIR}/bin/buckens;BUCKENS_SOURCE_DIR=${PROJECT_SOURCE_DIR};BUCKENS_BINARY_DIR=${PROJECT_BINARY_DIR};PYTHONDONTWRITEBYTECODE=1")
endfunction()

file(GLOB python_tests CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/test_*.py"
     "${PROJECT_SOURCE_DIR}/tests/*/test_*.py")
set(together "")
foreach(source IN LISTS python_tests)
  cmake_path(GET source STEM name)
  string(REGEX REPLACE "^test_" "" name "${name}")
  list(FIND BUCKENS_LONG_TESTS "${name}" place)
  if(place GREATER_EQUAL 0)
    math(EXPR place "${place} + 1")
    list(GET BUCKENS_LONG_TESTS ${place} cost)
    buckens_python_test(${cost} "${source}")
    continue()
  endif()
  list(APPEND together "${source}")
  list(LENGTH together count)
  if(count EQUAL BUCKENS_FILES_PER_PROCESS)
    buckens_python_test(${BUCKENS_PROCESS_SECONDS} ${together})
    set(together "")
  endif()
endforeach()
if(together)
  buckens_python_test(${BUCKENS_PROCESS_SECONDS} ${together})
endif()
# Processes that wait for each other: beside other tests they would wait for processors, too. What needs all processors
# comes first, or the others would have to wait for it at the end.
foreach(test cli.mpi cli.mpi_division cli.mpi_failures cli.mpi_frames cli.mpi_matrices cli.mpi_modes cli.mpi_vectors
        cli.study_mpi)
  if(TEST ${test})
    set_tests_properties(${test} PROPERTIES PROCESSORS 2 COST 1000)
  endif()
endforeach()
list(LENGTH BUCKENS_LONG_PROGRAMS length)
math(EXPR last "${length} - 1")
foreach(place RANGE 0 ${last} 2)
  math(EXPR next "${place} + 1")
  list(GET BUCKENS_LONG_PROGRAMS ${place} test)
  list(GET BUCKENS_LONG_PROGRAMS ${next} cost)
  if(TEST ${test})
    set_tests_properties(${test} PROPERTIES COST ${cost})
  endif()
endforeach()

foreach(check IN ITEMS equations floors pages sizes streams)
  add_test(NAME structure.${check} COMMAND ${BUCKENS_PYTHON} -B
                                           "${PROJECT_SOURCE_DIR}/tools/check_${check}.py"
                                           "${PROJECT_SOURCE_DIR}")
endforeach()
add_test(NAME structure.format COMMAND bash "${PROJECT_SOURCE_DIR}/tools/check_format.sh"
                                       "${PROJECT_SOURCE_DIR}")
add_test(NAME structure.checks COMMAND ${BUCKENS_PYTHON} -B
                                       "${PROJECT_SOURCE_DIR}/tools/test/test_checks.py")
add_test(NAME structure.setup COMMAND bash "${PROJECT_SOURCE_DIR}/tools/test/test_setup.sh")
set_tests_properties(
  structure.equations structure.floors structure.pages structure.sizes structure.streams structure.format
  structure.checks structure.setup PROPERTIES LABELS structure TIMEOUT 120)
