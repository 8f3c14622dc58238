# The command line program (apps/cli) and the benchmark programs (bench).
file(GLOB cli_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/apps/cli/*.cpp")
if(cli_sources)
  # Objects of their own, which need not wait until the library is joined.
  add_library(buckens_cli OBJECT ${cli_sources})
  if(BUCKENS_UNITY)
    # In one piece: the templates of CLI11 are most of it.
    buckens_make_pieces(buckens_cli "${PROJECT_SOURCE_DIR}/apps" 0)
  endif()
  # Without optimisation, which takes half as long: what computes is the library.
  target_compile_options(buckens_cli PRIVATE $<$<CONFIG:Release>:-O0>)
  target_include_directories(buckens_cli PRIVATE "${PROJECT_SOURCE_DIR}/apps")
  set(cli_libraries CLI11::CLI11 spdlog::spdlog nlohmann_json::nlohmann_json Threads::Threads
                    Cairo::Cairo Httplib::Httplib)
  target_link_libraries(buckens_cli PRIVATE buckens_common HDF5Serial::C ${cli_libraries})
  add_executable(buckens_program $<TARGET_OBJECTS:buckens_cli>)
  set_target_properties(buckens_program PROPERTIES OUTPUT_NAME buckens LINKER_LANGUAGE CXX)
  target_link_libraries(buckens_program PRIVATE buckens buckens_options ${cli_libraries})
  buckens_link_library_first(buckens_program buckens)
endif()

if(BUCKENS_BENCH)
  find_package(benchmark REQUIRED)
  file(GLOB bench_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/bench/*.cpp")
  foreach(source IN LISTS bench_sources)
    cmake_path(GET source STEM name)
    add_executable(${name} ${source})
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bench")
    target_link_libraries(
      ${name} PRIVATE buckens buckens_common benchmark::benchmark
                      nlohmann_json::nlohmann_json OpenBLAS::OpenBLAS)
  endforeach()
endif()
