// SPDX-License-Identifier: Apache-2.0
#include "rtl/chip/chip_light.hpp"

#include <algorithm>
#include <fstream>

#include "host/support/input_error.hpp"
#include "host/table/edges_reader.hpp"
#include "pharos/base/ticks.hpp"

namespace pharos::rtl {

void ChipLight::move(std::int64_t ticks) {
  for (lighthouse::RawPulse& pulse : pulses) {
    pulse.rise_ticks += ticks;
    pulse.fall_ticks += ticks;
  }
  first_ticks += ticks;
  last_ticks += ticks;
}

ChipLight read_light(const std::string& path, double seconds) {
  host::EdgesReader reader{host::ByteSource(path)};
  ChipLight light;
  auto& pulses = light.pulses;
  while (const auto pulse = reader.next()) pulses.push_back(*pulse);
  if (pulses.empty()) throw host::InputError(path + ": no edges");
  light.first_ticks = std::ranges::min(pulses, {}, &lighthouse::RawPulse::rise_ticks).rise_ticks;
  std::erase_if(pulses, [&](const lighthouse::RawPulse& pulse) {
    return ticks_to_seconds(pulse.rise_ticks - light.first_ticks) >= seconds;
  });
  light.last_ticks = std::ranges::max(pulses, {}, &lighthouse::RawPulse::fall_ticks).fall_ticks;
  return light;
}

void write_pulses(const std::string& path, const std::vector<lighthouse::RawPulse>& pulses) {
  std::ofstream file(path);
  file << "sensor,rise_ticks,fall_ticks\n";
  for (const lighthouse::RawPulse& pulse : pulses) {
    file << int{pulse.sensor} << ',' << pulse.rise_ticks << ',' << pulse.fall_ticks << '\n';
  }
  file.close();
  if (!file) throw host::InputError(path + ": cannot be written");
}

}  // namespace pharos::rtl
