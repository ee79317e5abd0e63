// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/fusion/fusion_settings.hpp"
#include "host/mounting/source_table.hpp"
#include "pharos/fusion/target_estimator.hpp"

namespace pharos::host {

/// A source's pose on the vehicle's clock, with the directions that it did not measure. `source` is the mounting's
/// index. Times beyond 4e9 s (the year 2096) are not finite.
fusion::Measurement measurement_of(const SourceRow& row, const SourceMounting& mounting, std::uint8_t source);

/// The core's settings; throws InputError for choices and mountings that cannot be used together, and for too many.
fusion::Settings checked_settings(const std::vector<SourceMounting>& sources, const FusionChoices& choices);

/// Poses as their sources report them to one state of the target, by the mounting: the way of `pharos fuse` and of
/// pharosd.
class TargetFuser {
 public:
  /// `sources`: those of a mounting file that are fused, 1 to fusion::kMaxSources; an index below is one into this
  /// list. Throws InputError as checked_settings.
  TargetFuser(std::vector<SourceMounting> sources, const FusionChoices& choices);

  /// The first usable pose of a source also tells what its mounting's covariance leaves at the target's place.
  fusion::Outcome push(std::size_t source, const SourceRow& row);
  fusion::TargetState state(std::int64_t time_ns) const { return estimator_->state(time_ns); }
  /// Forgets the track and all times; mountings and counters stay.
  void reset() { estimator_->reset(); }

  const fusion::TargetEstimator& estimator() const { return *estimator_; }
  const std::vector<SourceMounting>& sources() const { return sources_; }
  /// Their names, in the same order.
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<SourceMounting> sources_;
  std::vector<std::string> names_;
  FusionChoices choices_;
  std::vector<bool> placed_;  // its bias is that of its first pose
  std::unique_ptr<fusion::TargetEstimator> estimator_;
};

}  // namespace pharos::host
