// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/truth_log.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "host/support/input_error.hpp"

namespace pharos::sim {
namespace {

constexpr double kTruthStep_s = 0.005;

void append(std::string& text, double value, char end) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  text.push_back(end);
}

}  // namespace

TruthLog::TruthLog(PlayTruth truth) : truth_(std::move(truth)), file_(truth_.file) {
  if (!file_) throw host::InputError(truth_.file.string() + ": cannot be written");
  file_ << "utime,station,qw,qx,qy,qz,tx_m,ty_m,tz_m" << std::endl;
}

void TruthLog::start(std::int64_t utc_us, double speed) {
  start_utc_us_ = utc_us;
  speed_ = speed;
}

void TruthLog::write_until(double time_s) {
  std::string rows;
  for (; static_cast<double>(row_) * kTruthStep_s <= std::min(time_s, truth_.end_s); ++row_) {
    const double at_s = static_cast<double>(row_) * kTruthStep_s;
    const std::int64_t utime = start_utc_us_ + std::llround(at_s / speed_ * 1e6);
    for (std::size_t station = 0; station < truth_.stations; ++station) {
      const LighthouseFromBody T = truth_.at(station, at_s);
      const Quaternion q = T.quaternion();
      rows += std::to_string(utime) + "," + std::to_string(station) + ",";
      for (const double value : {q.w(), q.x(), q.y(), q.z(), T.t.x(), T.t.y()}) append(rows, value, ',');
      append(rows, T.t.z(), '\n');
    }
  }
  if (!rows.empty()) file_ << rows << std::flush;
}

}  // namespace pharos::sim
