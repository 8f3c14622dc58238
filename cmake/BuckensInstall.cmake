# Installation: program, library, headers, CMake package, and the files the program reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/buckens")

install(TARGETS buckens EXPORT buckensTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
        COMPONENT development)

# Public headers: include/buckens/buckens.h, and all that it includes, directly or through others.
set(pending buckens/buckens.h)
set(public_headers "")
while(pending)
  list(POP_FRONT pending header)
  list(APPEND public_headers ${header})
  foreach(root IN ITEMS "${PROJECT_SOURCE_DIR}/include" "${PROJECT_SOURCE_DIR}/src"
                        "${BUCKENS_GENERATED_DIR}")
    if(NOT EXISTS "${root}/${header}")
      continue()
    endif()
    cmake_path(GET header PARENT_PATH folder)
    install(FILES "${root}/${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/${folder}"
            COMPONENT development)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${root}/${header}")
    file(STRINGS "${root}/${header}" includes REGEX "^#include \"buckens/")
    foreach(line IN LISTS includes)
      string(REGEX REPLACE "^#include \"([^\"]*)\".*" "\\1" included "${line}")
      if(NOT included IN_LIST public_headers AND NOT included IN_LIST pending)
        list(APPEND pending ${included})
      endif()
    endforeach()
  endforeach()
endwhile()
install(EXPORT buckensTargets NAMESPACE buckens:: DESTINATION "${package_dir}"
        COMPONENT development)
configure_package_config_file(cmake/buckensConfig.cmake.in
                              "${PROJECT_BINARY_DIR}/buckensConfig.cmake"
                              INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/buckensConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(
  FILES "${PROJECT_BINARY_DIR}/buckensConfig.cmake" "${PROJECT_BINARY_DIR}/buckensConfigVersion.cmake"
        cmake/FindSuiteSparse.cmake cmake/FindOpenBLAS.cmake cmake/FindMETIS.cmake
        cmake/FindHDF5Serial.cmake cmake/FindGmsh.cmake
  DESTINATION "${package_dir}" COMPONENT development)
install(FILES LICENSE NOTICE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)
install(FILES docs/man/buckens.1 DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT program)

if(TARGET buckens_program)
  install(TARGETS buckens_program RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
endif()
if(TARGET buckens_viewer)
  install(FILES "${BUCKENS_VIEWER_PAGE}" DESTINATION "${CMAKE_INSTALL_DATADIR}/buckens" COMPONENT program)
endif()
if(EXISTS "${PROJECT_SOURCE_DIR}/schema")
  install(DIRECTORY schema DESTINATION "${CMAKE_INSTALL_DATADIR}/buckens" COMPONENT program)
endif()
if(EXISTS "${PROJECT_SOURCE_DIR}/examples")
  install(DIRECTORY examples DESTINATION "${CMAKE_INSTALL_DATADIR}/buckens" COMPONENT program)
endif()

if(BUCKENS_TESTS)
  # An outside project is configured, built and run against an installation of this build.
  add_test(
    NAME install
    COMMAND
      "${CMAKE_COMMAND}" -D "BUILD_DIR=${PROJECT_BINARY_DIR}"
      -D "SOURCE_DIR=${PROJECT_SOURCE_DIR}/tests/install" -D "GENERATOR=${CMAKE_GENERATOR}" -D
      "CXX_COMPILER=${CMAKE_CXX_COMPILER}" -D "CXX_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}" -D
      "VERSION=${PROJECT_VERSION}" -P "${PROJECT_SOURCE_DIR}/tests/install/run.cmake")
  set_tests_properties(install PROPERTIES LABELS install TIMEOUT 600 COST 30)
endif()
