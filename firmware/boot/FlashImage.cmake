# SPDX-License-Identifier: Apache-2.0
# pharos_flash_image(PROGRAM BOARD board NAME name [VERSION x.y.z]): bin/PROGRAM.image, the input of `pharos flash`.
function(pharos_flash_image program)
  cmake_parse_arguments(ARG "" "BOARD;NAME;VERSION" "" ${ARGN})
  if(NOT ARG_VERSION)
    set(ARG_VERSION ${PROJECT_VERSION})
  endif()
  find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)
  set(maker ${PROJECT_SOURCE_DIR}/firmware/boot/make_image.py)
  set_property(TARGET ${program} APPEND PROPERTY LINK_DEPENDS ${maker})
  add_custom_command(TARGET ${program} POST_BUILD
    COMMAND ${Python3_EXECUTABLE} -B ${maker} --board ${ARG_BOARD} --name ${ARG_NAME} --version ${ARG_VERSION}
      $<TARGET_FILE:${program}> ${CMAKE_BINARY_DIR}/bin/${program}.image VERBATIM)
endfunction()
