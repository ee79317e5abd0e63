# SPDX-License-Identifier: Apache-2.0
# pharos_flash_image(PROGRAM BOARD board NAME name [VERSION x.y.z]): bin/PROGRAM.image, the input of `pharos flash`.
# PHAROS_SIGNING_KEY: the key that images are signed with and loaders accept: a private key (PEM), or the public one as 64
# hexadecimal digits, where images are not signed by the build.
set(PHAROS_TEST_KEY ${PROJECT_SOURCE_DIR}/firmware/boot/test_key/test_only_private_key.pem)
set(PHAROS_SIGNING_KEY ${PHAROS_TEST_KEY} CACHE FILEPATH "Key of the target's images; the default is public and for tests only")
function(pharos_flash_image program)
  cmake_parse_arguments(ARG "" "BOARD;NAME;VERSION" "" ${ARGN})
  if(NOT ARG_VERSION)
    set(ARG_VERSION ${PROJECT_VERSION})
  endif()
  find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)
  set(maker ${PROJECT_SOURCE_DIR}/firmware/boot/make_image.py)
  set_property(TARGET ${program} APPEND PROPERTY LINK_DEPENDS ${maker})
  set_property(TARGET ${program} APPEND PROPERTY LINK_DEPENDS ${PHAROS_SIGNING_KEY})
  add_custom_command(TARGET ${program} POST_BUILD
    COMMAND ${Python3_EXECUTABLE} -B ${maker} --key-if-private ${PHAROS_SIGNING_KEY} --board ${ARG_BOARD} --name ${ARG_NAME} --version ${ARG_VERSION}
      $<TARGET_FILE:${program}> ${CMAKE_BINARY_DIR}/bin/${program}.image VERBATIM)
endfunction()
