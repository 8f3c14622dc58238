# Third-party packages; all are Debian packages, nothing is downloaded. Keep in step with
# buckensConfig.cmake.in and tools/setup.sh.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(muparser REQUIRED)
find_package(HDF5Serial 1.10 REQUIRED)
find_package(SuiteSparse REQUIRED COMPONENTS CHOLMOD KLU SPQR)
find_package(METIS REQUIRED)
find_package(Gmsh 4.8 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(OpenBLAS REQUIRED)
find_package(Spectra REQUIRED)
find_package(Threads REQUIRED)
# The program alone uses these.
find_package(Cairo REQUIRED)
find_package(Httplib REQUIRED)
# Optional: has libFuzzer, for the tests with label fuzz.
find_program(BUCKENS_FUZZ_CLANG NAMES clang++-14 clang++)
mark_as_advanced(BUCKENS_FUZZ_CLANG)
