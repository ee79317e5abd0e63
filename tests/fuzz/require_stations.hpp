// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "host/support/input_error.hpp"
#include "pharos/network/station.hpp"
#include "support/require.hpp"

namespace pharos::test {

/// What `read(text, name)` makes of any text: an InputError of one line, or stations with numbers of their own, finite
/// calibrations and poses that are rotations.
template <class Read>
void require_stations_or_error(const std::uint8_t* data, std::size_t size, const Read& read) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const network::Stations stations = read(text, "fuzz");
    for (std::size_t i = 0; i < stations.size(); ++i) {
      require(network::find_station(stations, stations[i].number) == &stations[i]);
      if (!stations[i].T_world_station) continue;
      const Matrix3& R = stations[i].T_world_station->R;
      require((R * R.transpose() - Matrix3::Identity()).norm() < 1e-2);
      require(stations[i].T_world_station->is_finite());
    }
  } catch (const host::InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("fuzz") && message.find('\n') == std::string_view::npos);
  }
}

}  // namespace pharos::test
