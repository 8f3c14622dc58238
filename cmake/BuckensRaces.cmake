# Races between threads: what works on several of them, once more with the thread sanitizer, which
# cannot be mixed with the others. Everything else comes from the library as it was built.
if(NOT BUCKENS_TESTS OR BUCKENS_SANITIZE)
  return()
endif()

set(kernels "${PROJECT_SOURCE_DIR}/src/buckens/linalg/panel_kernels")
set(instrumented
    base/task_pool.cpp
    base/test/task_pool_test.cpp
    linalg/front.cpp
    linalg/multifrontal.cpp
    linalg/panel_factor.cpp
    linalg/panel_kernels_portable.cpp
    linalg/panel_solve.cpp
    linalg/solve_exchange.cpp
    linalg/sparse_cholesky.cpp
    linalg/tree_tasks.cpp
    linalg/test/solve_exchange_test.cpp
    linalg/test/tree_tasks_test.cpp)
# As in src/CMakeLists.txt, whose settings hold there only.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND instrumented linalg/panel_kernels_avx2.cpp linalg/panel_kernels_avx512.cpp)
  set_source_files_properties("${kernels}_avx2.cpp" PROPERTIES COMPILE_OPTIONS "-mavx2;-mfma")
  set_source_files_properties(
    "${kernels}_avx512.cpp" PROPERTIES COMPILE_OPTIONS
                                       "-mavx512f;-mavx512vl;-mavx512dq;-mfma")
endif()
list(TRANSFORM instrumented PREPEND "${PROJECT_SOURCE_DIR}/src/buckens/")

add_executable(race_test ${instrumented} "${PROJECT_SOURCE_DIR}/tests/races/two_threads_test.cpp"
               $<TARGET_OBJECTS:buckens_source_directory>)
get_property(race_libraries GLOBAL PROPERTY BUCKENS_THIRD_PARTY_linalg)
target_include_directories(race_test PRIVATE "${PROJECT_SOURCE_DIR}")
target_link_libraries(race_test PRIVATE buckens buckens_common ${race_libraries} GTest::gmock
                                        GTest::gtest GTest::gtest_main)
target_compile_options(race_test PRIVATE -O1 -g1 -fsanitize=thread)
# The library defines what is compiled here once more; this comes first and is taken.
target_link_options(race_test PRIVATE -fsanitize=thread -Wl,--allow-multiple-definition)
set_target_properties(race_test PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/test")
# The other tests of exchanges solve too much for a sanitizer.
set(race_cases "TaskPool.*:TreeTasks.*:TwoThreads.*:SolveExchange.OneParticipant*")
add_test(NAME race_test COMMAND race_test --gtest_brief=1 "--gtest_filter=${race_cases}")
set(suppressions "${PROJECT_SOURCE_DIR}/tests/races/thread_sanitizer.supp")
set_tests_properties(
  race_test
  PROPERTIES LABELS unit TIMEOUT 300 ENVIRONMENT
             "OMP_NUM_THREADS=1;TSAN_OPTIONS=halt_on_error=1 suppressions=${suppressions}")
