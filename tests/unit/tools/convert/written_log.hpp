// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "pharos/wire/crc32.hpp"

namespace pharos::test {

/// Bytes of a Crazyflie log, written as the format's description says.
class WrittenLog {
 public:
  WrittenLog() {
    put(0xBC, 1);
    put(2, 2);
    put(3, 2);
    type(1, "lhAngle", {"sensor(B)", "basestation(B)", "sweep(B)", "angle(f)", "correctedAngle(f)"});
    type(3, "lhCrossingBeam", {"x(f)", "y(f)", "z(f)", "delta(f)"});
    type(0, "activeMarkerModeChanged", {"mode(B)"});
  }
  void type(std::uint64_t id, const std::string& name, const std::vector<std::string>& variables) {
    put(id, 2);
    text(name);
    put(variables.size(), 2);
    for (const std::string& variable : variables) text(variable);
  }
  void angle(double time_s, int sensor, int station, int sweep, float angle_rad) {
    event(1, time_s);
    put(static_cast<std::uint64_t>(sensor), 1);
    put(static_cast<std::uint64_t>(station), 1);
    put(static_cast<std::uint64_t>(sweep), 1);
    put(std::bit_cast<std::uint32_t>(angle_rad), 4);
    put(0, 4);
  }
  void beam(double time_s, float x, float y, float z, float delta) {
    event(3, time_s);
    for (const float v : {x, y, z, delta}) put(std::bit_cast<std::uint32_t>(v), 4);
  }
  void marker(double time_s, int mode) {
    event(0, time_s);
    put(static_cast<std::uint64_t>(mode), 1);
  }
  void event(std::uint64_t id, double time_s) {
    put(id, 2);
    put(static_cast<std::uint64_t>(time_s * 1e6 + 0.5), 8);
  }
  void put(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  void text(const std::string& word) {
    bytes_.insert(bytes_.end(), word.begin(), word.end());
    bytes_.push_back(0);
  }
  /// With the checksum at the end.
  std::vector<std::uint8_t> bytes() const {
    std::vector<std::uint8_t> out = bytes_;
    const std::uint32_t crc = wire::crc32(bytes_);
    for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(crc >> (8 * i)));
    return out;
  }

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace pharos::test
