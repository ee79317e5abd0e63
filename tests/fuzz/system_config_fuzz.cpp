// SPDX-License-Identifier: Apache-2.0
#include "fuzz/require_stations.hpp"
#include "tools/convert/system_config.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pharos::test::require_stations_or_error(data, size, pharos::convert::read_system_config);
  return 0;
}
