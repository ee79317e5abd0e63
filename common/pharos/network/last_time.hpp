// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace pharos::network {

/// When something last was, or that it never was.
class LastTime {
 public:
  void set(double time_s) { time_s_ = time_s; }
  void forget() { time_s_.reset(); }
  /// Less than `span_s` before `now_s`, or later.
  bool within(double span_s, double now_s) const { return time_s_ && now_s - *time_s_ < span_s; }
  bool later_than(double time_s) const { return time_s_ && *time_s_ > time_s; }

 private:
  std::optional<double> time_s_;
};

}  // namespace pharos::network
