# SPDX-License-Identifier: Apache-2.0
# Writes HEADER with the commit of SOURCE, by GIT; touched only where it changes, so nothing is compiled in vain.
cmake_minimum_required(VERSION 3.25)
set(commit "unknown")
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --short=12 HEAD OUTPUT_VARIABLE head
    OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    set(commit ${head})
    execute_process(COMMAND ${GIT} -C ${SOURCE} diff --quiet HEAD RESULT_VARIABLE changed ERROR_QUIET)
    if(changed)
      string(APPEND commit " with changes")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT
  "// SPDX-License-Identifier: Apache-2.0\n#pragma once\n\nnamespace pharos::tools::report {\ninline constexpr const char* kCommit = \"@commit@\";\n}  // namespace pharos::tools::report\n" @ONLY)
