# SPDX-License-Identifier: Apache-2.0
include(GoogleTest)
find_package(GTest 1.12 REQUIRED)

set(PHAROS_TEST_PREFIX "" CACHE STRING "Put before every test's name, so that the tests of two build trees can run as one")
set(PHAROS_FUZZ_SECONDS 180 CACHE STRING "How long each libFuzzer target runs in `tools/test --full`")

# A test's own code runs once and is compiled each time: optimising it fully costs more than it saves. What is tested
# keeps its flags.
set(PHAROS_TEST_OPTIONS $<$<CONFIG:Release>:-O1>)
pharos_headers(test HEADERS <gmock/gmock.h> <gtest/gtest.h> <Eigen/Geometry>
  LIBS Eigen3::Eigen GTest::gtest GTest::gmock OPTIONS ${PHAROS_TEST_OPTIONS})

# pharos_test(NAME [LABEL label] SOURCES files... LIBS libraries...): one GoogleTest program, each case known to ctest.
# LABEL is unit (default), property, integration, fault, data or long; `long` runs only in `tools/test --full`, and there
# in the release tree alone.
function(pharos_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;LIBS" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  if(PHAROS_SANITIZE)
    # Five times as slow, and a campaign's thousands of problems take the same lines as the ordinary tests' few.
    if(ARG_LABEL STREQUAL "long")
      return()
    endif()
    math(EXPR ARG_TIMEOUT "5 * ${ARG_TIMEOUT}")
    set(environment ENVIRONMENT "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/leaks.supp:print_suppressions=0")
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} pharos_warnings GTest::gtest GTest::gmock GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR})
  target_compile_options(${name} PRIVATE ${PHAROS_TEST_OPTIONS})
  pharos_reads_headers(${name} test)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
  if(PHAROS_FUZZ)
    return()  # that tree builds and runs its fuzzers alone: a test that is not built would be one that fails
  endif()
  gtest_discover_tests(${name} TEST_PREFIX "${PHAROS_TEST_PREFIX}" DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT} ${environment})
  if(ARG_LABEL STREQUAL "data")
    set_property(GLOBAL APPEND PROPERTY PHAROS_DATA_TESTS ${name})
  endif()
endfunction()

# pharos_fuzz(NAME SOURCE file LIBS libraries...): always an ordinary test that replays tests/fuzz/corpus/NAME through
# LLVMFuzzerTestOneInput. When PHAROS_FUZZ is on, NAME is a libFuzzer program (all of them: target `fuzzers`), and a
# test with the label long lets it search for PHAROS_FUZZ_SECONDS from that corpus.
function(pharos_fuzz name)
  cmake_parse_arguments(ARG "" "SOURCE" "LIBS" ${ARGN})
  set(corpus ${PROJECT_SOURCE_DIR}/tests/fuzz/corpus/${name})
  add_executable(${name} ${ARG_SOURCE})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} pharos_warnings)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
  set(replay ${PHAROS_TEST_PREFIX}replay.${name})
  if(PHAROS_FUZZ)
    target_link_options(${name} PRIVATE -fsanitize=fuzzer)
    if(NOT TARGET fuzzers)
      add_custom_target(fuzzers)
    endif()
    add_dependencies(fuzzers ${name})
    add_test(NAME ${replay} COMMAND ${name} -runs=0 ${corpus})
    # New inputs go to the build tree; a crash leaves its input there too.
    set(found ${CMAKE_BINARY_DIR}/fuzz/${name})
    file(MAKE_DIRECTORY ${found})
    math(EXPR search_timeout "${PHAROS_FUZZ_SECONDS} + 120")
    add_test(NAME ${PHAROS_TEST_PREFIX}search.${name}
      COMMAND ${name} -max_total_time=${PHAROS_FUZZ_SECONDS} -artifact_prefix=${found}/ -print_final_stats=1 ${found} ${corpus})
    set_tests_properties(${PHAROS_TEST_PREFIX}search.${name} PROPERTIES LABELS long TIMEOUT ${search_timeout})
  else()
    target_sources(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/fuzz/replay_main.cpp)
    add_test(NAME ${replay} COMMAND ${name} ${corpus})
  endif()
  set_tests_properties(${replay} PROPERTIES LABELS fuzz TIMEOUT 120)
endfunction()
