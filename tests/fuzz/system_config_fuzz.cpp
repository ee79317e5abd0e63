// SPDX-License-Identifier: Apache-2.0
// Any text as such a configuration: an InputError of one line, or stations with numbers of their own, finite
// calibrations and poses that are rotations.
#include <cstdint>
#include <string>
#include <string_view>

#include "host/support/input_error.hpp"
#include "support/require.hpp"
#include "tools/convert/system_config.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using pharos::test::require;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const pharos::network::Stations stations = pharos::convert::read_system_config(text, "fuzz");
    for (std::size_t i = 0; i < stations.size(); ++i) {
      require(pharos::network::find_station(stations, stations[i].number) == &stations[i]);
      if (!stations[i].T_world_station) continue;
      const pharos::Matrix3& R = stations[i].T_world_station->R;
      require((R * R.transpose() - pharos::Matrix3::Identity()).norm() < 1e-2);
      require(stations[i].T_world_station->is_finite());
    }
  } catch (const pharos::host::InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("fuzz") && message.find('\n') == std::string_view::npos);
  }
  return 0;
}
