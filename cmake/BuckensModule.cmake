# One library per module, and the one library that is delivered.
#
# buckens_module(name floor [library...]) makes, from the *.cpp of src/buckens/<name> and its rooms,
#   buckens_<name>_objects        the compiled sources (absent while there are none),
#   buckens_<name>_light_objects  those that match BUCKENS_LIGHT, compiled without optimisation,
#   buckens_<name>                what tests and higher floors link: this module and all lower floors.
# buckens_library() gathers the objects of all modules into buckens::buckens.
# Sources are globbed: adding a file needs no change here.
#
# With BUCKENS_UNITY the modules of a group in BUCKENS_TOGETHER share objects, named after the first of them, so that there
# are fewer pieces to compile. A module has no library of its own then: its tests link the whole.
#
# Of templates and inline functions that several objects hold, the linker takes the first. So optimised objects precede
# light ones wherever objects are gathered, and steps never run a copy that is not optimised.

set(BUCKENS_GENERATED_DIR "${PROJECT_BINARY_DIR}/generated")

# Settings of everything that is compiled from this project's own sources.
add_library(buckens_common INTERFACE)
target_include_directories(buckens_common INTERFACE "${PROJECT_SOURCE_DIR}/src"
                                                    "${BUCKENS_GENERATED_DIR}")
target_link_libraries(buckens_common INTERFACE Eigen3::Eigen fmt::fmt buckens_options)
if(BUCKENS_NATIVE)
  target_compile_options(buckens_common INTERFACE -march=native)
endif()

