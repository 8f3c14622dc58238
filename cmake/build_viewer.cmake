# Runs the viewer's npm build, which writes viewer/dist/index.html (the page tests use that one), and
# puts the page at PAGE.
if(NOT EXISTS "${VIEWER_DIR}/node_modules")
  message(FATAL_ERROR "The viewer's npm packages are not installed. Run tools/setup.sh (or `npm ci` "
                      "in viewer/), or configure with -DBUCKENS_VIEWER=OFF.")
endif()
execute_process(
  COMMAND "${NPM}" run --silent build -- --logLevel error
  WORKING_DIRECTORY "${VIEWER_DIR}" RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "The viewer's npm build failed (exit code ${status}); see the lines above.")
endif()
if(NOT EXISTS "${VIEWER_DIR}/dist/index.html")
  message(FATAL_ERROR "The viewer's npm build wrote no ${VIEWER_DIR}/dist/index.html.")
endif()
# Written under its final name in one go, so that a running program never reads half a page.
file(COPY_FILE "${VIEWER_DIR}/dist/index.html" "${PAGE}.part")
file(RENAME "${PAGE}.part" "${PAGE}")
