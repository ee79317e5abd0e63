// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "host/mounting/mounting.hpp"
#include "pharos/fusion/settings.hpp"

namespace pharos::host {

/// What a user says of the fusion: options of `pharos fuse`, keys of `[vehicle]`.
struct FusionChoices {
  std::string motion = "free";  // one of kMotionWords
  double mean_motion_rad_s = 0.0011;
  std::array<double, 3> inertia{1.0, 1.0, 1.0};
  double acceleration_density = 1e-6;
  double angular_acceleration_density = 1e-8;
  double bias_deg = 0.05;  // of a source whose mounting file states no slow_error, beside its mounting
  double bias_mm = 1.0;
  double bias_time_s = 60.0;
  double risk_per_hour = 1e-5;
  double faults_per_hour = 1e-3;  // of each kind and source
};

inline constexpr std::array<const char*, 4> kMotionWords = {"free", "orbit", "tumbling", "tumbling_orbit"};

/// Ranges of the choices, for every place where they are read.
struct ChoiceRange {
  double min = 0.0;
  double max = 0.0;
};
inline constexpr ChoiceRange kMeanMotionRange{1e-6, 0.01};
inline constexpr ChoiceRange kPositiveRange{1e-15, 1e6};  // densities, moments of inertia, time constants
inline constexpr ChoiceRange kBiasDegRange{1e-6, 90.0};
inline constexpr ChoiceRange kBiasMmRange{1e-6, 1e5};
inline constexpr ChoiceRange kRiskRange{1e-12, 0.1};
inline constexpr ChoiceRange kFaultsRange{0.0, 1e3};

/// Settings without sources.
fusion::Settings fusion_settings(const FusionChoices& choices);

/// One source of the mounting file. Its bias is the source's own: what the file states as slow_error, otherwise the
/// choices. A feature that is unknown, or of a former start (slam), makes it a relative
/// source.
fusion::SourceSettings source_settings(const SourceMounting& mounting, const FusionChoices& choices);

/// The bias of a source whose feature is known: its own, and what the mounting's covariance leaves at `first`, a pose
/// as the source reports it.
Matrix6 source_bias(const SourceMounting& mounting, const SensorFromFeature& first, const FusionChoices& choices);

/// What is wrong with settings, for a user; kNone is none.
const char* words_of(fusion::SettingsError error);

}  // namespace pharos::host
