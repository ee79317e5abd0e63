// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/slam/body_campaign.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "host/files/atomic_file.hpp"
#include "host/vision/slam/slam_system.hpp"
#include "tools/evaluation/comparison/comparison.hpp"
#include "tools/evaluation/reproduce/slam/nees.hpp"

namespace pharos::tools {
namespace {

constexpr double kWrongLoop_deg = 3.0;

using Truth = Pose<frame::Camera, frame::Target>;

// Errors over stated sigmas, squared and summed.
struct Consistency {
  double attitude = 0.0, position = 0.0;
  int count = 0;

  // The first pair with a pose defines the frame: it has no covariance.
  void add(const slam::TrackedPose& placed, const Truth& truth) {
    if (placed.covariance.isZero()) return;
    attitude += nees_of(rotation_log(truth.R * placed.pose.R.transpose()), placed.covariance.topLeftCorner<3, 3>());
    position += nees_of(truth.t - placed.pose.t, placed.covariance.bottomRightCorner<3, 3>());
    ++count;
  }
  double root(double sum) const { return count > 0 ? std::sqrt(sum / count) : 0.0; }
};

std::vector<std::uint8_t> eight_bits(const host::GreyImage& image) {
  std::vector<std::uint8_t> out;
  out.reserve(image.pixels.size());
  for (const std::uint16_t value : image.pixels) out.push_back(static_cast<std::uint8_t>(value >> 8U));
  return out;
}

// Where the first pairs have no pose, the frame is that of the first pair with one.
Truth truth_since(const sim::BodySequence& sequence, int first, int frame) {
  return sequence.truth(frame) * sequence.truth(first).inverse() * Truth{};
}

void count_loops(const slam::SlamSystem& system, const sim::BodySequence& sequence, BodyFigures& out) {
  for (const slam::ClosedLoop& loop : system.loops()) {
    const Matrix3 R_here_there =
        sequence.truth(static_cast<int>(loop.here)).R * sequence.truth(static_cast<int>(loop.there)).R.transpose();
    const double off_deg = kDegreesPerRadian * rotation_angle_between(loop.T_here_there.R, R_here_there);
    ++(off_deg > kWrongLoop_deg ? out.loops_wrong : out.loops_right);
    out.loops_taken_back += loop.taken_back ? 1 : 0;
  }
}

// Poses of the last map.
void measure(const std::vector<slam::TrackedFrame>& frames, const sim::BodySequence& sequence, int first,
             BodyFigures& out) {
  Consistency consistency;
  double squares = 0.0;
  for (const slam::TrackedFrame& frame : frames) {
    if (!frame.placed) continue;
    const Truth truth = truth_since(sequence, first, static_cast<int>(frame.number));
    out.last_deg = kDegreesPerRadian * rotation_angle_between(frame.placed->pose.R, truth.R);
    out.largest_deg = std::max(out.largest_deg, out.last_deg);
    squares += out.last_deg * out.last_deg;
    ++out.placed;
    consistency.add(*frame.placed, truth);
  }
  if (out.placed > 0) out.rmse_deg = std::sqrt(squares / out.placed);
  out.attitude_over_sigma = consistency.root(consistency.attitude);
  out.position_over_sigma = consistency.root(consistency.position);
}

constexpr std::array kColumns{"seed",
                              "symmetric",
                              "pairs",
                              "placed",
                              "lost",
                              "ambiguous_place",
                              "rmse_deg",
                              "last_deg",
                              "largest_deg",
                              "loops_right",
                              "loops_wrong",
                              "loops_taken_back",
                              "live_attitude",
                              "live_position",
                              "attitude_over_sigma",
                              "position_over_sigma",
                              "steady_rotation"};

using Values = std::array<double, kColumns.size() - 1>;

Values values_of(const BodyFigures& f) {
  return {f.symmetric ? 1.0 : 0.0,
          static_cast<double>(f.pairs),
          static_cast<double>(f.placed),
          static_cast<double>(f.lost),
          static_cast<double>(f.ambiguous_place),
          f.rmse_deg,
          f.last_deg,
          f.largest_deg,
          static_cast<double>(f.loops_right),
          static_cast<double>(f.loops_wrong),
          static_cast<double>(f.loops_taken_back),
          f.live_attitude_over_sigma,
          f.live_position_over_sigma,
          f.attitude_over_sigma,
          f.position_over_sigma,
          f.steady_rotation ? 1.0 : 0.0};
}

bool is_count(std::size_t column) { return column < 5 || (column >= 8 && column <= 10) || column == 15; }

// The sum of a count, of another figure the largest; or the median of every column.
Values over_all(const std::vector<BodyFigures>& bodies, bool median) {
  Values out{};
  for (std::size_t k = 0; k < out.size(); ++k) {
    std::vector<double> column;
    for (const BodyFigures& body : bodies) column.push_back(values_of(body)[k]);
    std::sort(column.begin(), column.end());
    const std::size_t n = column.size();
    if (median) {
      out[k] = 0.5 * (column[(n - 1) / 2] + column[n / 2]);
    } else if (is_count(k)) {
      for (const double value : column) out[k] += value;
    } else {
      out[k] = column.back();
    }
  }
  return out;
}

// Rows as they come, or all at the end.
class BodyTable {
 public:
  BodyTable(bool markdown, const OutputOptions& options) : path_(options.path) {
    if (!markdown) output_.emplace(options, std::vector<std::string>(kColumns.begin(), kColumns.end()));
    text_ = "|";
    for (const char* column : kColumns) text_ += std::string(" ") + column + " |";
    text_ += "\n|";
    for (std::size_t k = 0; k < kColumns.size(); ++k) text_ += "---|";
    text_ += "\n";
  }
  void add(const std::string& name, const Values& values) {
    text_ += "| " + name + " |";
    for (const double value : values) text_ += " " + rounded(value) + " |";
    text_ += "\n";
    if (!output_) return;
    output_->rows().text(name);
    for (const double value : values) output_->rows().number(value);
    output_->rows().end_row();
    output_->rows().flush();
  }
  void finish() {
    if (output_) return output_->finish();
    host::write_file(path_, text_);
  }

