# SPDX-License-Identifier: Apache-2.0
# Programs for the soft core, in the tree of the preset rv32im.
#
# pharos_firmware_image(NAME BOARD board LAYOUT chip|external STACK bytes [CHIP_BYTES bytes] SOURCES files… LIBS libraries…)
#   [LONG]
#   -> bin/NAME.elf, NAME.bin (its bytes) and NAME.map, part of the target firmware_images. Layouts are firmware/board/<board>/memory_<layout>.ld.
#   LONG: an image that only tests with the label long run, part of firmware_long_images instead.
#   CHIP_BYTES: more memory for variables than the board has, for test programs under QEMU.
#   The handling of faults is a library: pharos_<board>_test reports the fault and ends the emulator.
#
# A test program: pharos_firmware_image(my_test BOARD qemu_virt LAYOUT external STACK 65536 CHIP_BYTES 1048576
#   SOURCES my_test.cpp LIBS pharos_qemu_virt_test pharos_wire), run by tests/firmware/run_in_qemu.sh.
function(pharos_firmware_image name)
  cmake_parse_arguments(ARG "LONG" "BOARD;LAYOUT;STACK;CHIP_BYTES" "SOURCES;LIBS" ${ARGN})
  set(boards ${PROJECT_SOURCE_DIR}/firmware/board)
  set(script ${boards}/${ARG_BOARD}/memory_${ARG_LAYOUT}.ld)
  set(map ${CMAKE_BINARY_DIR}/bin/${name}.map)
  add_executable(${name} ${ARG_SOURCES} $<TARGET_OBJECTS:pharos_rv32_start>)
  set_target_properties(${name} PROPERTIES SUFFIX .elf LINK_DEPENDS "${script};${boards}/rv32/sections.ld")
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} pharos_warnings -lm)
  target_compile_options(${name} PRIVATE -ffp-contract=off)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_options(${name} PRIVATE -nostartfiles -T ${script} -L ${boards}/rv32 -Wl,-Map=${map}
    -Wl,--defsym=__stack_size=${ARG_STACK} -Wl,--no-warn-rwx-segments)
  if(ARG_CHIP_BYTES)
    target_link_options(${name} PRIVATE -Wl,--defsym=__chip_bytes=${ARG_CHIP_BYTES})
  endif()
  if(ARG_LONG)
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
    add_dependencies(firmware_long_images ${name})
  else()
    add_dependencies(firmware_images ${name})
  endif()
  add_custom_command(TARGET ${name} POST_BUILD
    COMMAND ${CMAKE_OBJCOPY} -O binary $<TARGET_FILE:${name}> ${CMAKE_BINARY_DIR}/bin/${name}.bin VERBATIM)
endfunction()

# pharos_firmware_tree(): in the host's tree, the target `firmware` builds every image into <build>/firmware/bin. Sets
# PHAROS_FIRMWARE_SKIPPED to the reason if it cannot.
function(pharos_firmware_tree)
  include(ExternalProject)
  find_program(PHAROS_RV32_COMPILER riscv64-unknown-elf-gcc)
  set(skipped "")
  if(NOT PHAROS_RV32_COMPILER)
    set(skipped "riscv64-unknown-elf-gcc is not installed (tools/install-dependencies test)")
  elseif(NOT EXISTS /usr/lib/picolibc/riscv64-unknown-elf)
    set(skipped "picolibc-riscv64-unknown-elf is not installed (tools/install-dependencies test)")
  elseif(NOT EXISTS /usr/include/newlib/c++/12.2.1/array)
    set(skipped "libstdc++-arm-none-eabi-dev is not installed (tools/install-dependencies test)")
  endif()
  set(PHAROS_FIRMWARE_SKIPPED "${skipped}" PARENT_SCOPE)
  if(skipped)
    message(STATUS "firmware is left out: ${skipped}")
    return()
  endif()
  set(key "")
  if(PHAROS_SIGNING_KEY)
    set(key -DPHAROS_SIGNING_KEY=${PHAROS_SIGNING_KEY})
  endif()
  ExternalProject_Add(firmware
    PREFIX ${CMAKE_BINARY_DIR}/firmware-steps
    SOURCE_DIR ${PROJECT_SOURCE_DIR}
    BINARY_DIR ${CMAKE_BINARY_DIR}/firmware
    CONFIGURE_COMMAND ${CMAKE_COMMAND} -S <SOURCE_DIR> -B <BINARY_DIR> --preset rv32im
      -DCMAKE_CXX_COMPILER_LAUNCHER=${PHAROS_GIVEN_LAUNCHER} ${key}
    BUILD_COMMAND ${CMAKE_COMMAND} --build <BINARY_DIR> --target firmware_images
    BUILD_ALWAYS ON
    INSTALL_COMMAND ""
    USES_TERMINAL_BUILD ON)
  # Without the test programs: only the decoder for the emulator, for tools/demo; what is installed, for tools/package;
  # the images of long tests (dependency of the target long_tests).
  foreach(part decoder installed long_images)
    set(target firmware_${part})
    if(part STREQUAL "decoder")
      set(target decoder.qemu_virt)
    endif()
    add_custom_target(firmware_${part}
      COMMAND ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B ${CMAKE_BINARY_DIR}/firmware --preset rv32im
        -DCMAKE_CXX_COMPILER_LAUNCHER=${PHAROS_GIVEN_LAUNCHER} ${key}
      COMMAND ${CMAKE_COMMAND} --build ${CMAKE_BINARY_DIR}/firmware --target ${target}
      USES_TERMINAL VERBATIM)
  endforeach()
endfunction()
