// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace pharos::host {

/// How a measurement went, as an estimator tells it beside its numbers.
struct MeasurementOutcome {
  /// Where there is no answer: why, as the `<reason>` of refused_<reason>; empty where there is one.
  std::string refusal;
  /// The refusal for people, with what to do. Of log and status; no message carries it.
  std::string advice;
  std::string flags;     // words joined by '|'
  int observations = 0;  // that the answer rests on

  bool answered() const { return refusal.empty(); }
};

/// The frames of a measurement by name: a pose takes coordinates in `child` to coordinates in `parent`.
struct FramePair {
  const char* parent = "";
  const char* child = "";
};

/// What every report of a measurement begins with, whatever the sensor: when, by whom, of what, and how it went.
struct MeasurementHeader : MeasurementOutcome {
  std::int64_t utc_ns = 0;        // time of validity: when the light was measured
  std::int64_t utc_sigma_ns = 0;  // stated uncertainty of utc_ns against this computer's UTC
  std::int64_t age_ns = 0;        // from the measurement to when this report was made; 0 where no age is told
  std::int64_t sequence = 0;      // given by PublishGate to what it lets out
  std::string source;             // who tells it, as "tof/NAME"
  std::string sensor;             // station id or name of the camera
  std::string target;
  FramePair frames;
  bool ambiguous = false;  // a second answer fits nearly as well
};

/// "ok", "ambiguous" or "refused_<reason>": the `status` of messages.
std::string status_word(const MeasurementHeader& header);

}  // namespace pharos::host
