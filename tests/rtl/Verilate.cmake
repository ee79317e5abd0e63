# SPDX-License-Identifier: Apache-2.0
# pharos_verilate(NAME INPUTS n DEPTH n FILTER_WIDTH n LOST_WIDTH n): a library with make_capture_device() of
# capture_device.hpp, made from the Verilog by Verilator. Generated code lives in the build tree only, without warnings.
execute_process(COMMAND ${PHAROS_VERILATOR} --getenv VERILATOR_ROOT OUTPUT_VARIABLE root OUTPUT_STRIP_TRAILING_WHITESPACE)
set(PHAROS_VERILATOR_INCLUDE ${root}/include)

add_library(pharos_verilated STATIC ${PHAROS_VERILATOR_INCLUDE}/verilated.cpp ${PHAROS_VERILATOR_INCLUDE}/verilated_threads.cpp)
target_include_directories(pharos_verilated SYSTEM PUBLIC ${PHAROS_VERILATOR_INCLUDE} ${PHAROS_VERILATOR_INCLUDE}/vltstd)
target_compile_options(pharos_verilated PRIVATE -w -O1)
set_target_properties(pharos_verilated PROPERTIES CXX_CLANG_TIDY "")
find_package(Threads REQUIRED)
target_link_libraries(pharos_verilated PUBLIC Threads::Threads)

function(pharos_verilate name)
  set(parameters INPUTS DEPTH FILTER_WIDTH LOST_WIDTH)
  cmake_parse_arguments(ARG "" "${parameters}" "" ${ARGN})
  set(prefix V${name})
  set(directory ${CMAKE_CURRENT_BINARY_DIR}/${name})
  set(archive ${directory}/${prefix}__ALL.a)
  set(overrides)
  set(definitions)
  foreach(parameter IN LISTS parameters)
    list(APPEND overrides -G${parameter}=${ARG_${parameter}})
    list(APPEND definitions PHAROS_RTL_${parameter}=${ARG_${parameter}}u)
  endforeach()
  add_custom_command(OUTPUT ${archive}
    COMMAND ${PHAROS_VERILATOR} --cc --Mdir ${directory} --prefix ${prefix} --top-module pharos_capture -Wall -O3 --x-assign fast
      ${overrides} ${PHAROS_RTL_SOURCES}
    COMMAND make --silent -C ${directory} -f ${prefix}.mk ${prefix}__ALL.a CXX=${CMAKE_CXX_COMPILER} LINK=${CMAKE_CXX_COMPILER}
      OPT_FAST=-O2 OPT_SLOW=-O1
    DEPENDS ${PHAROS_RTL_SOURCES} COMMENT "Verilating ${name}" VERBATIM)
  add_custom_target(${name}_generate DEPENDS ${archive})
  configure_file(verilated_device.cpp.in ${directory}_device.cpp @ONLY)
  set_source_files_properties(${directory}_device.cpp PROPERTIES OBJECT_DEPENDS ${archive})  # and the headers beside it
  add_library(${name} STATIC ${directory}_device.cpp)
  add_dependencies(${name} ${name}_generate)
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/tests PRIVATE ${directory})
  target_compile_definitions(${name} INTERFACE ${definitions})
  target_compile_options(${name} PRIVATE -w -O2)
  set_target_properties(${name} PROPERTIES CXX_CLANG_TIDY "" UNITY_BUILD OFF)  # OBJECT_DEPENDS is a file's
  target_link_libraries(${name} PUBLIC ${archive} pharos_verilated)
endfunction()

# pharos_verilate_module(NAME MODULE module DEVICE file SOURCES files... [FLAGS verilator's...]): a library of the Verilated module with
# what DEVICE makes of it.
function(pharos_verilate_module name)
  cmake_parse_arguments(ARG "" "MODULE;DEVICE" "SOURCES;FLAGS" ${ARGN})
  set(prefix V${name})
  set(directory ${CMAKE_CURRENT_BINARY_DIR}/${name})
  set(archive ${directory}/${prefix}__ALL.a)
  add_custom_command(OUTPUT ${archive}
    COMMAND ${PHAROS_VERILATOR} --cc --Mdir ${directory} --prefix ${prefix} --top-module ${ARG_MODULE} -Wall -O3 --x-assign fast
      ${ARG_FLAGS} ${ARG_SOURCES}
    COMMAND make --silent -C ${directory} -f ${prefix}.mk ${prefix}__ALL.a CXX=${CMAKE_CXX_COMPILER} LINK=${CMAKE_CXX_COMPILER}
      OPT_FAST=-O2 OPT_SLOW=-O1
    DEPENDS ${ARG_SOURCES} COMMENT "Verilating ${name}" VERBATIM)
  add_custom_target(${name}_generate DEPENDS ${archive})
  configure_file(${ARG_DEVICE} ${directory}_device.cpp @ONLY)
  set_source_files_properties(${directory}_device.cpp PROPERTIES OBJECT_DEPENDS ${archive})  # and the headers beside it
  add_library(${name} STATIC ${directory}_device.cpp)
  add_dependencies(${name} ${name}_generate)
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/tests PRIVATE ${directory})
  target_compile_options(${name} PRIVATE -w -O2)
  set_target_properties(${name} PROPERTIES CXX_CLANG_TIDY "" UNITY_BUILD OFF)  # OBJECT_DEPENDS is a file's
  target_link_libraries(${name} PUBLIC ${archive} pharos_verilated)
endfunction()
