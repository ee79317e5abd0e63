// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/lh2/lh2_simulator.hpp"
#include "tools/sim/ootx_sender.hpp"

namespace pharos::sim {
namespace {

constexpr std::uint16_t kFirmware = 34;
constexpr std::uint16_t kLh2Protocol = 8;

void put_word(std::vector<std::uint8_t>& bytes, std::uint16_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
}

}  // namespace

PlaneErrors as_announced(const PlaneErrors& errors) {
  PlaneErrors out = errors;
  for (double PlaneErrors::*field :
       {&PlaneErrors::phase_rad, &PlaneErrors::tilt_rad, &PlaneErrors::curve, &PlaneErrors::gibbous_phase_rad,
        &PlaneErrors::gibbous_magnitude_rad, &PlaneErrors::ogee_phase_rad, &PlaneErrors::ogee_magnitude}) {
    out.*field = from_half(to_half(errors.*field));
  }
  return out;
}

std::vector<std::uint8_t> lh2_announcement(const Lh2SimStation& station) {
  std::vector<std::uint8_t> bytes;
  const auto both = [&](double PlaneErrors::*field) {
    for (const PlaneErrors& plane : station.announced) put_word(bytes, to_half(plane.*field));
  };
  put_word(bytes, kFirmware << 6U | kLh2Protocol);
  put_word(bytes, static_cast<std::uint16_t>(station.id & 0xFFFFU));
  put_word(bytes, static_cast<std::uint16_t>(station.id >> 16U));
  both(&PlaneErrors::phase_rad);
  both(&PlaneErrors::tilt_rad);
  bytes.push_back(1);   // times unlocked
  bytes.push_back(15);  // hardware
  both(&PlaneErrors::curve);
  for (const int g : {0, 127, -4}) bytes.push_back(static_cast<std::uint8_t>(g));
  both(&PlaneErrors::gibbous_phase_rad);
  both(&PlaneErrors::gibbous_magnitude_rad);
  bytes.push_back(static_cast<std::uint8_t>(0x80 | station.channel));
  bytes.push_back(0);  // faults
  both(&PlaneErrors::ogee_phase_rad);
  both(&PlaneErrors::ogee_magnitude);
  put_word(bytes, 0);
  return bytes;
}

}  // namespace pharos::sim