function(buckens_module name floor)
  # Lower floors in the order in which the linker wants them: highest first.
  set(lower "")
  set(third_party ${ARGN})
  get_property(modules GLOBAL PROPERTY BUCKENS_MODULES)
  foreach(other IN LISTS modules)
    get_property(other_floor GLOBAL PROPERTY BUCKENS_FLOOR_${other})
    if(other_floor LESS floor)
      list(PREPEND lower buckens_${other})
      get_property(other_third_party GLOBAL PROPERTY BUCKENS_THIRD_PARTY_${other})
      list(APPEND third_party ${other_third_party})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES third_party)

  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/buckens/${name}/*.cpp")
  list(FILTER sources EXCLUDE REGEX "/src/buckens/${name}/test/")
  list(REMOVE_ITEM sources ${BUCKENS_LEFT_OUT})
  set(light_sources ${sources})
  list(FILTER light_sources INCLUDE REGEX "${BUCKENS_LIGHT}")
  list(REMOVE_ITEM sources ${light_sources})
  buckens_group(${name} group)
  set(objects "")
  foreach(kind IN ITEMS "" light_)
    if(${kind}sources)
      set(target buckens_${group}_${kind}objects)
      if(NOT TARGET ${target})
        add_library(${target} OBJECT)
        string(TOUPPER "BUCKENS_${kind}OBJECTS" property)
        set_property(GLOBAL APPEND PROPERTY ${property} ${target})
      endif()
      target_sources(${target} PRIVATE ${${kind}sources})
      target_link_libraries(${target} PRIVATE buckens_common ${third_party})
      list(APPEND objects $<TARGET_OBJECTS:${target}>)
    endif()
  endforeach()
  if(BUCKENS_UNITY)
    add_library(buckens_${name} INTERFACE)
    target_link_libraries(buckens_${name} INTERFACE buckens buckens_common ${third_party})
  elseif(objects)
    add_library(buckens_${name} STATIC EXCLUDE_FROM_ALL ${objects})
    set_target_properties(buckens_${name} PROPERTIES LINKER_LANGUAGE CXX)
    target_link_libraries(buckens_${name} PUBLIC ${lower} buckens_common ${third_party})
  else()
    add_library(buckens_${name} INTERFACE)
    target_link_libraries(buckens_${name} INTERFACE ${lower} buckens_common ${third_party})
  endif()

  set_property(GLOBAL PROPERTY BUCKENS_FLOOR_${name} ${floor})
  set_property(GLOBAL PROPERTY BUCKENS_THIRD_PARTY_${name} ${ARGN})
  set_property(GLOBAL APPEND PROPERTY BUCKENS_MODULES ${name})
  set_property(GLOBAL APPEND PROPERTY BUCKENS_THIRD_PARTY ${ARGN})
endfunction()

# The first module of the group that a module belongs to.
function(buckens_group name result)
  set(${result} ${name} PARENT_SCOPE)
  foreach(group IN LISTS BUCKENS_TOGETHER)
    string(REPLACE "+" ";" members "${group}")
    if(BUCKENS_UNITY AND name IN_LIST members)
      list(GET members 0 first)
      set(${result} ${first} PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# The version stands in the file VERSION alone.
configure_file("${PROJECT_SOURCE_DIR}/cmake/version.h.in"
               "${BUCKENS_GENERATED_DIR}/buckens/base/version.h" @ONLY)

function(buckens_library)
  get_property(optimised GLOBAL PROPERTY BUCKENS_OBJECTS)
  get_property(light GLOBAL PROPERTY BUCKENS_LIGHT_OBJECTS)
  get_property(third_party GLOBAL PROPERTY BUCKENS_THIRD_PARTY)
  set(piece_size 60)
  set(light_piece_size 110)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Whose time grows with the square of the number of Eigen's types in a piece.
    set(piece_size 24)
  endif()
  set(parts "")
  foreach(objects IN LISTS optimised)
    buckens_in_pieces(${objects} "${PROJECT_SOURCE_DIR}/src" ${piece_size})
    list(APPEND parts $<TARGET_OBJECTS:${objects}>)
  endforeach()
  foreach(objects IN LISTS light)
    target_compile_options(${objects} PRIVATE $<$<CONFIG:Release>:-O0>)
    buckens_in_pieces(${objects} "${PROJECT_SOURCE_DIR}/src" ${light_piece_size})
    list(APPEND parts $<TARGET_OBJECTS:${objects}>)
  endforeach()
  # One object of all parts: from an archive of many, programs would take them in an order of their own.
  set(joined "${CMAKE_CURRENT_BINARY_DIR}/buckens.o")
  # Not by gold: what it joins has tables of exceptions that GNU ld refuses.
  add_custom_command(OUTPUT "${joined}" COMMAND "${CMAKE_CXX_COMPILER}" -r -nostdlib ${BUCKENS_LINKER} -o "${joined}" ${parts}
                     DEPENDS ${parts} COMMAND_EXPAND_LISTS VERBATIM COMMENT "Joining the objects of the library")
  set_source_files_properties("${joined}" PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
  add_library(buckens STATIC "${joined}")
  set_target_properties(buckens PROPERTIES LINKER_LANGUAGE CXX)
  add_library(buckens::buckens ALIAS buckens)
  target_compile_features(buckens PUBLIC cxx_std_20)
  target_include_directories(
    buckens PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                   $<BUILD_INTERFACE:${BUCKENS_GENERATED_DIR}> $<INSTALL_INTERFACE:include>)
  # What the headers show; run_store/run_reader.h holds HDF5 handles.
  target_link_libraries(buckens PUBLIC Eigen3::Eigen fmt::fmt HDF5Serial::C)
  if(BUCKENS_NATIVE)
    # Eigen's alignment depends on the processor flags, so users of the library must share them.
    target_compile_options(buckens PUBLIC -march=native)
  endif()
  if(BUCKENS_SANITIZE)
    target_link_options(buckens PUBLIC -fsanitize=${BUCKENS_SANITIZE})
  endif()
  list(REMOVE_DUPLICATES third_party)
  list(REMOVE_ITEM third_party Eigen3::Eigen fmt::fmt)
  target_link_libraries(buckens PRIVATE ${third_party} $<BUILD_INTERFACE:buckens_options>)
endfunction()

# Every header compiles alone. Where a source of the same name includes it first, as
# tools/check_floors.py asks for, the library's build shows that; the target buckens_headers, built by
# test.sh, shows it of the others.
function(buckens_header_checks)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/buckens/*.h")
  list(FILTER headers EXCLUDE REGEX "/test/")
  set(checks "")
  foreach(header IN LISTS headers)
    cmake_path(REPLACE_EXTENSION header LAST_ONLY .cpp OUTPUT_VARIABLE source)
    if(EXISTS "${source}")
      continue()
    endif()
    cmake_path(RELATIVE_PATH header BASE_DIRECTORY "${PROJECT_SOURCE_DIR}/src" OUTPUT_VARIABLE path)
    string(MAKE_C_IDENTIFIER "${path}" name)
    set(check "${BUCKENS_GENERATED_DIR}/header_checks/${name}.cpp")
    file(CONFIGURE OUTPUT "${check}" CONTENT "#include \"${path}\"\n")
    list(APPEND checks "${check}")
  endforeach()
  get_property(third_party GLOBAL PROPERTY BUCKENS_THIRD_PARTY)
  add_library(buckens_headers OBJECT EXCLUDE_FROM_ALL ${checks})
  target_compile_options(buckens_headers PRIVATE -O0 -g0)
  # Read once, not a hundred times; that a header forgets to include these goes unnoticed here.
  target_precompile_headers(buckens_headers PRIVATE <Eigen/Dense> <Eigen/Sparse> <fmt/format.h>)
  target_link_libraries(buckens_headers PRIVATE buckens_common ${third_party})
  if(BUCKENS_FUZZ_CLANG)
    # clang reads a precompiled header as far as it is needed, and takes half of GCC's time.
    target_compile_options(buckens_headers PRIVATE -w)
    set_target_properties(buckens_headers PROPERTIES CXX_COMPILER_LAUNCHER "${BUCKENS_WITH_CLANG};--")
  endif()
endfunction()

# Puts the library in front of a program's own objects: of templates that both make the linker takes the first, and those
# of tests and of the command line are not optimised.
function(buckens_link_library_first name library)
  get_target_property(kind ${library} TYPE)
  if(kind STREQUAL INTERFACE_LIBRARY)
    set(library buckens)
  endif()
  set(archives $<TARGET_FILE:${library}>)
  string(REGEX REPLACE "^buckens_" "" module ${library})
  get_property(floor GLOBAL PROPERTY BUCKENS_FLOOR_${module})
  get_property(modules GLOBAL PROPERTY BUCKENS_MODULES)
  foreach(other IN LISTS modules)
    get_property(other_floor GLOBAL PROPERTY BUCKENS_FLOOR_${other})
    get_target_property(kind buckens_${other} TYPE)
    if(other_floor LESS floor AND kind STREQUAL STATIC_LIBRARY)
      list(APPEND archives $<TARGET_FILE:buckens_${other}>)
    endif()
  endforeach()
  target_link_options(${name} PRIVATE LINKER:--whole-archive ${archives} LINKER:--no-whole-archive)
endfunction()
