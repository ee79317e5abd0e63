// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/bench_pose.hpp"

#include <cmath>
#include <string>

#include "tools/evaluation/bench/peer_solver.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"
#include "tools/support/stopwatch.hpp"

namespace pharos::tools {
namespace {

constexpr int kPoseRepeats = 9;
constexpr int kIterativeSensors = 6;  // OpenCV's ITERATIVE starts from DLT
constexpr std::uint64_t kPoseSeed = 1;
constexpr double kUs = 1e6;
// Units that suit the peers: in metres OpenCV's SQPNP treats the equations of so small a target as rank deficient (30 %
// wrong).
constexpr double kPeerUnitsPerMetre = 1000.0;
// A prior pose of the size of one cycle's motion: 0.3 deg and 5 mm (1 sigma an axis).
constexpr double kPriorRotation_rad = 5e-3, kPriorPosition_m = 5e-3;

struct Problem {
  test::PnpProblem pnp;
  LighthouseFromBody prior;
  Matrix6 bound;
  std::vector<double> body, tangents;
};

Problem problem_of(const Target& target, const test::PnpSet& set, test::PnpGenerator& generator) {
  Problem problem;
  problem.pnp = generator.next();
  Vector6 off;
  for (int k = 0; k < 6; ++k) off[k] = (k < 3 ? kPriorRotation_rad : kPriorPosition_m) * generator.normal();
  problem.prior = problem.pnp.truth.moved_by(off);
  problem.bound = test::bound_of(target, problem.pnp, set.sigma_rad);
  for (std::size_t k = 0; k < problem.pnp.observations.size(); ++k) {
    const pose::Observation& o = problem.pnp.observations[k];
    problem.tangents.push_back(1.0 / std::tan(o.theta_rad));
    if (o.axis == Axis::kY) continue;
    const Vector3 p = kPeerUnitsPerMetre * find_sensor(target, o.sensor)->position_m;
    problem.body.insert(problem.body.end(), {p.x(), p.y(), p.z()});
  }
  return problem;
}

// Times and errors of one solver over all problems.
struct PoseRecord {
  std::vector<double> seconds;
  test::PnpScore score;
  double median_us() const { return middle_of(seconds) * kUs; }
};

template <class Solve>
double min_seconds(Solve&& solve) {
  double minimum = 1e9;
  for (int k = 0; k < kPoseRepeats; ++k) minimum = std::min(minimum, seconds_of(solve));
  return minimum;
}

void run_ours(const Target& target, const Problem& problem, const LighthouseFromBody* prior, PoseRecord& record) {
  Result<pose::Solution, pose::Refusal> solution = pose::Refusal::kNotConverged;
  record.seconds.push_back(min_seconds([&] { solution = pose::solve(target, problem.pnp.observations, {}, prior); }));
  if (!solution.ok()) return record.score.add_refusal();
  record.score.add(problem.pnp, solution->estimate.pose, solution->estimate.ambiguous(), problem.bound);
}

void run_peer(Peer peer, const Problem& problem, PoseRecord& record) {
  std::optional<LighthouseFromBody> pose;
  record.seconds.push_back(min_seconds([&] { pose = solve_by_peer(peer, problem.body, problem.tangents); }));
  if (!pose) return record.score.add_refusal();
  pose->t /= kPeerUnitsPerMetre;
  record.score.add(problem.pnp, *pose, false, problem.bound);
}

struct Records {
  PoseRecord ours, ours_with_prior, ours_of_six, sqpnp, epnp, iterative;
};

Records run_all(int problems) {
  const Target target = test::frustum_target();
  test::PnpSet set;
  set.coplanar_views = false;
  test::PnpGenerator generator(target, set, kPoseSeed);
  Records r;
  for (int k = 0; k < problems; ++k) {
    const Problem problem = problem_of(target, set, generator);
    const bool six = static_cast<int>(problem.pnp.seen.count()) >= kIterativeSensors;
    run_ours(target, problem, nullptr, r.ours);
    run_ours(target, problem, &problem.prior, r.ours_with_prior);
    if (six) run_ours(target, problem, nullptr, r.ours_of_six);
    run_peer(Peer::kSqpnp, problem, r.sqpnp);
    run_peer(Peer::kEpnp, problem, r.epnp);
    if (six) run_peer(Peer::kIterative, problem, r.iterative);
  }
  return r;
}

}  // namespace

std::vector<BenchRow> bench_pose(int problems) {
  const Records r = run_all(problems);
  std::vector<BenchRow> rows;
  const auto add = [&](const std::string& what, double ours, const PoseRecord& peer, double theirs, const char* unit) {
    rows.push_back({what, ours, peer.seconds.empty() ? std::nullopt : std::optional<double>(theirs), unit, true});
  };
  const auto add_time = [&](const std::string& what, const PoseRecord& ours, const PoseRecord& peer) {
    add(what, ours.median_us(), peer, peer.median_us(), "us");
  };
  add_time("pose from nothing / OpenCV SQPNP", r.ours, r.sqpnp);
  add_time("pose with a prior / OpenCV SQPNP", r.ours_with_prior, r.sqpnp);
  add_time("pose from nothing / OpenCV EPNP", r.ours, r.epnp);
  add_time("pose from nothing, >= 6 sensors / OpenCV ITERATIVE", r.ours_of_six, r.iterative);
  add("rotation x CRB / OpenCV SQPNP", r.ours.score.rotation_over_bound(), r.sqpnp, r.sqpnp.score.rotation_over_bound(),
      "");
  add("position x CRB / OpenCV SQPNP", r.ours.score.position_over_bound(), r.sqpnp, r.sqpnp.score.position_over_bound(),
      "");
  const auto add_failures = [&](const std::string& what, const PoseRecord& ours, const PoseRecord& peer) {
    const auto fraction = [](const PoseRecord& record) {
      return 100.0 * (record.score.failures + record.score.refused) / std::max(1, record.score.problems);
    };
    add(what, fraction(ours), peer, fraction(peer), "%");
  };
  add_failures("failures (> 10 deg) / OpenCV SQPNP", r.ours, r.sqpnp);
  add_failures("failures (> 10 deg) / OpenCV EPNP", r.ours, r.epnp);
  add_failures("failures (> 10 deg), >= 6 sensors / OpenCV ITERATIVE", r.ours_of_six, r.iterative);
  return rows;
}

}  // namespace pharos::tools
