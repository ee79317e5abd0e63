# SPDX-License-Identifier: Apache-2.0
# The build `decoder` for on-chip memory: the core's sources and not its libraries, compiled as one program for size
# (link-time optimisation, shared function prologues), since code, data, stack and loader have 36 KiB; the files that
# process every edge, for speed. pharos_small_decoder: for 12 inputs; pharos_small_decoder_32: for the maximum.
set(core ${PROJECT_SOURCE_DIR}/common/pharos)
set(sources commands.cpp program.cpp main_decoder.cpp)
list(TRANSFORM sources PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
foreach(part edge_pairing flash_grouping light_decoder ootx_frames rotor_clock slot_search slot_tracker sorted_decoder
    sweep_collector time_base)
  list(APPEND sources ${core}/lighthouse/${part}.cpp)
endforeach()
foreach(part cobs command_message counters_message crc32 frame_decoder frame_encoder hello_message ootx_message
    raw_edges_message sweep_message)
  list(APPEND sources ${core}/wire/${part}.cpp)
endforeach()
list(APPEND sources ${core}/report/convert.cpp ${core}/report/reporter.cpp)

set(hot_sources ${CMAKE_CURRENT_LIST_DIR}/program.cpp)
foreach(part lighthouse/edge_pairing lighthouse/flash_grouping lighthouse/light_decoder lighthouse/rotor_clock lighthouse/slot_tracker
    lighthouse/sorted_decoder lighthouse/sweep_collector wire/cobs wire/crc32 wire/frame_encoder wire/sweep_message
    report/convert report/reporter)
  list(APPEND hot_sources ${core}/${part}.cpp)
endforeach()
foreach(library pharos_small_decoder pharos_small_decoder_32)
  add_library(${library} OBJECT ${sources})
  target_include_directories(${library} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/common)
  target_link_libraries(${library} PRIVATE Eigen3::Eigen pharos_warnings)
  target_compile_options(${library} PRIVATE -Os -flto -msave-restore -mtune=size -ffp-contract=off)
  target_compile_definitions(${library} PRIVATE ${PHAROS_VERSION_DEFINITIONS})
endforeach()
target_compile_definitions(pharos_small_decoder PRIVATE PHAROS_MAX_SENSORS=12)
set_source_files_properties(${hot_sources} PROPERTIES COMPILE_OPTIONS -O2)
