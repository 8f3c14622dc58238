# The viewer page: npm builds one self-contained file. node_modules comes from tools/setup.sh
# (npm ci), never from configuring or building.
if(NOT BUCKENS_VIEWER OR NOT EXISTS "${PROJECT_SOURCE_DIR}/viewer/package.json")
  return()
endif()
