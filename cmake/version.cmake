# Copyright (c) 2026, the coarse_map_nav authors
# SPDX-License-Identifier: BSD-3-Clause
# Writes the header OUTPUT with the version of what is built: PACKAGE_VERSION and, in a git checkout, the
# commit and whether files of it have changed since. Runs at every build, so that it never is the commit of
# an older configuring; touches the header only when that says something else.
# Arguments: SOURCE, OUTPUT, PACKAGE_VERSION, GIT (empty: none).
set(version "${PACKAGE_VERSION}")
if(GIT)
  # Only of a checkout of this package itself: it may lie unpacked in another project's.
  execute_process(COMMAND "${GIT}" rev-parse --show-prefix
    WORKING_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE prefix RESULT_VARIABLE fault ERROR_QUIET
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT fault AND prefix STREQUAL "")
    execute_process(COMMAND "${GIT}" describe --always --dirty --tags --abbrev=10
      WORKING_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE commit RESULT_VARIABLE fault ERROR_QUIET
      OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(NOT fault AND NOT commit STREQUAL "")
      string(APPEND version ", git ${commit}")
    endif()
  endif()
endif()
set(text "// Made by cmake/version.cmake.\n#define CMN_VERSION \"${version}\"\n")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" before)
endif()
if(NOT text STREQUAL "${before}")
  file(WRITE "${OUTPUT}" "${text}")
endif()
