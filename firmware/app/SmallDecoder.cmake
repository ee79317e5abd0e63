# SPDX-License-Identifier: Apache-2.0
# The build `decoder` for on-chip memory: the core's sources and not its libraries, made as one program for size alone
# (link-time optimisation, shared function prologues), since code, data, stack and loader have 36 KiB.
set(core ${PROJECT_SOURCE_DIR}/common/pharos)
set(sources commands.cpp program.cpp main_decoder.cpp)
list(TRANSFORM sources PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
foreach(part decoder edge_pairing event_order flash_grouping ootx_frames rotor_clock slot_search slot_tracker sweep_collector
    time_base)
  list(APPEND sources ${core}/lighthouse/${part}.cpp)
endforeach()
foreach(part cobs command_message counters_message crc32 frame_decoder frame_encoder hello_message ootx_message
    raw_edges_message sweep_message)
  list(APPEND sources ${core}/wire/${part}.cpp)
endforeach()
list(APPEND sources ${core}/report/convert.cpp ${core}/report/reporter.cpp)

add_library(pharos_small_decoder OBJECT ${sources})
target_include_directories(pharos_small_decoder PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/common)
target_link_libraries(pharos_small_decoder PRIVATE Eigen3::Eigen pharos_warnings)
target_compile_options(pharos_small_decoder PRIVATE -Os -flto -msave-restore -mtune=size -ffp-contract=off)
target_compile_definitions(pharos_small_decoder PRIVATE ${PHAROS_VERSION_DEFINITIONS})
