// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/daemon/stereo/pair_source.hpp"
#include "host/device/pair_names.hpp"
#include "host/runtime/clock.hpp"
#include "host/runtime/timer.hpp"

namespace pharos::host {

/// Recorded pairs in their order, at the rate of their times, once. A pair whose name is a time (ns since 1970) has
/// that time; otherwise times begin at the start of the replay. A pair with a file that cannot be read, or that has
/// another size than the rig's camera, is counted and skipped.
class RecordedPairs : public PairSource {
 public:
  struct Options {
    double rate_hz = 20.0;  ///< if names are not times
    /// Gives the next pair as soon as the one before was processed, without waiting.
    bool fastest = false;
    std::array<std::array<std::int32_t, 2>, 2> sizes_px{};  ///< width, height of left and right
  };
  /// `clock` must outlive this. Throws InputError if there are no pairs.
  RecordedPairs(const Clock& clock, const std::string& directory, const Options& options);

  std::vector<int> fds() const override { return {timer_.fd()}; }
  StereoPairPtr take() override;
  void recycle(StereoPairPtr pair) override;
  PairSourceStatus status() const override;
  std::string device() const override { return path_; }
  std::string clock_notice(std::int64_t) const override { return {}; }

  /// Longer silences of the recording are cut to this.
  static constexpr std::int64_t kLongestSilence_ns = 10'000'000'000;

 private:
  void arm();
  bool read(const PairName& name, StereoPair& pair);
  std::int64_t time_ns(std::size_t index) const;

  const Clock& clock_;
  std::string path_;
  Options options_;
  std::vector<PairName> pairs_;
  Timer timer_;
  std::size_t next_ = 0;
  std::int64_t began_utc_ns_ = 0;
  std::int64_t due_monotonic_ns_ = 0;
  std::int64_t pairs_read_ = 0;
  std::int64_t pairs_unreadable_ = 0;
  std::string error_, remark_;
  bool finished_ = false;
};

}  // namespace pharos::host