 private:
  std::string path_, text_;
  std::optional<Output> output_;
};

}  // namespace

BodyFigures run_body(const BodyCampaign& campaign, std::uint64_t seed) {
  const sim::BodySequence sequence(campaign.scenario, seed);
  slam::SlamSettings settings;
  settings.features = campaign.features;
  const auto system = slam::make_slam(sequence.rig(), "the simulated rig", settings);
  BodyFigures out;
  out.seed = seed;
  out.symmetric = sequence.body().symmetric;
  Consistency live;
  int first = -1;
  for (int frame = 0; frame < sequence.frames(); ++frame) {
    const auto left = eight_bits(sequence.image(frame, 0)), right = eight_bits(sequence.image(frame, 1));
    const std::int32_t width = campaign.scenario.width_px, height = campaign.scenario.height_px;
    const auto placed =
        system->push(frame / campaign.scenario.rate_hz, {left.data(), width, height}, {right.data(), width, height});
    if (placed.placed && first < 0) first = frame;
    if (placed.placed) live.add(*placed.placed, truth_since(sequence, first, frame));
    if (campaign.step) campaign.step();
  }
  system->finish();
  const slam::SlamReport report = system->report();
  out.pairs = sequence.frames();
  out.lost = report.lost;
  out.ambiguous_place = report.ambiguous_place;
  out.steady_rotation = report.steady_rotation;
  out.live_attitude_over_sigma = live.root(live.attitude);
  out.live_position_over_sigma = live.root(live.position);
  measure(system->trajectory(), sequence, std::max(0, first), out);
  count_loops(*system, sequence, out);
  return out;
}

std::vector<BodyFigures> run_bodies(const BodyCampaign& campaign, bool markdown, const OutputOptions& output) {
  BodyTable table(markdown, output);
  std::vector<BodyFigures> bodies;
  for (int k = 0; k < campaign.bodies; ++k) {
    bodies.push_back(run_body(campaign, campaign.seed + static_cast<std::uint64_t>(k)));
    table.add(std::to_string(bodies.back().seed), values_of(bodies.back()));
  }
  if (!bodies.empty()) {
    table.add("all: sum or largest", over_all(bodies, false));
    table.add("median", over_all(bodies, true));
  }
  table.finish();
  return bodies;
}

}  // namespace pharos::tools
