// SPDX-License-Identifier: Apache-2.0
// OOTX with any bits and any payload: no crash, exactly the encoded frames are decoded, a good frame is read after any
// input, and fields are finite or refused.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "pharos/lighthouse/calibration_store.hpp"
#include "pharos/lighthouse/ootx_fields.hpp"
#include "pharos/lighthouse/ootx_frames.hpp"
#include "support/require.hpp"
#include "support/synthetic_light.hpp"

namespace {

using pharos::test::require;
using namespace pharos::lighthouse;

void check_fields(const std::vector<std::uint8_t>& bytes, CalibrationStore& store) {
  const auto fields = ootx_fields(bytes);
  if (fields) {
    for (const RotorCalibration& rotor : fields->calibration.rotor) {
      require(std::isfinite(rotor.phase_rad) && std::isfinite(rotor.tilt_rad) && std::isfinite(rotor.curve_rad) &&
              std::isfinite(rotor.gibbous_phase_rad) && std::isfinite(rotor.gibbous_magnitude_rad));
    }
  }
  OotxPayload payload;
  for (const std::uint8_t byte : bytes) payload.bytes.push_back(byte);
  const auto verdict = store.push(payload);
  require((verdict == CalibrationStore::Verdict::kUnreadable) == !fields.ok());
  require(verdict != CalibrationStore::Verdict::kTakenIntoUse || store.in_use(0) != nullptr);
  require(store.accepted().size() <= CalibrationStore::kMemory);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  OotxFrames frames;
  DecoderCounters counters;
  CalibrationStore store;
  // The input as bits; every 16th byte gives the position of a missed flash.
  for (std::size_t i = 0; i < size; ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      const bool follows_last = i % 16 != 15 || bit != 3 || (data[i] & 1U) == 0;
      const auto payload = frames.push((data[i] >> bit & 1U) != 0, follows_last, counters);
      if (payload) check_fields({payload->begin(), payload->end()}, store);
    }
  }
  // The input as a payload: directly to the fields, and framed.
  const std::vector<std::uint8_t> payload(data, data + (size < kMaxOotxPayload ? size : kMaxOotxPayload));
  check_fields(payload, store);
  if (payload.empty()) return 0;
  std::size_t came = 0;
  const std::uint32_t before = counters.ootx_frames;
  for (const bool bit : pharos::test::ootx_bits(payload)) {
    const auto got = frames.push(bit, true, counters);
    if (!got) continue;
    came += std::vector<std::uint8_t>(got->begin(), got->end()) == payload ? 1U : 0U;
  }
  require(came == 1 && counters.ootx_frames >= before + 1);
  return 0;
}
