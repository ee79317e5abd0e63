// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/stereo/slam_estimator.hpp"

#include <array>

#include "host/preview/slam_drawing.hpp"
#include "host/runtime/now.hpp"
#include "host/support/flag_text.hpp"
#include "host/support/input_error.hpp"
#include "host/support/time_units.hpp"

namespace pharos::host {
namespace {

enum SlamFlag : std::uint8_t {
  kMapStart = 1,     // poses are relative to this pair's
  kRelocalised = 2,  // relocalised after it was lost
};
constexpr std::array<FlagWord, 2> kSlamFlagWords{{{kMapStart, "map_start"}, {kRelocalised, "relocalised"}}};

constexpr std::int64_t kFiguresEvery_ns = 1'000'000'000;  // computing them needs a lock and a sort

std::optional<enhance::EnhanceSettings> settings_of(LowLight light) {
  if (light == LowLight::kOff) return std::nullopt;
  enhance::EnhanceSettings settings;
  if (light == LowLight::kFast) settings.denoiser = enhance::Denoiser::kFast;
  if (light == LowLight::kNotDenoised) settings.denoiser = enhance::Denoiser::kNone;
  settings.bm3d = enhance::kVideoBm3d;
  return settings;
}

}  // namespace

SlamEstimator::SlamEstimator(const StereoConfig& config)
    : rig_(config.rig),
      rig_name_(config.rig_file.string()),
      focal_px_(0.5 * (rig_.left.intrinsics.fx_px + rig_.right.intrinsics.fx_px)),
      settings_(config.slam->settings),
      eight_bits_(settings_of(config.slam->enhance)) {
  begin();
}

void SlamEstimator::begin() {
  system_ = slam::make_slam(rig_, rig_name_, settings_);
  spin_.clear();
  map_started_ = false;
  ++maps_;
}

PairResult SlamEstimator::measure(const StereoPair& pair) {
  PairResult answer;
  SlamPoseEstimate estimate;
  answer.pose = estimate;
  if (!began_ns_) began_ns_ = pair.steady_ns;
  const double time_s = static_cast<double>(pair.steady_ns - *began_ns_) / static_cast<double>(kNsPerSecond);
  const std::int64_t start_ns = monotonic_now_ns();
  const auto [left, right] = eight_bits_.both(pair.frames[0]->intensity_view(), pair.frames[1]->intensity_view());
  const std::int64_t lit_ns = monotonic_now_ns();
  try {
    const slam::TrackedFrame frame = system_->push(time_s, left, right);
    if (pair.with_pictures) {
      answer.pictures.push_back(annotated_image(system_->last_image(), slam_drawing(*system_), "left"));
    }
    answer.observations = frame.inliers;
    answer.spin = spin_.push(frame);
    if (frame.placed) {
      estimate.pose = frame.placed->pose;
      estimate.covariance = frame.placed->covariance;
      estimate.residual_rms = frame.placed->rms_px / focal_px_;
      estimate.observations = frame.inliers;
      answer.pose = estimate;
      answer.flags =
          joined_flags((map_started_ ? 0 : kMapStart) | (frame.relocalised ? kRelocalised : 0), kSlamFlagWords);
      map_started_ = true;
    } else if (frame.ambiguous_place) {
      answer.refusal = "ambiguous_place";
      answer.advice = "a known view that the motion rules out, or that two parts of the target share";
    } else if (frame.lost) {
      answer.refusal = "lost";
      answer.advice = "tracking is lost; looking for known views";
    } else {
      answer.refusal = "no_map";
      answer.advice = "too few features for a first map: is the target lit, and in both images?";
    }
  } catch (const InputError& error) {
    answer.refusal = "no_pair";
    answer.advice = error.what();
    begin();
  } catch (...) {
    begin();  // the map may be inconsistent
    throw;
  }
  answer.stages = {{"light", lit_ns - start_ns}, {"tracking", monotonic_now_ns() - lit_ns}};
  add_figures(answer);
  return answer;
}

void SlamEstimator::add_figures(PairResult& answer) {
  const std::int64_t now_ns = monotonic_now_ns();
  if (now_ns - last_figures_ns_ < kFiguresEvery_ns) return;
  last_figures_ns_ = now_ns;
  const slam::SlamReport report = system_->report();
  answer.figures = {{"slam.maps", maps_},
                    {"slam.keyframes", report.keyframes},
                    {"slam.points", report.points},
                    {"slam.loops", report.loops},
                    {"slam.loops_refused", report.loops_refused},
                    {"slam.loops_taken_back", report.loop_candidates.taken_back},
                    {"slam.relocalised", report.relocalised},
                    {"slam.frames_dark", report.dark},
                    {"slam.frames_saturated", report.saturated},
                    {"slam.frames_repeated", report.repeated}};
}

}  // namespace pharos::host
