// SPDX-License-Identifier: Apache-2.0
// Any bytes as a record of libsurvive: an InputError of one line, or devices whose hits are in the order of time.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "host/support/input_error.hpp"
#include "support/memory_file.hpp"
#include "support/require.hpp"
#include "tools/convert/libsurvive_record.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using pharos::test::require;
  const pharos::test::MemoryFile file(data, size);
  try {
    const auto record = pharos::convert::read_libsurvive_record(pharos::host::ByteSource(file.path()));
    for (const auto& [name, device] : record.devices) {
      for (std::size_t i = 0; i < device.hits.size(); ++i) {
        const pharos::convert::LightHit& hit = device.hits[i];
        require(hit.station < 16 && hit.plane < 2 && hit.sensor < 32 && std::abs(hit.theta_rad) < 2.2);
        require(std::isfinite(hit.time_s) && (i == 0 || hit.time_s >= device.hits[i - 1].time_s));
      }
    }
  } catch (const pharos::host::InputError& error) {
    const std::string_view message = error.what();
    require(!message.empty() && message.find('\n') == std::string_view::npos);
  }
  return 0;
}
