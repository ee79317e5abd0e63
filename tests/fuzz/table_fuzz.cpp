// SPDX-License-Identifier: Apache-2.0
// Any bytes as a recording, a target and a pose table: an InputError or values within their documented range, and a
// recording written again reads back the same.
#include <cstdint>
#include <string>
#include <vector>

#include "host/support/input_error.hpp"
#include "host/table/edges_reader.hpp"
#include "host/table/pose_table.hpp"
#include "host/table/target_file.hpp"
#include "support/memory_file.hpp"
#include "support/require.hpp"

namespace {

using pharos::host::ByteSource;
using pharos::host::EdgesReader;
using pharos::lighthouse::RawPulse;
using pharos::test::MemoryFile;
using pharos::test::require;

std::vector<RawPulse> pulses_of(const std::string& path) {
  std::vector<RawPulse> pulses;
  try {
    EdgesReader reader{ByteSource(path)};
    while (const auto pulse = reader.next()) pulses.push_back(*pulse);
  } catch (const pharos::host::InputError& error) {
    require(error.what()[0] != '\0');
  }
  return pulses;
}

void check_round_trip(const std::vector<RawPulse>& pulses) {
  std::string text = "sensor,rise_ticks,fall_ticks\n";
  // A first row beyond 32 bits marks unwrapped times, which must be read back unchanged.
  constexpr std::int64_t kBeyond = std::int64_t{1} << 40;
  text += "0," + std::to_string(kBeyond) + "," + std::to_string(kBeyond) + "\n";
  for (const RawPulse& pulse : pulses) {
    if (std::abs(pulse.rise_ticks) > kBeyond * 1024 || std::abs(pulse.fall_ticks) > kBeyond * 1024) return;
    text += std::to_string(pulse.sensor) + "," + std::to_string(pulse.rise_ticks) + "," +
            std::to_string(pulse.fall_ticks) + "\r\n";
  }
  const MemoryFile file(text.data(), text.size());
  const std::vector<RawPulse> again = pulses_of(file.path());
  require(again.size() == pulses.size() + 1);
  for (std::size_t i = 0; i < pulses.size(); ++i) {
    require(again[i + 1].sensor == pulses[i].sensor);
    require(again[i + 1].rise_ticks == pulses[i].rise_ticks);
    require(again[i + 1].fall_ticks == pulses[i].fall_ticks);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  check_round_trip(pulses_of(file.path()));
  try {
    const auto target = pharos::host::read_target(file.path());
    require(pharos::check_target(target.target).ok());
  } catch (const pharos::host::InputError&) {
  }
  try {
    for (const auto& row : pharos::host::read_poses(file.path(), "pose")) {
      require(!row.T_lighthouse_body || row.T_lighthouse_body->is_finite());
    }
  } catch (const pharos::host::InputError&) {
  }
  return 0;
}
