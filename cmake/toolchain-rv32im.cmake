# SPDX-License-Identifier: Apache-2.0
# The soft core: RV32IM, no FPU, no operating system, picolibc. Debian packages: gcc-riscv64-unknown-elf,
# picolibc-riscv64-unknown-elf, libstdc++-arm-none-eabi-dev.
# Debian has no libstdc++ for this compiler. The headers of the ARM one (same GCC release) serve: the core uses only their
# header-only part. The library itself is absent, so linking goes through gcc: an exception, an allocation or a guarded
# static that slips into the core is an undefined reference.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR rv32im)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_C_COMPILER riscv64-unknown-elf-gcc)
set(CMAKE_CXX_COMPILER riscv64-unknown-elf-g++)
set(CMAKE_ASM_COMPILER ${CMAKE_C_COMPILER})

set(PHAROS_NEWLIB_CXX /usr/include/newlib/c++/12.2.1)
if(NOT EXISTS ${PHAROS_NEWLIB_CXX}/array)
  message(FATAL_ERROR "${PHAROS_NEWLIB_CXX} has no C++ headers: apt-get install libstdc++-arm-none-eabi-dev")
endif()

set(rv32im_flags "-march=rv32im -mabi=ilp32 --specs=picolibc.specs -ffunction-sections -fdata-sections -fstack-usage")
set(CMAKE_ASM_FLAGS_INIT "-march=rv32im -mabi=ilp32")
set(CMAKE_CXX_FLAGS_INIT
  "${rv32im_flags} -nostdinc++ -isystem ${PHAROS_NEWLIB_CXX} -isystem ${PHAROS_NEWLIB_CXX}/arm-none-eabi \
-fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-use-cxa-atexit")
set(CMAKE_CXX_LINK_EXECUTABLE
  "${CMAKE_C_COMPILER} <FLAGS> <CMAKE_CXX_LINK_FLAGS> <LINK_FLAGS> <OBJECTS> -o <TARGET> <LINK_LIBRARIES>")
