// SPDX-License-Identifier: Apache-2.0
#include "integration/stationary_target.hpp"

#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/lighthouse/station_model.hpp"
#include "pharos/wire/cobs.hpp"
#include "pharos/wire/crc32.hpp"

namespace pharos::host {

namespace {

constexpr double kPositions_m[12][3] = {{-0.05, -0.05, 0.0}, {0.05, -0.05, 0.0},   {0.05, 0.05, 0.0},
                                        {-0.05, 0.05, 0.0},  {0.02, 0.0, -0.04},   {-0.02, 0.01, -0.06},
                                        {0.06, 0.0, -0.03},  {-0.06, 0.0, -0.03},  {0.0, 0.06, -0.03},
                                        {0.0, -0.06, -0.03}, {0.03, -0.03, -0.05}, {-0.03, 0.03, -0.05}};

}  // namespace

Target StationaryTarget::target(std::uint8_t sensors) {
  Target target;
  for (std::uint8_t i = 0; i < sensors; ++i) {
    SensorPlacement placement;
    placement.sensor = i;
    placement.position_m = Vector3(kPositions_m[i][0], kPositions_m[i][1], kPositions_m[i][2]);
    target.push_back(placement);
  }
  return target;
}

std::string StationaryTarget::target_table(std::uint8_t sensors) {
  std::string table = "sensor,x_m,y_m,z_m\n";
  for (const SensorPlacement& placement : target(sensors)) {
    table += std::to_string(placement.sensor);
    for (int i = 0; i < 3; ++i) table += ',' + std::to_string(placement.position_m[i]);
    table += '\n';
  }
  return table;
}

lighthouse::Sweep StationaryTarget::sweep(Axis axis, std::int64_t flash_ticks, std::size_t sensors) const {
  lighthouse::Sweep sweep;
  sweep.flash.start_ticks = flash_ticks;
  sweep.flash.length_ticks = axis == Axis::kX ? 3125 : 3646;
  sweep.flash.axis = axis;
  sweep.flash.sensors = 6;
  sweep.period_sixteenth_ticks = 16 * kTurn_ticks;
  for (const SensorPlacement& placement : target_) {
    if (sweep.hits.size() == sensors) break;
    const double theta = lighthouse::ideal_thetas(truth_ * placement.position_m)[axis];
    const double half_ticks = theta / kTwoPi * 2.0 * static_cast<double>(kTurn_ticks);
    sweep.hits.push_back({placement.sensor, 200, static_cast<std::int32_t>(std::lround(half_ticks))});
  }
  return sweep;
}

StationaryTarget::Bytes StationaryTarget::cycle(std::int64_t end_ticks) {
  // The last hit is a third of a turn after its flash, at most.
  const std::int64_t y_flash = end_ticks - kTurn_ticks / 3;
  Bytes bytes = bytes_of(sweep(Axis::kX, y_flash - kHalfTurn_ticks));
  const Bytes y = bytes_of(sweep(Axis::kY, y_flash));
  bytes.insert(bytes.end(), y.begin(), y.end());
  return bytes;
}

StationaryTarget::Bytes StationaryTarget::hello(const char* board, std::int64_t now_ticks, std::uint16_t start_count) {
  wire::Hello hello;
  hello.time_ticks = now_ticks;
  hello.start_count = start_count;
  hello.role = wire::Role::kSimulator;
  hello.modes = wire::kModeSweeps;
  hello.firmware_minor = 1;
  hello.tick_rate_hz = 50'000'000;
  hello.sensors = 0x3F;
  hello.board = wire::Text<24>(board);
  return copy(reporter_.send(hello));
}

StationaryTarget::Bytes StationaryTarget::counters(std::uint32_t edges_in) {
  report::DecoderReport report;
  report.counters.edges_in = edges_in;
  return copy(reporter_.report(report));
}

StationaryTarget::Bytes StationaryTarget::ootx(std::int64_t now_ticks, std::uint32_t id) {
  lighthouse::OotxPayload payload;
  payload.time_ticks = now_ticks;
  payload.bytes.resize(33);
  for (std::uint8_t& byte : payload.bytes) byte = 0;
  payload.bytes[0] = 6;  // protocol 6, firmware 0
  for (int i = 0; i < 4; ++i) payload.bytes[static_cast<std::size_t>(2 + i)] = static_cast<std::uint8_t>(id >> (8 * i));
  return copy(reporter_.report(payload));
}

StationaryTarget::Bytes frame_of_unsupported_version(std::uint8_t version, std::uint16_t sequence) {
  StationaryTarget::Bytes frame{
      version, 2, static_cast<std::uint8_t>(sequence), static_cast<std::uint8_t>(sequence >> 8), 1, 2, 3};
  const std::uint32_t crc = wire::crc32(frame);
  for (int i = 0; i < 4; ++i) frame.push_back(static_cast<std::uint8_t>(crc >> (8 * i)));
  StationaryTarget::Bytes line(64);
  wire::CobsWriter stuffing(std::span<std::uint8_t>(line).subspan(1));
  stuffing.put(frame);
  line.resize(1 + stuffing.finish());
  line.push_back(0);
  return line;
}

}  // namespace pharos::host
