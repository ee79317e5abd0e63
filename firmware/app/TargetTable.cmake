# SPDX-License-Identifier: Apache-2.0
# target_table.cpp: the target whose poses decoder_pose solves, from a table sensor,x_m,y_m,z_m,nx,ny,nz.
set(PHAROS_TARGET_TABLE ${PROJECT_SOURCE_DIR}/tools/sim/scenarios/target12.csv CACHE FILEPATH
  "The target whose poses the build decoder_pose solves on board")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PHAROS_TARGET_TABLE})
file(STRINGS ${PHAROS_TARGET_TABLE} rows)
list(POP_FRONT rows header)
if(NOT header MATCHES "^sensor,x_m,y_m,z_m,nx,ny,nz")
  message(FATAL_ERROR "${PHAROS_TARGET_TABLE}: begins with '${header}', needed is sensor,x_m,y_m,z_m,nx,ny,nz")
endif()
set(entries "")
set(number "([-+0-9.eE]+)")
foreach(row IN LISTS rows)
  if(NOT row MATCHES "^([0-9]+),${number},${number},${number},${number},${number},${number}")
    message(FATAL_ERROR "${PHAROS_TARGET_TABLE}: cannot read the row '${row}'")
  endif()
  if(CMAKE_MATCH_1 GREATER_EQUAL 12)
    message(FATAL_ERROR "${PHAROS_TARGET_TABLE}: sensor ${CMAKE_MATCH_1}: decoder_pose is for a board of 12 inputs, 0 to 11")
  endif()
  string(APPEND entries "    {${CMAKE_MATCH_1}, {{${CMAKE_MATCH_2}, ${CMAKE_MATCH_3}, ${CMAKE_MATCH_4}}}, "
    "{{${CMAKE_MATCH_5}, ${CMAKE_MATCH_6}, ${CMAKE_MATCH_7}}}},\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/target_table.cpp @ONLY CONTENT
"// Made from @PHAROS_TARGET_TABLE@.
#include \"firmware/app/target_table.hpp\"

namespace pharos::app {
namespace {

constexpr TargetRow kRows[] = {
@entries@};

}  // namespace

std::span<const TargetRow> target_table() { return kRows; }

}  // namespace pharos::app
")
