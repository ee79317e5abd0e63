// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace pharos::host {

/// Outcome of a measurement, as an estimator reports it beside its numbers.
struct MeasurementOutcome {
  /// Reason of a refusal, the `<reason>` of refused_<reason>; empty where there is a result.
  std::string refusal;
  /// The refusal as text for the user, with what to do. For log and status; not part of any message.
  std::string advice;
  std::string flags;     // words joined by '|'
  int observations = 0;  // used for the result

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
  std::int64_t age_ns = 0;        // from the measurement to when this report was made; 0 where no age is reported
  std::int64_t sequence = 0;      // set by PublishGate when it sends
  std::string source;             // the reporting source, as "tof/NAME"
  std::string sensor;             // station id or name of the camera
  std::string target;
  FramePair frames;
  bool ambiguous = false;  // a second solution fits nearly as well
};

/// "ok", "ambiguous" or "refused_<reason>": the `status` of messages.
std::string status_word(const MeasurementHeader& header);

}  // namespace pharos::host
