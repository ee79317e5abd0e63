// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "pharos/lighthouse/pulse.hpp"

namespace pharos::test {

/// Exact light of one or two base stations on a stationary target, for tests of the decoder: implemented independently
/// from the public description of the stations (no constant of the decoder is used), with truth for every pulse.
///
/// 20 ns ticks. 48 MHz figures of the sources times 50/48.
class SyntheticLight {
 public:
  enum class Layout { kLoneA, kTwo };

  struct Settings {
    Layout layout = Layout::kTwo;
    std::vector<int> sensors = {0, 3, 7, 21};
    double begin_s = 1.0;
    /// Rotor turn, ticks.
    double turn_ticks = 50e6 / 60.0;
    /// Length of strong flashes minus nominal, per station.
    double excess_ticks[2] = {12.0, -20.0};
    /// Standard deviation of flash times (common to all sensors).
    double flash_jitter_ticks = 0.0;
    /// OOTX bit number n of a station.
    std::function<bool(int station, long n)> bit = [](int station, long n) {
      return (n * 2654435761L >> 7 & 1) != station;
    };
  };

  struct FlashTruth {
    std::int64_t slot = 0;
    int station = 0;
    int axis = 0;
    bool skip = false;
    bool data = false;
    std::int64_t start_ticks = 0;
  };

  explicit SyntheticLight(Settings settings) : settings_(std::move(settings)) {}

  /// Truth of a station's flash in a slot. Rotors are not synchronised with each other: y is 133 ticks from half a
  /// turn.
  FlashTruth flash(int station, std::int64_t slot) const {
    FlashTruth truth;
    truth.slot = slot;
    truth.station = station;
    truth.axis = static_cast<int>(slot & 1);
    if (settings_.layout == Layout::kTwo) truth.skip = ((slot & 2) != 0) == (station == 1);
    truth.data = settings_.bit(station, static_cast<long>(slot));
    double start = settings_.begin_s * 50e6 + 0.5 * settings_.turn_ticks * static_cast<double>(slot);
    if (truth.axis == 1) start += 133.0;
    if (station == 1) start += 19'590.0 * 50.0 / 48.0 + (truth.axis == 1 ? 41.0 : 0.0);
    if (settings_.flash_jitter_ticks > 0.0) start += jitter(station, slot);
    truth.start_ticks = std::llround(start);
    return truth;
  }
  int stations() const { return settings_.layout == Layout::kTwo ? 2 : 1; }

  /// Length of a strong sensor's pulse.
  std::int64_t length(const FlashTruth& truth) const {
    const double nominal48 = 3000.0 + 500.0 * truth.axis + 1000.0 * truth.data + 2000.0 * truth.skip;
    return std::llround(nominal48 * 50.0 / 48.0 + settings_.excess_ticks[truth.station]);
  }
  /// Angle of a sensor in one rotor's sweep, fraction of a turn: between 0.12 and 0.36.
  static double fraction(int station, int axis, int sensor) {
    return 0.13 + 0.0071 * sensor + 0.011 * axis + 0.003 * station;
  }
  static int hit_width(int sensor) { return 150 + 10 * sensor; }

  /// Pulses of a flash on every sensor: the first strong, the others weaker and late by three quarters of the
  /// difference in length.
  void add_flash(const FlashTruth& truth, std::vector<lighthouse::RawPulse>& light) const {
    std::int64_t missing = 0;
    for (const int sensor : settings_.sensors) {
      const std::int64_t rise = truth.start_ticks + missing * 3 / 4;
      light.push_back({rise, rise + length(truth) - missing, static_cast<std::uint8_t>(sensor)});
      missing += 24;
    }
  }
  /// Hits of the sweep that follows a flash. Widths are even, so that centres are whole ticks.
  void add_hits(const FlashTruth& truth, std::vector<lighthouse::RawPulse>& light) const {
    if (truth.skip) return;
    for (const int sensor : settings_.sensors) {
      const std::int64_t centre = truth.start_ticks + centre_after_flash(truth, sensor);
      light.push_back(
          {centre - hit_width(sensor) / 2, centre + hit_width(sensor) / 2, static_cast<std::uint8_t>(sensor)});
    }
  }
  std::int64_t centre_after_flash(const FlashTruth& truth, int sensor) const {
    return std::llround(fraction(truth.station, truth.axis, sensor) * settings_.turn_ticks);
  }

  /// All light of slots [begin, end), in the order of the falling edges, as receivers send it. `seen` selects the
  /// flashes that the target sees.
  std::vector<lighthouse::RawPulse> slots(
      std::int64_t begin, std::int64_t end,
      const std::function<bool(const FlashTruth&)>& seen = [](const FlashTruth&) { return true; }) const {
    std::vector<lighthouse::RawPulse> light;
    for (std::int64_t slot = begin; slot < end; ++slot) {
      for (int station = 0; station < stations(); ++station) {
        const FlashTruth truth = flash(station, slot);
        if (seen(truth)) add_flash(truth, light);
        add_hits(truth, light);
      }
    }
    sort_by_fall(light);
    return light;
  }
  const Settings& settings() const { return settings_; }

  static void sort_by_fall(std::vector<lighthouse::RawPulse>& light) {
    std::stable_sort(light.begin(), light.end(),
                     [](const auto& a, const auto& b) { return a.fall_ticks < b.fall_ticks; });
  }
  static std::vector<lighthouse::RawPulse> shifted(std::vector<lighthouse::RawPulse> light, std::int64_t ticks) {
    for (auto& pulse : light) {
      pulse.rise_ticks += ticks;
      pulse.fall_ticks += ticks;
    }
    return light;
  }

 private:
  double jitter(int station, std::int64_t slot) const {
    std::mt19937_64 random(static_cast<std::uint64_t>(slot * 2 + station) * 0x9E3779B97F4A7C15ULL);
    random.discard(4);
    return std::normal_distribution<double>(0.0, settings_.flash_jitter_ticks)(random);
  }
  Settings settings_;
};

/// OOTX bits of a frame that carries `payload`: preamble, length, payload, CRC-32, each word with its sync bit. The CRC
/// is zlib's, computed here by polynomial division of its own.
inline std::vector<bool> ootx_bits(const std::vector<std::uint8_t>& payload) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const std::uint8_t byte : payload) {
    for (int bit = 0; bit < 8; ++bit) {
      const bool divide = ((crc ^ (byte >> bit)) & 1U) != 0;
      crc >>= 1U;
      if (divide) crc ^= 0xEDB88320U;
    }
  }
  crc = ~crc;
  std::vector<std::uint8_t> bytes = {static_cast<std::uint8_t>(payload.size() & 0xFFU),
                                     static_cast<std::uint8_t>(payload.size() >> 8U)};
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  if (payload.size() % 2 == 1) bytes.push_back(0);
  for (unsigned shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(crc >> shift));
  std::vector<bool> bits(17, false);
  bits.push_back(true);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (int bit = 7; bit >= 0; --bit) bits.push_back((bytes[i] >> bit & 1) != 0);
    if (i % 2 == 1) bits.push_back(true);
  }
  return bits;
}

/// Bytes of a string of hexadecimal digits.
inline std::vector<std::uint8_t> from_hex(const char* hex) {
  std::vector<std::uint8_t> bytes;
  const auto digit = [](char c) { return static_cast<unsigned>(c <= '9' ? c - '0' : c - 'a' + 10); };
  for (; hex[0] != 0 && hex[1] != 0; hex += 2) {
    bytes.push_back(static_cast<std::uint8_t>(digit(hex[0]) << 4U | digit(hex[1])));
  }
  return bytes;
}

}  // namespace pharos::test
