// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "host/calibrate/calibration_file.hpp"
#include "host/support/input_error.hpp"

// Any bytes are either a calibration with a valid target, or an InputError of one line; never anything else.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const auto file = pharos::calibrate::parse_calibration(text, "fuzz.toml");
    if (file.nominal_m.size() != file.sensors.size() || file.covariance.size() != file.parameters.size()) std::abort();
    if (file.has_target()) {
      if (!pharos::check_target(file.sensors)) std::abort();
      pharos::Target nominal = file.sensors;
      for (std::size_t i = 0; i < nominal.size(); ++i) nominal[i].position_m = file.nominal_m[i];
      if (pharos::calibrate::calibrated_target(file, nominal).size() != nominal.size()) std::abort();
    }
  } catch (const pharos::host::InputError& error) {
    const std::string_view message = error.what();
    if (!message.starts_with("fuzz.toml:") || message.find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
