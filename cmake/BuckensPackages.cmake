# Debian packages, made by `cpack` in the build directory (./packages.sh builds first and checks after):
#   buckens          the program with its page, schema and examples
#   libbuckens-dev   the library with its headers
#   python3-buckens  the Python module
#   buckens-doc      the documentation as a site, if ./docs.sh has made it
# They fit the release of Debian on which they are built; ${shlibs} are found by dpkg-shlibdeps.
set(BUCKENS_DOCS_DIR "${PROJECT_SOURCE_DIR}/build/docs" CACHE PATH "The documentation site that is packaged")
install(DIRECTORY "${BUCKENS_DOCS_DIR}/" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/buckens-doc/html"
        COMPONENT documentation EXCLUDE_FROM_ALL OPTIONAL
        PATTERN ".doctrees" EXCLUDE PATTERN ".buildinfo" EXCLUDE)

# `cpack` packs what was built and does not build everything first.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME buckens)
set(CPACK_PACKAGE_VENDOR "the Buckens authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/cmake/debian_tree.cmake")
set(CPACK_BUCKENS_SOURCE_DIR "${PROJECT_SOURCE_DIR}")

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(BUCKENS_PACKAGE_CONTACT "The Buckens authors <buckens@users.noreply.github.com>" CACHE STRING
    "Who makes the packages: name and mail address")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${BUCKENS_PACKAGE_CONTACT}")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(components program development)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME buckens)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# Loaded by name when a STEP file is to be meshed: libgmsh.so.4.8 is in libgmsh4.8.
string(REPLACE ".so." "" gmsh_package "${Gmsh_SONAME}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "${gmsh_package}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3-buckens, buckens-doc")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "Buckens simulates machines whose parts deform. A flexible body is a full
finite-element model in a reference frame that follows its mean motion;
joints, motors, contact and controllers connect the bodies. One
factorisation per body and step size serves the whole simulation.

This package has the program, the page on which it shows runs, the schema of
its models and examples. STEP files need the library of Gmsh.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libbuckens-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# What buckensConfig.cmake asks for.
string(CONCAT CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
       "libeigen3-dev, libfmt-dev, libyaml-cpp-dev, nlohmann-json3-dev, libmuparser-dev, libhdf5-dev, "
       "libsuitesparse-dev, libmetis-dev, libgmsh-dev, zlib1g-dev, libopenblas-openmp-dev | libopenblas-dev, "
       "libspectra-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "Buckens simulates machines whose parts deform, with full finite-element
models as bodies.

This package has the static library, its headers and its CMake package:
find_package(buckens).")

if(TARGET buckens_python)
  list(APPEND components python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-buckens)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/packaging/debian/postinst"
                                                "${PROJECT_SOURCE_DIR}/packaging/debian/prerm")
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (<< 3.${next_minor}), python3 (>= 3.${Python_VERSION_MINOR}~), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "buckens, python3-h5py")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-pandas, python3-scipy, python3-xarray")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
      "Buckens simulates machines whose parts deform, with full finite-element
models as bodies.

This package has the Python module: models from files, dictionaries and
arrays, simulations step by step, forces and controllers as functions,
results as arrays of NumPy.")
endif()

if(EXISTS "${BUCKENS_DOCS_DIR}/index.html")
  list(APPEND components documentation)
  set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME buckens-doc)
  set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
  set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
  set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION
      "Buckens simulates machines whose parts deform, with full finite-element
models as bodies.

This package has its documentation as a site that opens without a server:
tutorials, reference, theory, and pages of the C++ library and the Python
module.")
endif()
set(CPACK_COMPONENTS_ALL ${components})
include(CPack)
