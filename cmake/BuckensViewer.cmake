# The viewer page: npm builds one self-contained file, <build>/share/buckens/viewer.html, where the
# program finds it relative to itself. node_modules comes from tools/setup.sh (npm ci); neither
# configuring nor building downloads anything.
set(viewer_dir "${PROJECT_SOURCE_DIR}/viewer")
if(NOT BUCKENS_VIEWER OR NOT EXISTS "${viewer_dir}/package.json")
  return()
endif()
find_program(BUCKENS_NPM npm)
mark_as_advanced(BUCKENS_NPM)
if(NOT BUCKENS_NPM)
  message(STATUS "npm not found: the viewer page is not built, `buckens view` will not work. "
                 "Install the packages nodejs and npm, or run tools/setup.sh.")
  return()
endif()

set(BUCKENS_VIEWER_PAGE "${PROJECT_BINARY_DIR}/share/buckens/viewer.html")
file(GLOB_RECURSE viewer_sources CONFIGURE_DEPENDS "${viewer_dir}/src/*" "${viewer_dir}/public/*")
file(GLOB viewer_settings CONFIGURE_DEPENDS "${viewer_dir}/*.html" "${viewer_dir}/*.json"
     "${viewer_dir}/*.ts" "${viewer_dir}/*.mjs" "${viewer_dir}/*.js")
add_custom_command(
  OUTPUT "${BUCKENS_VIEWER_PAGE}"
  COMMAND "${CMAKE_COMMAND}" -D "VIEWER_DIR=${viewer_dir}" -D "NPM=${BUCKENS_NPM}" -D
          "PAGE=${BUCKENS_VIEWER_PAGE}" -P
          "${PROJECT_SOURCE_DIR}/cmake/build_viewer.cmake"
  DEPENDS ${viewer_sources} ${viewer_settings} "${PROJECT_SOURCE_DIR}/cmake/build_viewer.cmake"
  COMMENT "Building the viewer page"
  VERBATIM)
add_custom_target(buckens_viewer ALL DEPENDS "${BUCKENS_VIEWER_PAGE}")

if(BUCKENS_TESTS)
  file(READ "${viewer_dir}/package.json" viewer_package)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${viewer_dir}/package.json")
  foreach(script IN ITEMS test test:page)
    string(JSON command ERROR_VARIABLE missing GET "${viewer_package}" scripts "${script}")
    if(missing STREQUAL "NOTFOUND")
      string(REPLACE ":" "-" name "viewer.${script}")
      add_test(NAME ${name} COMMAND "${BUCKENS_NPM}" run --silent "${script}"
               WORKING_DIRECTORY "${viewer_dir}")
      # The page tests share one browser's appetite for the processor; they run alone.
      set_tests_properties(${name} PROPERTIES LABELS viewer TIMEOUT 600 RUN_SERIAL ON COST 1000)
    endif()
  endforeach()
  # The build strips types without checking them.
  add_test(NAME viewer.types COMMAND "${BUCKENS_NPM}" run --silent types WORKING_DIRECTORY "${viewer_dir}")
  set_tests_properties(viewer.types PROPERTIES LABELS viewer TIMEOUT 600)
  add_test(NAME viewer.test-live
           COMMAND "${BUCKENS_NPM}" run --silent test:live -- $<TARGET_FILE:buckens_program>
                   "${PROJECT_SOURCE_DIR}/tests/models/endless.yaml"
           WORKING_DIRECTORY "${viewer_dir}")
  set_tests_properties(viewer.test-live PROPERTIES LABELS viewer TIMEOUT 600 RUN_SERIAL ON COST 1000)
endif()
