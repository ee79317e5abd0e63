// SPDX-License-Identifier: Apache-2.0
#include "tools/decode/lh2_rows.hpp"

#include <algorithm>
#include <bitset>
#include <span>

#include "pharos/lighthouse/lh2_ootx_fields.hpp"
#include "tools/support/words.hpp"

namespace pharos::tools {
namespace {

// A sweep is reported at the latest 1 ms after its last hit, by the next beam.
constexpr double kOrder_s = 0.02;

std::span<const std::uint8_t> bytes_of(const lighthouse::OotxPayload& payload) {
  return {payload.bytes.data(), payload.bytes.size()};
}

std::bitset<256> hit_twice(const lighthouse::Lh2Sweep& sweep) {
  std::bitset<256> once, twice;
  for (const lighthouse::Lh2Hit& hit : sweep.hits) {
    if (once[hit.sensor]) twice[hit.sensor] = true;
    once[hit.sensor] = true;
  }
  return twice;
}

void write_planes(const lighthouse::Lh2Calibration& calibration, host::RowWriter& rows) {
  using Plane = lighthouse::PlaneCalibration;
  constexpr std::array kFields = {&Plane::phase_rad,
                                  &Plane::tilt_rad,
                                  &Plane::curve,
                                  &Plane::gibbous_phase_rad,
                                  &Plane::gibbous_magnitude_rad,
                                  &Plane::ogee_phase_rad,
                                  &Plane::ogee_magnitude};
  for (const auto field : kFields) {
    for (const Plane& plane : calibration.plane) rows.number(plane.*field);
  }
}

}  // namespace

const std::vector<std::string>& lh2_hit_columns() {
  static const std::vector<std::string> kColumns = {"time_s",     "station",   "station_id",  "axis",
                                                    "sensor",     "theta_rad", "width_ticks", "flags",
                                                    "generation", "sync_s",    "offset_bits", "slow_bit"};
  return kColumns;
}

const std::vector<std::string>& lh2_ootx_columns() {
  static const std::vector<std::string> kColumns = {
      "time_s",     "station",    "station_id", "payload_hex", "phase0",    "phase1",      "tilt0",
      "tilt1",      "curve0",     "curve1",     "gibphase0",   "gibphase1", "gibmag0",     "gibmag1",
      "ogeephase0", "ogeephase1", "ogeemag0",   "ogeemag1",    "mode",      "faults",      "firmware",
      "protocol",   "hardware",   "accel_x",    "accel_y",     "accel_z",   "unlock_count"};
  return kColumns;
}

void write_lh2_payload(const lighthouse::OotxPayload& payload, host::RowWriter& rows) {
  rows.number(ticks_to_seconds(payload.time_ticks)).integer(payload.station);
  const auto fields = lighthouse::lh2_ootx_fields(bytes_of(payload));
  rows.text(fields ? station_id_text(fields->calibration.id) : "").text(hex_text(bytes_of(payload)));
  if (fields) {
    write_planes(fields->calibration, rows);
    rows.integer(fields->mode).integer(fields->faults).integer(fields->firmware).integer(fields->protocol);
    rows.integer(fields->hardware);
    for (const std::int8_t a : fields->acceleration) rows.integer(a);
    rows.integer(fields->unlock_count);
  } else {
    rows.none(lh2_ootx_columns().size() - 4);
  }
  rows.end_row();
}

void Lh2HitRows::name_station(const lighthouse::OotxPayload& payload) {
  const auto fields = lighthouse::lh2_ootx_fields(bytes_of(payload));
  if (fields && payload.station < id_.size()) id_[payload.station] = fields->calibration.id;
}

void Lh2HitRows::push(const lighthouse::Lh2Sweep& sweep) {
  const std::bitset<256> several = hit_twice(sweep);
  double newest_s = 0.0;
  for (const lighthouse::Lh2Hit& hit : sweep.hits) {
    Row row;
    row.time_s = newest_s = lh2_hit_time(sweep, hit);
    row.theta_rad = lh2_hit_angle(sweep, hit);
    row.sync_s = static_cast<double>(sweep.sync_sixths) * (kSecondsPerTick / lighthouse::kSixthsPerTick);
    row.offset_bits = static_cast<double>(hit.centre_sixths) / lighthouse::kBit_sixths;
    row.channel = sweep.channel;
    row.plane = sweep.plane;
    row.sensor = hit.sensor;
    row.width_ticks = hit.width_ticks;
    row.slow_bit = sweep.slow_bit;
    row.several = several[hit.sensor];
    waiting_.insert(row);
  }
  while (!waiting_.empty() && waiting_.begin()->time_s < newest_s - kOrder_s) {
    write(*waiting_.begin());
    waiting_.erase(waiting_.begin());
  }
}

void Lh2HitRows::flush() {
  for (const Row& row : waiting_) write(row);
  waiting_.clear();
}

void Lh2HitRows::write(const Row& row) {
  rows_.number(row.time_s).integer(row.channel).text(station_id_text(id_[row.channel]));
  rows_.text(row.plane == 0 ? "a" : "b").integer(row.sensor).number(row.theta_rad).integer(row.width_ticks);
  rows_.text(row.several ? "several" : "").integer(2);
  rows_.number(row.sync_s).number(row.offset_bits).integer(row.slow_bit ? 1 : 0);
  rows_.end_row();
}

}  // namespace pharos::tools
