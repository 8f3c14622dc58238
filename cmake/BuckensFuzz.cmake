# Fuzz programs: tests/fuzz/<target>_fuzz.cpp with seeds in tests/fuzz/corpus/<target>.
#
# The readers under test are compiled once more, by clang with libFuzzer and sanitizers; everything
# else comes from the library as it was built. Without clang there are no fuzz tests.
#
# buckens_fuzz(target seconds source-pattern...): patterns below src/buckens, of the sources to
# instrument. They are compiled in one piece, so names in their anonymous namespaces must differ; the
# sources below stand apart because theirs do not.
if(NOT BUCKENS_TESTS OR BUCKENS_SANITIZE)
  return()
endif()
if(NOT BUCKENS_FUZZ_CLANG)
  message(STATUS "No clang++: the readers are not fuzzed")
  return()
endif()

set(BUCKENS_FUZZ_FLAGS -fsanitize=fuzzer,address)
set(fuzz_cache "")
if(BUCKENS_CCACHE)
  set(fuzz_cache "${BUCKENS_CCACHE}")
endif()

function(buckens_fuzz target seconds)
  set(main "${PROJECT_SOURCE_DIR}/tests/fuzz/${target}_fuzz.cpp")
  set(sources "")
  foreach(pattern IN LISTS ARGN)
    file(GLOB found CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/buckens/${pattern}")
    list(APPEND sources ${found})
  endforeach()
  if(NOT sources)
    return()
  endif()
  set(name fuzz_${target})
  add_executable(${name} "${main}" ${sources})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE buckens buckens_common yaml-cpp nlohmann_json::nlohmann_json)
  # clang knows more warnings than the compiler that the sources are written for. To optimise with
  # sanitizers takes longer than what is saved in the seconds that these programs run.
  target_compile_options(${name} PRIVATE -w -O0 -g0 ${BUCKENS_FUZZ_FLAGS})
  target_link_options(${name} PRIVATE ${BUCKENS_FUZZ_FLAGS})
  if(BUCKENS_UNITY)
    # A piece of the library defines readers once more, beside what is wanted of it; those compiled
    # here stand first and are taken.
    target_link_options(${name} PRIVATE -Wl,--allow-multiple-definition)
  endif()
  set_target_properties(
    ${name}
    PROPERTIES CXX_COMPILER_LAUNCHER "${BUCKENS_WITH_CLANG};${fuzz_cache};--"
               RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/test")
  buckens_make_pieces(${name} "${PROJECT_SOURCE_DIR}" 0)
  list(JOIN BUCKENS_WITH_CLANG " " launcher)
  set_target_properties(${name} PROPERTIES RULE_LAUNCH_LINK "${launcher} --")
  set(dictionary "${PROJECT_SOURCE_DIR}/tests/fuzz/${target}.dict")
  set(options --seconds ${seconds})
  if(EXISTS "${dictionary}")
    list(APPEND options --dictionary "${dictionary}")
  endif()
  add_test(NAME fuzz.${target}
           COMMAND ${BUCKENS_PYTHON} -B "${PROJECT_SOURCE_DIR}/tests/fuzz/run_fuzzer.py" ${options}
                   "$<TARGET_FILE:${name}>" "${PROJECT_SOURCE_DIR}/tests/fuzz/corpus/${target}")
  set_tests_properties(fuzz.${target} PROPERTIES LABELS fuzz TIMEOUT 120 COST ${seconds})
endfunction()

set_source_files_properties(
  "${PROJECT_SOURCE_DIR}/src/buckens/mesh_io/gmsh/msh4.cpp"
  "${PROJECT_SOURCE_DIR}/src/buckens/mesh_io/matrix/node_table.cpp"
  "${PROJECT_SOURCE_DIR}/src/buckens/mesh_io/universal/file.cpp" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

buckens_fuzz(nastran 5 mesh_io/nastran/*.cpp)
buckens_fuzz(abaqus 5 mesh_io/abaqus/*.cpp)
buckens_fuzz(gmsh 5 mesh_io/gmsh/elements.cpp mesh_io/gmsh/mesh.cpp mesh_io/gmsh/msh?.cpp
             mesh_io/gmsh/reader.cpp mesh_io/mesh_text.cpp mesh_io/tagged_mesh.cpp
             mesh_io/universal/file.cpp)
buckens_fuzz(matrix 4 mesh_io/matrix/file.cpp mesh_io/matrix/node_table.cpp)
# The fields of all specs in one piece take minutes to compile; they come from the library.
buckens_fuzz(model_file 8 model_file/yaml_tree.cpp model_file/values.cpp)
buckens_fuzz(results 8 run_store/run_reader.cpp run_store/run_channels.cpp run_store/run_snapshot.cpp
             run_store/run_curves.cpp run_store/run_comparison.cpp run_store/hdf5_geometry.cpp
             run_store/hdf5_geometry_tables.cpp run_store/table_rows.cpp
             run_store/hdf5_objects.cpp run_store/hdf5_reading.cpp run_store/hdf5_sections.cpp
             run_store/hdf5_texts.cpp run_store/basis_files.cpp files/isolated_work.cpp
             exports/*.cpp page/*.cpp)
