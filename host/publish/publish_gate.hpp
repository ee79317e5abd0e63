// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "host/publish/measurement_header.hpp"
#include "host/publish/publisher.hpp"

namespace pharos::host {

/// The last stage of every pipeline, and the only way of a measurement to LCM: what leaves is finite and fresh, has the
/// next number of its series, and what does not leave is counted. Refusals leave as answers do; they hold no numbers.
///
/// A report is a MeasurementHeader with three functions that are found by its type: `channel_of(report)`, the channel
/// behind the prefix; `message_of(report)`, its LCM message; `is_finite(report)`, whether all of that message's numbers
/// are. A report of a new kind needs no change in this room (see host/daemon/README.md, "How to add a source").
class PublishGate {
 public:
  /// Reports older than `max_age_ns`, or as far in the future, are not sent; `stale` counts them.
  struct AgeLimit {
    std::int64_t max_age_ns = 0;
    std::int64_t& stale;
  };

  /// `publisher` and the counters must outlive this. No `limit`: nothing is too old to be told (files).
  explicit PublishGate(Publisher& publisher, std::int64_t& not_finite, std::optional<AgeLimit> limit = std::nullopt)
      : publisher_(publisher), not_finite_(not_finite), limit_(limit) {}
  PublishGate(const PublishGate&) = delete;  // counters stand beside it
  PublishGate& operator=(const PublishGate&) = delete;

  /// May this report leave as far as its numbers go? Counts it where not.
  template <class Report>
  bool finite(const Report& report) {
    if (!report.answered() || is_finite(report)) return true;
    ++not_finite_;
    return false;
  }
  /// May a measurement of this age leave? Counts it where not.
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
