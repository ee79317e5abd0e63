// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/source_changes.hpp"

namespace pharos::host {

bool SourceChanges::update(const RateMonitor& rate, const DeliveryAssessment& delivery, const std::string& refusal,
                           RateLimitedLog& log, std::int64_t now_ns) {
  const bool sight = sight_changed(rate, refusal, log, now_ns);
  return delivery_changed(delivery, log, now_ns) || sight;
}

bool SourceChanges::sight_changed(const RateMonitor& rate, const std::string& refusal, RateLimitedLog& log,
                                  std::int64_t now_ns) {
  const bool now = in_sight(rate, now_ns);
  if (now == in_sight_) return false;
  in_sight_ = now;
  if (now) {
    log.info("found", "FOUND: poses come", now_ns);
  } else {
    constexpr std::int64_t kNsPerMs = 1'000'000;
    const std::string wait = std::to_string(rate.absent_after_ns(first_wait_ns_) / kNsPerMs);
    log.warn("lost", "LOST: no pose for " + wait + " ms" + (refusal.empty() ? "" : " (last refusal: " + refusal + ')'),
             now_ns);
  }
  return true;
}

// While no pose comes the state is another one, and LOST was told.
bool SourceChanges::delivery_changed(const DeliveryAssessment& delivery, RateLimitedLog& log, std::int64_t now_ns) {
  if (!in_sight_ || delivery.state == last_logged_) return false;
  last_logged_ = delivery.state;
  if (delivery.state == SourceState::kOk) {
    log.info("delivery", "OK: what is expected comes again", now_ns);
  } else {
    log.warn("delivery", (delivery.state == SourceState::kError ? "ERROR: " : "DEGRADED: ") + delivery.message, now_ns);
  }
  return true;
}

}  // namespace pharos::host
