// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "host/mounting/mounting_file.hpp"
#include "host/support/input_error.hpp"
#include "support/require.hpp"

// Any bytes are either a mounting of valid poses that is read back as written, or an InputError of one line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using pharos::test::require;
  using namespace pharos::host;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const Mounting mounting = parse_mounting(text, "fuzz.toml");
    for (const SourceMounting& source : mounting.sources) {
      const VehicleFromSensor pose = source.vehicle_from_sensor();
      require(pose.is_finite() && (pose.R * pose.R.transpose() - pharos::Matrix3::Identity()).norm() < 1e-9);
      require(source.T_vehicle_sensor.covariance.allFinite() && source.cross_covariance.allFinite());
    }
    const std::string written = mounting_text(mounting);
    require(mounting_text(parse_mounting(written, "fuzz.toml")) == written);
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("fuzz.toml:") && message.find('\n') == std::string_view::npos);
  }
  return 0;
}
