// SPDX-License-Identifier: Apache-2.0
#include "rtl/random_traffic.hpp"

#include <algorithm>
#include <array>

#include "firmware/rtl/capture_registers.h"

namespace pharos::rtl {
namespace {

constexpr std::uint32_t kWordsOfRecord = 4;
constexpr std::uint32_t kOffsets = 16;

}  // namespace

void RandomTraffic::run(std::uint64_t ticks) {
  std::uint64_t stretch = 0;
  for (std::uint64_t i = 0; i < ticks && rig_.agrees(); ++i) {
    if (stretch-- == 0) {
      stretch = below(3 * std::min(rig_.build().depth, 256u) + 20);
      light_ = static_cast<Light>(below(static_cast<std::uint32_t>(Light::kCount)));
      reader_ = static_cast<Reader>(below(static_cast<std::uint32_t>(Reader::kCount)));
    }
    rig_.set_pins(next_pins());
    rig_.tick(next_request());
  }
}

std::uint32_t RandomTraffic::next_pins() {
  const std::uint32_t pins = rig_.pins();
  const auto any = static_cast<std::uint32_t>(random_());
  switch (light_) {
    case Light::kSparse:
      return below(12) == 0 ? pins ^ (1u << below(rig_.build().inputs)) : pins;
    case Light::kFlashes:
      return below(20) == 0 ? (pins == 0 ? ~0u : 0u) : pins;
    case Light::kOneTickPulses:
      return pins != 0 || below(4) != 0 ? 0u : any;
    case Light::kEveryTick:
      return ~pins;
    case Light::kStorm:
      return any;
    default:
      return pins;
  }
}

BusRequest RandomTraffic::next_request() {
  if (below(400) == 0) return random_write();
  switch (reader_) {
    case Reader::kAnything:
      return {below(2) == 0 ? BusRequest::Kind::kRead : BusRequest::Kind::kNone,
              static_cast<std::uint8_t>(4 * below(kOffsets)), 0};
    case Reader::kDrainsSlowly:
      if (words_left_ == 0 && below(30) != 0) return {};
      [[fallthrough]];
    case Reader::kDrains: {
      if (words_left_ == 0) words_left_ = kWordsOfRecord;
      const std::uint32_t word = kWordsOfRecord - words_left_--;
      return {BusRequest::Kind::kRead, static_cast<std::uint8_t>(PHAROS_CAPTURE_STATUS_OFFSET + 4 * word), 0};
    }
    default:
      return {};
  }
}

BusRequest RandomTraffic::random_write() {
  const auto any = static_cast<std::uint32_t>(random_());
  const auto offset = static_cast<std::uint8_t>(4 * below(kOffsets));
  // With uniform random values capturing would be off half the time and the threshold never reached.
  if (offset == PHAROS_CAPTURE_CONTROL_OFFSET) {
    const std::uint32_t enable = below(8) == 0 ? 0 : PHAROS_CAPTURE_CONTROL_ENABLE;
    return {BusRequest::Kind::kWrite, offset, enable | (below(4) == 0 ? PHAROS_CAPTURE_CONTROL_CLEAR_FIFO : 0)};
  }
  if (offset == PHAROS_CAPTURE_THRESHOLD_OFFSET) {
    return {BusRequest::Kind::kWrite, offset, below(rig_.build().depth + 2)};
  }
  if (offset == PHAROS_CAPTURE_FILTER_OFFSET && below(2) == 0) return {BusRequest::Kind::kWrite, offset, 0};
  return {BusRequest::Kind::kWrite, offset, any};
}

}  // namespace pharos::rtl
