// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "host/publish/measurement_header.hpp"
#include "host/publish/publisher.hpp"

namespace pharos::host {

/// The last stage of every pipeline, and the only path of a measurement to LCM: sends reports that are finite and
/// fresh, with the next number of their series, and counts those that are not sent. Refusals are sent in the same way;
/// they contain no numbers.
///
/// A report is a MeasurementHeader with three functions that are found by its type: `channel_of(report)`, the channel
/// behind the prefix; `message_of(report)`, its LCM message; `is_finite(report)`, whether all numbers of that message
/// are finite. A new kind of report needs no change in this room (see host/daemon/README.md, "How to add a source").
class PublishGate {
 public:
  /// Reports older than `max_age_ns`, or as far in the future, are not sent; `stale` counts them.
  struct AgeLimit {
    std::int64_t max_age_ns = 0;
    std::int64_t& stale;
  };

  /// `publisher` and the counters must outlive this. Without `limit` no report is too old (files).
  explicit PublishGate(Publisher& publisher, std::int64_t& not_finite, std::optional<AgeLimit> limit = std::nullopt)
      : publisher_(publisher), not_finite_(not_finite), limit_(limit) {}
  PublishGate(const PublishGate&) = delete;  // holds references to counters
  PublishGate& operator=(const PublishGate&) = delete;

  /// The age limit from now on; no effect where there is none.
  void set_max_age(std::int64_t max_age_ns) {
    if (limit_) limit_->max_age_ns = max_age_ns;
  }

  /// Whether all numbers of the report are finite; counts it where not.
  template <class Report>
  bool finite(const Report& report) {
    if (!report.answered() || is_finite(report)) return true;
    ++not_finite_;
    return false;
  }
  /// Whether a measurement of this age may be sent; counts it where not.
  bool fresh(std::int64_t age_ns);
  /// Both. A report that passes is sent by publish() unless it was changed in between.
  template <class Report>
  bool passes(const Report& report) {
    return finite(report) && fresh(report.age_ns);
  }

  /// Checks, numbers and sends a report; true where it was sent.
  template <class Report>
  bool publish(Report& report) {
    if (!passes(report)) return false;
    report.sequence = sequence_++;
    return publisher_.send(channel_of(report), message_of(report));
  }
  /// Checks and sends a second message of the measurement that was published last, under that one's number.
  template <class Report>
  bool publish_companion(Report& report) {
    if (!passes(report)) return false;
    report.sequence = sequence_ - 1;
    return publisher_.send(channel_of(report), message_of(report));
  }

 private:
  Publisher& publisher_;
  std::int64_t& not_finite_;
  std::optional<AgeLimit> limit_;
  std::int64_t sequence_ = 0;
};

}  // namespace pharos::host
