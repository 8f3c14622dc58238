# The Python module (python/): package `buckens` around the extension `buckens._core`. In the build tree
# it is usable with PYTHONPATH=<build>/python; the files in Python are links to their sources there.
option(BUCKENS_PYTHON_MODULE "Build the Python module where pybind11 is installed" ON)
if(NOT BUCKENS_PYTHON_MODULE)
  return()
endif()

# Debian's interpreter, whatever else stands on PATH: pybind11 and NumPy are packages of it.
if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python COMPONENTS Interpreter Development.Module)
if(Python_Development.Module_FOUND)
  find_package(pybind11 2.10 CONFIG QUIET)
endif()
if(NOT pybind11_FOUND)
  message(STATUS "The Python module is left out: it needs pybind11-dev and python3-dev")
  return()
endif()

set(package "${PROJECT_BINARY_DIR}/python/buckens")
file(GLOB binding_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/python/bindings/*.cpp")
# Without extras: no link-time optimisation, which takes long; nothing here is computed.
pybind11_add_module(buckens_python MODULE NO_EXTRAS ${binding_sources})
# pybind11 costs each source more than its own lines.
buckens_in_pieces(buckens_python "${PROJECT_SOURCE_DIR}/python" 32)
set_target_properties(buckens_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY
                                                                  "${package}")
target_include_directories(buckens_python PRIVATE "${PROJECT_SOURCE_DIR}/python")
target_link_libraries(buckens_python PRIVATE buckens buckens_options)
target_compile_options(buckens_python PRIVATE $<$<CONFIG:Release>:-O1>)
buckens_link_library_first(buckens_python buckens)

file(GLOB package_files CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/python/buckens/*")
list(FILTER package_files INCLUDE REGEX "\\.(py|pyi|typed)$")
file(MAKE_DIRECTORY "${package}")
foreach(file IN LISTS package_files)
  cmake_path(GET file FILENAME name)
  file(CREATE_LINK "${file}" "${package}/${name}" SYMBOLIC)
endforeach()

# Classes of the parts of a model, from the field lists of the reader by way of the schema.
set(schema "${PROJECT_SOURCE_DIR}/schema/model.schema.json")
set(maker "${PROJECT_SOURCE_DIR}/python/make_objects.py")
set(objects "${PROJECT_BINARY_DIR}/python/buckens/objects.py")
add_custom_command(
  OUTPUT "${objects}"
  COMMAND "${Python_EXECUTABLE}" -B "${maker}" "${schema}" "${objects}"
  DEPENDS "${maker}" "${schema}"
  COMMENT "Generating buckens/objects.py")
add_custom_target(buckens_python_objects ALL DEPENDS "${objects}")
add_dependencies(buckens_python buckens_python_objects)

# Where the interpreter of that prefix looks: Debian's own packages, or what is local to a machine.
if(EXISTS /etc/debian_version)
  set(folder "dist-packages")
else()
  set(folder "site-packages")
endif()
set(BUCKENS_PYTHON_DIR "lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/${folder}"
    CACHE STRING "Where the Python module is installed, below the prefix")
install(TARGETS buckens_python LIBRARY DESTINATION "${BUCKENS_PYTHON_DIR}/buckens" COMPONENT python)
install(FILES ${package_files} "${objects}" DESTINATION "${BUCKENS_PYTHON_DIR}/buckens" COMPONENT python)
