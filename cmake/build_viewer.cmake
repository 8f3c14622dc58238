# Runs the viewer's npm build into OUT_DIR and puts the finished page at PAGE.
if(NOT EXISTS "${VIEWER_DIR}/node_modules")
  message(FATAL_ERROR "The viewer's npm packages are not installed. Run tools/setup.sh (or `npm ci` "
                      "in viewer/), or configure with -DBUCKENS_VIEWER=OFF.")
endif()
execute_process(
  COMMAND "${NPM}" run --silent build -- --outDir "${OUT_DIR}" --emptyOutDir --logLevel warn
  WORKING_DIRECTORY "${VIEWER_DIR}" RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "The viewer's npm build failed (exit code ${status}); see the lines above.")
endif()
if(NOT EXISTS "${OUT_DIR}/index.html")
  message(FATAL_ERROR "The viewer's npm build wrote no ${OUT_DIR}/index.html.")
endif()
# Written under its final name in one go, so that a running program never reads half a page.
file(COPY_FILE "${OUT_DIR}/index.html" "${PAGE}.part")
file(RENAME "${PAGE}.part" "${PAGE}")
