// SPDX-License-Identifier: Apache-2.0
// Instructions a pose, from the last one and from nothing, and the difference of the result from the host's.
#include <cmath>

#include "firmware/bench/report.hpp"
#include "firmware/board/rv32/stack_mark.hpp"
#include "pharos/pose/solve.hpp"
#include "pharos/pose/warm.hpp"

namespace {

using namespace pharos;  // NOLINT: a program of one page
using bench::Counts;

LighthouseFromBody pose_of(const bench::PoseRow& row) {
  LighthouseFromBody pose;
  for (int i = 0; i < 9; ++i) pose.R(i / 3, i % 3) = row.rotation[static_cast<std::size_t>(i)];
  for (int i = 0; i < 3; ++i) pose.t[i] = row.position_m[static_cast<std::size_t>(i)];
  return pose;
}

double sigmas_between(const LighthouseFromBody& pose, const bench::ProblemHeader& problem) {
  const Vector6 d = pose_difference(pose, pose_of(problem.host));
  const Eigen::Map<const Matrix6> information(problem.host_information.data());
  return std::sqrt(d.dot(information * d));
}

struct Measured {
  Counts warm, nothing;
  double farthest_sigma = 0.0;
  std::uint32_t not_in_integers = 0, refused = 0, other_flags = 0;
};
Measured measured;

void solve_one(const Target& target, const bench::ProblemHeader& problem, const pose::Observations& observations,
               const pose::SolveOptions& options) {
  const LighthouseFromBody prior = pose_of(problem.prior);
  std::optional<pose::Solution> solution;
  std::uint32_t count =
      bench::instructions_of([&] { solution = pose::solve_warm(target, observations, options, prior); });
  if (!solution) {
    ++measured.not_in_integers;
    Result<pose::Solution, pose::Refusal> full = pose::Refusal::kNotConverged;
    count += bench::instructions_of([&] { full = pose::solve(target, observations, options, &prior); });
    if (full) solution = *full;
  }
  measured.warm.add(count);
  if (!solution) {
    ++measured.refused;
    return;
  }
  measured.farthest_sigma = std::fmax(measured.farthest_sigma, sigmas_between(solution->estimate.pose, problem));
  measured.other_flags += solution->estimate.ambiguous() != (problem.host_ambiguous != 0) ? 1U : 0U;
}

}  // namespace

int main() {
  bench::Input input;
  const auto& header = input.header<bench::PoseHeader>();
  static Target target;
  for (std::uint32_t k = 0; k < header.sensors; ++k) {
    const auto& row = input.next<bench::SensorRow>();
    target.push_back(
        {static_cast<std::uint8_t>(row.sensor), {row.position_m[0], row.position_m[1], row.position_m[2]}, {}});
  }
  pose::SolveOptions options;
  options.sigma_rad = header.sigma_rad;
  static pose::Observations observations;
  for (std::uint32_t k = 0; k < header.problems; ++k) {
    const auto& problem = input.next<bench::ProblemHeader>();
    observations.clear();
    for (std::uint64_t i = 0; i < problem.observations; ++i) {
      const auto& row = input.next<bench::ObservationRow>();
      observations.push_back({static_cast<std::uint8_t>(row.sensor_axis / 2),
                              row.sensor_axis % 2 == 0 ? Axis::kX : Axis::kY, row.theta_rad});
    }
    solve_one(target, problem, observations, options);
    if (k + 1 == header.problems - header.from_nothing) {
      bench::say("stack_of_integers", board::stack_bytes() - board::stack_never_used_bytes());
    }
    if (k + header.from_nothing < header.problems) continue;
    Result<pose::Solution, pose::Refusal> full = pose::Refusal::kNotConverged;
    measured.nothing.add(bench::instructions_of([&] { full = pose::solve(target, observations, options); }));
  }
  bench::say("warm", measured.warm);
  bench::say("nothing", measured.nothing);
  bench::say("farthest_sigma_millionths", static_cast<std::int64_t>(measured.farthest_sigma * 1e6));
  bench::say("not_in_integers", measured.not_in_integers);
  bench::say("refused", measured.refused);
  bench::say("other_flags", measured.other_flags);
  bench::say("stack", board::stack_bytes() - board::stack_never_used_bytes());
  return 0;
}
