# Run by cpack on the installed trees of the packages before they are packed (CPACK_PRE_BUILD_SCRIPTS): what
# Debian's policy wants in each, and the Python module where Debian's interpreter looks below /usr.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # obeys SOURCE_DATE_EPOCH
file(READ "${CPACK_BUCKENS_SOURCE_DIR}/NOTICE" notice)
string(REGEX REPLACE "\n\n" "\n.\n" notice "${notice}")
string(STRIP "${notice}" notice)
string(REPLACE "\n" "\n " notice "${notice}")
# A changelog names a release; before the first one that is the version.
set(changelog
    "${CPACK_PACKAGE_NAME} (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium

  * What is new stands in changelog.gz.

 -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${date}
")
set(copyright
    "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Buckens
Comment:
 ${notice}

Files: *
Copyright: 2026 the Buckens authors
License: Apache-2.0
 On Debian systems the text of the licence is in /usr/share/common-licenses/Apache-2.0.
")

function(compress file)
  execute_process(COMMAND gzip -9nf "${file}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  set(root "${CPACK_TEMPORARY_DIRECTORY}/${component}/usr")
  string(TOUPPER "${component}" upper)
  set(package "${CPACK_DEBIAN_${upper}_PACKAGE_NAME}")
  set(documents "${root}/share/doc/${package}")
  file(WRITE "${documents}/copyright" "${copyright}")
  file(WRITE "${documents}/changelog.Debian" "${changelog}")
  file(COPY_FILE "${CPACK_BUCKENS_SOURCE_DIR}/CHANGELOG.md" "${documents}/changelog")
  # The copyright file says the same.
  file(REMOVE "${documents}/LICENSE" "${documents}/NOTICE")
  file(CHMOD_RECURSE "${documents}"
       FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ
       DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  compress("${documents}/changelog")
  compress("${documents}/changelog.Debian")
  file(GLOB pages "${root}/share/man/man1/*.1")
  foreach(page IN LISTS pages)
    compress("${page}")
  endforeach()
  file(GLOB installed "${root}/lib/python3.*/*-packages/buckens")
  foreach(module IN LISTS installed)
    file(MAKE_DIRECTORY "${root}/lib/python3/dist-packages")
    file(RENAME "${module}" "${root}/lib/python3/dist-packages/buckens")
    cmake_path(GET module PARENT_PATH folder)
    cmake_path(GET folder PARENT_PATH folder)
    file(REMOVE_RECURSE "${folder}")
  endforeach()
endforeach()
