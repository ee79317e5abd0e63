// SPDX-License-Identifier: Apache-2.0
// Any bytes as a log of a Crazyflie, as they are and with a good checksum: an InputError of one line, or values within
// their ranges, and sweeps of both generations in the order of time.
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "host/support/input_error.hpp"
#include "pharos/wire/crc32.hpp"
#include "support/require.hpp"
#include "tools/convert/crazyflie_log.hpp"
#include "tools/convert/crazyflie_sweeps.hpp"

namespace {

using pharos::test::require;

void check(const std::vector<std::uint8_t>& bytes) {
  using namespace pharos::convert;
  try {
    const CrazyflieLog log = read_crazyflie_log(bytes, "fuzz");
    for (const LoggedAngle& angle : log.angles) {
      require(angle.sensor < 32 && angle.station < 16 && angle.plane < 2 && std::abs(angle.angle_rad) < 1.5);
    }
    for (const CrossingBeam& beam : log.crossing_beams) require(beam.position_m.allFinite());
    for (const ImuSample& sample : log.imu) require(sample.gyro_rad_s.allFinite());
    for (const int generation : {1, 2}) {
      const CrazyflieSweeps sweeps = sweeps_of(log, generation);
      require(sweeps.hits.size() + sweeps.repeated <= log.angles.size());
      for (std::size_t i = 0; i < sweeps.hits.size(); ++i) {
        require(std::isfinite(sweeps.hits[i].time_s) && std::isfinite(sweeps.hits[i].theta_rad));
        require(i == 0 || sweeps.hits[i].time_s >= sweeps.hits[i - 1].time_s);
      }
    }
  } catch (const pharos::host::InputError& error) {
    const std::string_view message = error.what();
    require(!message.empty() && message.find('\n') == std::string_view::npos);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(data, data + size);
  check(bytes);
  const std::uint32_t crc = pharos::wire::crc32(bytes);
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(crc >> (8 * i)));
  check(bytes);
  return 0;
}
