# SPDX-License-Identifier: Apache-2.0
# Warnings, sanitizers, precompiled headers and the kinds of library that Pharos builds.

add_library(pharos_warnings INTERFACE)
target_compile_options(pharos_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Werror -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
  -Woverloaded-virtual -Wcast-align -Wunused -Wnull-dereference -Wdouble-promotion -Wformat=2)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(pharos_warnings INTERFACE
    -Wduplicated-cond -Wlogical-op
    # False positives of GCC 12 in inlined code of Eigen and libstdc++.
    -Wno-null-dereference -Wno-array-bounds -Wno-stringop-overflow -Wno-maybe-uninitialized -Wno-restrict
    # In a unity build every source is included, so that an unnamed namespace looks as if it were in a header.
    $<$<BOOL:${CMAKE_UNITY_BUILD}>:-Wno-subobject-linkage>)
endif()

# GCC collects its garbage for the first time at 512 MB. Its default, an eighth of the memory and at most 128 MB, costs a
# tenth of the time of a file that uses Eigen, CLI11 or GoogleTest: 113 s became 103 s over 28 files.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(--param=ggc-min-heapsize=512000)
endif()

# The release build of the host: stack protector and fortified functions. The soft core has neither library.
if(NOT PHAROS_SANITIZE AND NOT CMAKE_SYSTEM_PROCESSOR STREQUAL "rv32im")
  add_compile_options($<$<CONFIG:Release>:-fstack-protector-strong> $<$<CONFIG:Release>:-U_FORTIFY_SOURCE>
    $<$<CONFIG:Release>:-D_FORTIFY_SOURCE=2>)
endif()

# Code that runs seldom or for a short time: tests, options, files, messages. GCC 12 compiles commands with -Og in 0.67 of
# the time of -O1, tests in 0.83, and rooms of the host in 0.63 of the time of -O3. Results do not change.
set(PHAROS_COLD_OPTIONS $<$<CONFIG:Release>:-Og>)

# The build type of the sanitizer presets: assertions on, enough optimisation for Eigen, line numbers in reports.
set(CMAKE_CXX_FLAGS_SANITIZE "-O1 -g1")
if(PHAROS_SANITIZE)
  add_compile_options(-fsanitize=${PHAROS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${PHAROS_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12's check of dynamic types evaluates `(object->*method)()` from a variable that one branch never sets: it
    # reports, or crashes in, every LCM handler that is a member function. Clang keeps the check (preset fuzz).
    add_compile_options(-fno-sanitize=vptr)
    # A tenth of the compile time of these trees. The address sanitizer reports a null pointer that is used.
    add_compile_options(-fno-sanitize=null)
  endif()
endif()
if(PHAROS_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# ccache is used if it is installed, with the options that precompiled headers need. The build does not depend on it.
option(PHAROS_CCACHE "Use ccache where it is installed" ON)
find_program(PHAROS_CCACHE_PROGRAM ccache)
set(PHAROS_GIVEN_LAUNCHER "${CMAKE_CXX_COMPILER_LAUNCHER}")
if(PHAROS_CCACHE AND PHAROS_CCACHE_PROGRAM AND NOT PHAROS_GIVEN_LAUNCHER AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU"
    AND NOT CMAKE_CXX_COMPILER MATCHES "ccache")
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${PHAROS_CCACHE_PROGRAM})
  add_compile_options(-fpch-preprocess)
endif()

# Parsing Eigen or GoogleTest is two thirds of the cost of compiling a small file, so these headers are precompiled once
# per set of flags. Not with a launcher given by the user or with clang-tidy, which do not understand such command lines.
# These builds therefore detect missing includes, and `check.core_headers` those of the core's headers.
if(PHAROS_GIVEN_LAUNCHER OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(PHAROS_PRECOMPILE OFF)
else()
  set(PHAROS_PRECOMPILE ON)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled.cpp CONTENT "")
endif()

# pharos_headers(KIND HEADERS headers... LIBS libraries... OPTIONS options...): precompiled headers for all targets of one
# KIND. These targets must have the same options and no others that affect code: a header precompiled with -O3 makes its
# users compile with -O3.
function(pharos_headers kind)
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBS;OPTIONS" ${ARGN})
  if(PHAROS_PRECOMPILE)
    add_library(pharos_${kind}_headers OBJECT EXCLUDE_FROM_ALL ${CMAKE_BINARY_DIR}/precompiled.cpp)
    target_compile_options(pharos_${kind}_headers PRIVATE ${ARG_OPTIONS})
    target_link_libraries(pharos_${kind}_headers PRIVATE ${ARG_LIBS} pharos_warnings)
    target_precompile_headers(pharos_${kind}_headers PRIVATE ${ARG_HEADERS})
  endif()
endfunction()

# pharos_reads_headers(TARGET KIND): TARGET uses the precompiled headers of KIND.
function(pharos_reads_headers target kind)
  if(PHAROS_PRECOMPILE)
    set_target_properties(${target} PROPERTIES PRECOMPILE_HEADERS_REUSE_FROM pharos_${kind}_headers)
  endif()
endfunction()

# pharos_core_library(NAME SOURCES...): a room of the portable core. No exceptions, no RTTI; the same floating-point
# results on every machine (no fused multiply-add that is not in the source). For the soft core there is also NAME_12, the
# same sources for a board of 12 inputs (base/capacity.hpp), built if an image links it; an image must not mix both.
# VECTORS after NAME is for loops over images: square roots do not set errno and comparisons do not trap, so that the
# compiler can vectorise them. Results do not change.
set(PHAROS_CORE_OPTIONS -fno-exceptions -fno-rtti -ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "rv32im")
  # GCC refuses a precompiled header unless the cost of a branch, which it derives from -O, is given. 1 is that of -Os, 3
  # that of -O2.
  set(PHAROS_12_OPTIONS ${PHAROS_CORE_OPTIONS} -O2 -mbranch-cost=3)
  set(PHAROS_12_DEFINITIONS PHAROS_MAX_SENSORS=12 PHAROS_HOT_ON_CHIP)
  list(APPEND PHAROS_CORE_OPTIONS -mbranch-cost=1)
endif()
set(PHAROS_VECTORS_OPTIONS ${PHAROS_CORE_OPTIONS} -fno-math-errno -fno-trapping-math)
pharos_headers(core HEADERS <Eigen/Dense> LIBS Eigen3::Eigen OPTIONS ${PHAROS_CORE_OPTIONS})
pharos_headers(vectors HEADERS <Eigen/Dense> LIBS Eigen3::Eigen OPTIONS ${PHAROS_VECTORS_OPTIONS})
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "rv32im")
  pharos_headers(core_12 HEADERS <Eigen/Dense> LIBS Eigen3::Eigen OPTIONS ${PHAROS_12_OPTIONS})
  if(PHAROS_PRECOMPILE)
    target_compile_definitions(pharos_core_12_headers PRIVATE ${PHAROS_12_DEFINITIONS})
  endif()
endif()
function(pharos_core_library name)
  cmake_parse_arguments(ARG "VECTORS" "" "" ${ARGN})
  set(kind core)
  set(options ${PHAROS_CORE_OPTIONS})
  if(ARG_VECTORS)
    set(kind vectors)
    set(options ${PHAROS_VECTORS_OPTIONS})
  endif()
  add_library(${name} STATIC ${ARG_UNPARSED_ARGUMENTS})
  target_compile_options(${name} PRIVATE ${options})
  pharos_reads_headers(${name} ${kind})
  set(libraries ${name})
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL "rv32im")
    add_library(${name}_12 STATIC EXCLUDE_FROM_ALL ${ARG_UNPARSED_ARGUMENTS})
    target_compile_definitions(${name}_12 PUBLIC ${PHAROS_12_DEFINITIONS})
    target_compile_options(${name}_12 PRIVATE ${PHAROS_12_OPTIONS})  # its code is in external memory: size matters less
    pharos_reads_headers(${name}_12 core_12)
    list(APPEND libraries ${name}_12)
    # This one is in no image, but in programs that test the core: compiled as fast as on the host.
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON)
  endif()
  foreach(library IN LISTS libraries)
    target_include_directories(${library} PUBLIC ${PROJECT_SOURCE_DIR}/common)
    target_link_libraries(${library} PUBLIC Eigen3::Eigen PRIVATE pharos_warnings)
  endforeach()
  if(PHAROS_TEST_ROOMS)  # a tree of some tests builds what they link
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
  set_property(GLOBAL APPEND PROPERTY PHAROS_CORE_LIBRARIES ${name})
