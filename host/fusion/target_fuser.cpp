// SPDX-License-Identifier: Apache-2.0
#include "host/fusion/target_fuser.hpp"

#include <cmath>
#include <utility>

#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

constexpr double kMaxTime_s = 4e9;  // an integer of nanoseconds holds it

}  // namespace

fusion::Settings checked_settings(const std::vector<SourceMounting>& sources, const FusionChoices& choices) {
  if (sources.size() > fusion::kMaxSources) {
    throw InputError("fusion: more than " + std::to_string(fusion::kMaxSources) + " sources");
  }
  fusion::Settings settings = fusion_settings(choices);
  for (const SourceMounting& source : sources) settings.sources.push_back(source_settings(source, choices));
  const fusion::SettingsError error = fusion::check_settings(settings);
  if (error != fusion::SettingsError::kNone) throw InputError(std::string("fusion: ") + words_of(error));
  return settings;
}

fusion::Measurement measurement_of(const SourceRow& row, const SourceMounting& mounting, std::uint8_t source) {
  fusion::Measurement out;
  const double time_s = row.time_s + mounting.time_offset_s;
  out.source = source;
  out.pose = {row.pose.R, row.pose.t};
  out.covariance = row.covariance;
  out.time_sigma_s = row.time_sigma_s;
  if (!row.has_turn) out.directions = fusion::Directions::without_rotation_about(row.pose.R.col(2));
  if (row.second) out.second = fusion::SensorPose{row.second->R, row.second->t};
  if (std::abs(time_s) < kMaxTime_s) {
    out.time_ns = std::llround(time_s * 1e9);
  } else {
    out.pose.t.setConstant(std::nan(""));
  }
  return out;
}

TargetFuser::TargetFuser(std::vector<SourceMounting> sources, const FusionChoices& choices)
    : sources_(std::move(sources)),
      choices_(choices),
      placed_(sources_.size(), false),
      estimator_(std::make_unique<fusion::TargetEstimator>(checked_settings(sources_, choices_))) {
  for (const SourceMounting& source : sources_) names_.push_back(source.name);
}

fusion::Outcome TargetFuser::push(std::size_t source, const SourceRow& row) {
  const SourceMounting& mounting = sources_.at(source);
  const auto index = static_cast<std::uint8_t>(source);
  const fusion::Measurement measurement = measurement_of(row, mounting, index);
  if (!placed_[source] && fusion::check_measurement(measurement, sources_.size()) == fusion::Refusal::kNone) {
    placed_[source] = true;
    if (mounting.has_lasting_feature()) {
      estimator_->set_bias_covariance(index, source_bias(mounting, row.pose, choices_));
    }
  }
  return estimator_->push(measurement);
}

}  // namespace pharos::host
