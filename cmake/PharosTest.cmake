# SPDX-License-Identifier: Apache-2.0
find_package(GTest 1.12 REQUIRED)
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)
add_custom_target(long_tests)

set(PHAROS_TEST_PREFIX "" CACHE STRING "Put before every test's name, so that the tests of two build trees can run as one")
set(PHAROS_TEST_ROOMS "" CACHE STRING "Folders of tests/unit to build; empty: all")
set(PHAROS_FUZZ_SECONDS 180 CACHE STRING "How long each libFuzzer target runs in `tools/test --full`")

# Test code runs once per build, so that full optimisation would cost more time than it saves. The tested code keeps its
# flags.
pharos_headers(test HEADERS <gmock/gmock.h> <gtest/gtest.h> <Eigen/Geometry>
  LIBS Eigen3::Eigen GTest::gtest GTest::gmock OPTIONS ${PHAROS_COLD_OPTIONS})

# pharos_test_program(NAME KIND): what a program, or a library, that tests run is compiled with: cold, and with the
# precompiled headers of KIND: cold, command (CLI11) or test (GoogleTest). It is in the folder of the tests.
function(pharos_test_program name kind)
  pharos_cold(${name} ${kind})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
endfunction()

# pharos_test(NAME [LABEL label] [TIMEOUT seconds] SOURCES files... [PROPERTY files...] [FAULT files...] LIBS libraries...):
# one GoogleTest program per room; each suite is a ctest entry NAME.Suite (discover_tests.py). LABEL is that of SOURCES:
# unit (default), property, integration, fault, data or long; PROPERTY and FAULT are further files with those labels.
# `long` is built by the target long_tests and runs only in `tools/test --full`, in the release tree only.
function(pharos_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;PROPERTY;FAULT;LIBS" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  set(environment)
  if(PHAROS_SANITIZE)
    # Sanitizers are five times slower. Campaigns are left out: their thousands of problems execute the same lines as the
    # few of the ordinary tests.
    if(ARG_LABEL STREQUAL "long")
      return()
    endif()
    math(EXPR ARG_TIMEOUT "5 * ${ARG_TIMEOUT}")
    set(leaks "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/leaks.supp:print_suppressions=0")
    set(environment --property "ENVIRONMENT=${leaks}")
  endif()
  add_executable(${name} ${ARG_SOURCES} ${ARG_PROPERTY} ${ARG_FAULT})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} pharos_warnings GTest::gtest GTest::gmock GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR})
  pharos_test_program(${name} test)
  set_target_properties(${name} PROPERTIES LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/discover_tests.py)
  if(ARG_LABEL STREQUAL "long")
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
    add_dependencies(long_tests ${name})
  endif()
  if(PHAROS_FUZZ)
    return()  # that tree builds and runs fuzzers only; a registered test that is not built would fail
  endif()
  set(labels)
  foreach(label PROPERTY FAULT)
    foreach(file IN LISTS ARG_${label})
      cmake_path(ABSOLUTE_PATH file OUTPUT_VARIABLE path)
      cmake_path(RELATIVE_PATH path BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
      string(TOLOWER ${label} lower)
      list(APPEND labels --file-label ${path}=${lower})
    endforeach()
  endforeach()
  set(entries ${CMAKE_CURRENT_BINARY_DIR}/${name}_tests.cmake)
  set(prefixed ${PHAROS_TEST_PREFIX}${name})
  add_custom_command(TARGET ${name} POST_BUILD BYPRODUCTS ${entries}
    COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/cmake/discover_tests.py $<TARGET_FILE:${name}> ${entries}
      --name ${prefixed} --root ${PROJECT_SOURCE_DIR} --label ${ARG_LABEL} ${labels} --property TIMEOUT=${ARG_TIMEOUT}
      ${environment}
    COMMENT "" VERBATIM)
  # A program that was not built counts as a failed test.
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake @ONLY CONTENT [[
if(EXISTS "@entries@")
  include("@entries@")
else()
  add_test(@prefixed@.NOT_BUILT @name@)
  set_tests_properties(@prefixed@.NOT_BUILT PROPERTIES LABELS @ARG_LABEL@)
endif()
]])
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake)
  if(ARG_LABEL STREQUAL "data")
    set_property(GLOBAL APPEND PROPERTY PHAROS_DATA_TESTS ${name})
  endif()
endfunction()

# pharos_fuzz(NAME SOURCE file LIBS libraries...): an ordinary test that replays tests/fuzz/corpus/NAME through
# LLVMFuzzerTestOneInput; all targets are in one program, fuzz_replay. If PHAROS_FUZZ is on, NAME is a libFuzzer program
# (all of them: target `fuzzers`), and a test with the label long searches from that corpus for PHAROS_FUZZ_SECONDS.
function(pharos_fuzz name)
  cmake_parse_arguments(ARG "" "SOURCE" "LIBS" ${ARGN})
  set(corpus ${PROJECT_SOURCE_DIR}/tests/fuzz/corpus/${name})
  set(replay ${PHAROS_TEST_PREFIX}replay.${name})
  if(PHAROS_FUZZ)
    add_executable(${name} ${ARG_SOURCE})
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
    target_link_options(${name} PRIVATE -fsanitize=fuzzer)
    if(NOT TARGET fuzzers)
      add_custom_target(fuzzers)
    endif()
    add_dependencies(fuzzers ${name})
    add_test(NAME ${replay} COMMAND ${name} -runs=0 ${corpus})
    # New inputs and inputs that crash are stored in the build tree.
    set(found ${CMAKE_BINARY_DIR}/fuzz/${name})
    file(MAKE_DIRECTORY ${found})
    math(EXPR search_timeout "${PHAROS_FUZZ_SECONDS} + 120")
    add_test(NAME ${PHAROS_TEST_PREFIX}search.${name}
      COMMAND ${name} -max_total_time=${PHAROS_FUZZ_SECONDS} -artifact_prefix=${found}/ -print_final_stats=1 ${found} ${corpus})
    set_tests_properties(${PHAROS_TEST_PREFIX}search.${name} PROPERTIES LABELS long TIMEOUT ${search_timeout})
  else()
    # Object libraries with differently named entry functions, so that one program can link all of them.
    add_library(${name} OBJECT ${ARG_SOURCE})
    target_compile_definitions(${name} PRIVATE LLVMFuzzerTestOneInput=${name}_one_input)
    pharos_test_program(${name} cold)
    set_property(GLOBAL APPEND PROPERTY PHAROS_FUZZ_TARGETS ${name})
    add_test(NAME ${replay} COMMAND fuzz_replay ${name} ${corpus})
  endif()
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} pharos_warnings)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR})
  set_tests_properties(${replay} PROPERTIES LABELS fuzz TIMEOUT 120)
endfunction()

# pharos_fuzz_replay(): the program that replays the corpus of every target declared so far.
function(pharos_fuzz_replay)
  if(PHAROS_FUZZ)
    return()
  endif()
  get_property(targets GLOBAL PROPERTY PHAROS_FUZZ_TARGETS)
  list(TRANSFORM targets REPLACE "(.+)" "PHAROS_FUZZ_TARGET(\\1)\n" OUTPUT_VARIABLE lines)
  list(JOIN lines "" lines)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/fuzz_targets.inc CONTENT "${lines}")
  add_executable(fuzz_replay ${PROJECT_SOURCE_DIR}/tests/fuzz/replay_main.cpp)
  target_include_directories(fuzz_replay PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
  target_link_libraries(fuzz_replay PRIVATE ${targets} pharos_warnings)
  set_target_properties(fuzz_replay PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
endfunction()