endfunction()

# pharos_module(NAME SOURCES...): a plug-in for code whose libraries would slow down every start of a program (README.md:
# which and why), loaded on demand (host/support/module_function.hpp). It is beside the programs in the build tree and is
# installed in lib/pharos.
function(pharos_module name)
  add_library(${name} MODULE ${ARGN})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE pharos_warnings)
  set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  install(FILES $<TARGET_FILE:${name}> DESTINATION lib/pharos)
endfunction()

# pharos_host_library(NAME [COLD] SOURCES...): a room of the host or of the tools. COLD is for code that reads, writes and
# calls: optimising it takes longer than running it, and what computes is in the rooms that it calls.
set(PHAROS_HOST_HEADERS <Eigen/Dense> <chrono> <functional> <map> <optional> <sstream> <string> <unordered_map> <vector>)
pharos_headers(host HEADERS ${PHAROS_HOST_HEADERS} LIBS Eigen3::Eigen)
pharos_headers(cold HEADERS ${PHAROS_HOST_HEADERS} LIBS Eigen3::Eigen OPTIONS ${PHAROS_COLD_OPTIONS})
# pharos_cold(TARGET KIND): the options of cold code, and the precompiled headers of KIND (cold, command or test).
function(pharos_cold target kind)
  target_compile_options(${target} PRIVATE ${PHAROS_COLD_OPTIONS})
  pharos_reads_headers(${target} ${kind})
endfunction()
function(pharos_host_library name)
  cmake_parse_arguments(ARG "COLD" "" "" ${ARGN})
  add_library(${name} STATIC ${ARG_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE pharos_warnings)
  if(ARG_COLD)
    pharos_cold(${name} cold)
  else()
    pharos_reads_headers(${name} host)
  endif()
endfunction()

# pharos_command_library(NAME SOURCES...): a subcommand's options and the sequence of its steps. Cold.
if(PHAROS_BUILD_HOST)
  pharos_headers(command HEADERS <CLI/CLI.hpp> ${PHAROS_HOST_HEADERS} LIBS Eigen3::Eigen OPTIONS ${PHAROS_COLD_OPTIONS})
endif()
function(pharos_command_library name)
  pharos_host_library(${name} COLD ${ARGN})
  pharos_reads_headers(${name} command)
endfunction()

# pharos_installed_program(TARGET): position independent; all symbols are resolved before main and read-only afterwards.
function(pharos_installed_program target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_options(${target} PRIVATE -pie -Wl,-z,relro,-z,now,-z,noexecstack)
endfunction()
