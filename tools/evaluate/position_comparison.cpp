// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/position_comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "host/linear/dense.hpp"
#include "pharos/geometry/positive_inverse.hpp"
#include "pharos/geometry/rotation.hpp"

namespace pharos::evaluate {
namespace {

constexpr double kStationary_m = 0.01;
constexpr double kMaxTruthGap_s = 0.05;
constexpr double kNearEpoch_s = 0.05;
constexpr double kEpoch_s = 0.1;
constexpr double kBeyond_sigmas = 5.0;
constexpr std::size_t kMinCompared = 10;
// The coarse search: speeds over 0.2 s at steps of 0.05 s.
constexpr double kSpeedStep_s = 0.05, kSpeedSpan_s = 0.2, kSpeedGap_s = 0.5;
constexpr double kMaxRate = 0.02, kRateStep = 0.001;
constexpr double kMinCorrelation = 0.6, kMinOverlap = 0.4;

using Samples = std::vector<PositionSample>;

/// TRUTH's time at ESTIMATE's.
struct Clock {
  double offset_s = 0.0;
  double rate = 1.0;
  double operator()(double time_s) const { return offset_s + rate * time_s; }
};

// The line through two instants of ESTIMATE and TRUTH.
Clock clock_through(double e0, double t0, double e1, double t1) {
  const double rate = e1 > e0 ? (t1 - t0) / (e1 - e0) : 1.0;
  return {t0 - rate * e0, rate};
}

// ---- coarse: speeds of both

std::vector<double> speeds_of(const Samples& samples, double scale) {
  std::vector<double> speeds;
  const double first_s = samples.front().time_s, length_s = samples.back().time_s - first_s;
  const auto count = static_cast<std::size_t>(length_s * scale / kSpeedStep_s) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double at_s = first_s + static_cast<double>(i) * kSpeedStep_s / scale;
    const auto a = position_at(samples, at_s - 0.5 * kSpeedSpan_s / scale, kSpeedGap_s);
    const auto b = position_at(samples, at_s + 0.5 * kSpeedSpan_s / scale, kSpeedGap_s);
    speeds.push_back(a && b ? std::min(3.0, (*b - *a).norm() / kSpeedSpan_s)
                            : std::numeric_limits<double>::quiet_NaN());
  }
  return speeds;
}

std::ptrdiff_t known(const std::vector<double>& speeds) {
  return std::count_if(speeds.begin(), speeds.end(), [](double v) { return std::isfinite(v); });
}

/// -n ln(1 - c^2) of the correlation c over n steps: a short overlap that fits by chance does not win. 0 where c is
/// small.
double likelihood(const std::vector<double>& a, const std::vector<double>& b, std::ptrdiff_t lag) {
  double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(0, -lag), end = std::min(std::ssize(a), std::ssize(b) - lag);
  for (std::ptrdiff_t i = begin; i < end; ++i) {
    const double x = a[static_cast<std::size_t>(i)], y = b[static_cast<std::size_t>(i + lag)];
    if (!std::isfinite(x + y)) continue;
    n += 1, sa += x, sb += y, saa += x * x, sbb += y * y, sab += x * y;
  }
  if (n < kMinOverlap * static_cast<double>(std::min(known(a), known(b)))) return 0.0;
  const double spread = (saa - sa * sa / n) * (sbb - sb * sb / n);
  const double c = spread > 0.0 ? (sab - sa * sb / n) / std::sqrt(spread) : 0.0;
  return c > kMinCorrelation ? -n * std::log(std::max(1e-9, 1.0 - c * c)) : 0.0;
}

std::optional<Clock> coarse_clock(const Samples& estimate, const Samples& truth) {
  const std::vector<double> t = speeds_of(truth, 1.0);
  double best = 0.0;
  std::optional<Clock> clock;
  const int rates = static_cast<int>(kMaxRate / kRateStep);
  for (int k = -rates; k <= rates; ++k) {
    const double rate = 1.0 + k * kRateStep;
    const std::vector<double> e = speeds_of(estimate, rate);
    for (std::ptrdiff_t lag = -std::ssize(e); lag <= std::ssize(t); ++lag) {
      const double there = likelihood(e, t, lag);
      if (there <= best) continue;
      best = there;
      const double begin_s = truth.front().time_s + static_cast<double>(lag) * kSpeedStep_s;
      clock = Clock{begin_s - rate * estimate.front().time_s, rate};
    }
  }
  return clock;
}

// ---- fit

struct Matched {
  std::vector<const PositionSample*> estimate;
  std::vector<Vector3> truth;
};

Matched match(const std::vector<const PositionSample*>& wanted, const Samples& truth, const Clock& clock) {
  Matched out;
  for (const PositionSample* sample : wanted) {
    const auto position = position_at(truth, clock(sample->time_s), kMaxTruthGap_s);
    if (!position) continue;
    out.estimate.push_back(sample);
    out.truth.push_back(*position);
  }
  return out;
}

struct Fit {
  Matrix3 R = Matrix3::Identity();
  Vector3 t = Vector3::Zero();
  Vector3 lever = Vector3::Zero();

  Vector3 error(const PositionSample& estimate, const Vector3& truth) const {
    const Vector3 arm = estimate.R_world_body ? Vector3(*estimate.R_world_body * lever) : Vector3::Zero();
    return estimate.position_m + arm - (R * truth + t);
  }
};

void fit_world(const Matched& m, Fit& fit) {
  const double n = static_cast<double>(m.truth.size());
  Vector3 ce = Vector3::Zero(), ct = Vector3::Zero();
  std::vector<Vector3> moved;
  for (std::size_t i = 0; i < m.truth.size(); ++i) {
    const PositionSample& e = *m.estimate[i];
    moved.push_back(e.R_world_body ? Vector3(e.position_m + *e.R_world_body * fit.lever) : e.position_m);
    ce += moved.back() / n;
    ct += m.truth[i] / n;
  }
  Matrix3 H = Matrix3::Zero();
  for (std::size_t i = 0; i < moved.size(); ++i) H += (moved[i] - ce) * (m.truth[i] - ct).transpose();
  fit.R = host::nearest_rotation(H).R;
  fit.t = ce - fit.R * ct;
}

// Rotation, translation and lever arm together: Gauss-Newton.
void fit_lever(const Matched& m, Fit& fit) {
  using Vector9 = Eigen::Matrix<double, 9, 1>;
  using Matrix9 = Eigen::Matrix<double, 9, 9>;
  for (int step = 0; step < 20; ++step) {
    Matrix9 A = Matrix9::Zero();
    Vector9 b = Vector9::Zero();
    for (std::size_t i = 0; i < m.truth.size(); ++i) {
      const PositionSample& e = *m.estimate[i];
      Eigen::Matrix<double, 3, 9> J;
      const Vector3 q = fit.R * m.truth[i];
      J << skew(q), -Matrix3::Identity(), *e.R_world_body;  // of the error by rotation, translation, lever
      A += J.transpose() * J;
      b -= J.transpose() * fit.error(e, m.truth[i]);
    }
    A.diagonal().array() += 1e-9 * A.trace();
    const Vector9 d = host::dense_solve(A, b);
    fit.R = rotation_exp(d.head<3>()) * fit.R;
    fit.t += d.segment<3>(3);
    fit.lever += d.tail<3>();
    if (d.norm() < 1e-9) break;
  }
}

double mean_error(const Matched& m, const Fit& fit) {
  double sum = 0.0;
  for (std::size_t i = 0; i < m.truth.size(); ++i) sum += fit.error(*m.estimate[i], m.truth[i]).norm();
  return sum / static_cast<double>(m.truth.size());
}

/// The clock's ends by the smallest mean error: a grid, then ever smaller steps.
class ClockSearch {
 public:
  ClockSearch(const std::vector<const PositionSample*>& wanted, const Samples& truth, const Clock& start,
              double window_s)
      : wanted_(wanted), truth_(truth), start_(start), window_s_(window_s) {
    first_s_ = wanted.front()->time_s;
    last_s_ = wanted.back()->time_s;
  }

  Clock best() const {
    std::array<double, 2> at{};
    double cost = cost_of(at);
    constexpr int kGrid = 4;
    for (int i = -kGrid; i <= kGrid; ++i) {
      for (int j = -kGrid; j <= kGrid; ++j) try_at({i * window_s_ / kGrid, j * window_s_ / kGrid}, at, cost);
    }
    for (double step_s = window_s_ / kGrid; step_s > 5e-5; step_s *= 0.5) {
      bool better = true;
      while (better) {
        better = false;
        for (const auto& [a, b] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}}) {
          better = try_at({at[0] + a * step_s, at[1] + b * step_s}, at, cost) || better;
        }
      }
    }
    return clock(at);
  }

 private:
  Clock clock(const std::array<double, 2>& at) const {
    return clock_through(first_s_, start_(first_s_) + at[0], last_s_, start_(last_s_) + at[1]);
  }
  double cost_of(const std::array<double, 2>& at) const {
    const Matched m = match(wanted_, truth_, clock(at));
    if (m.truth.size() < kMinCompared) return 1e9;
    Fit fit;
    fit_world(m, fit);
    return mean_error(m, fit);
  }
  bool try_at(const std::array<double, 2>& to, std::array<double, 2>& at, double& cost) const {
    if (std::max(std::abs(to[0]), std::abs(to[1])) > window_s_ * 1.001) return false;
    const double there = cost_of(to);
    if (!(there < cost - 1e-9)) return false;
    at = to;
    cost = there;
    return true;
  }

  const std::vector<const PositionSample*>& wanted_;
  const Samples& truth_;
  Clock start_;
  double window_s_, first_s_ = 0.0, last_s_ = 0.0;
};

// ---- what is compared

std::int64_t epoch_of(double time_s) { return static_cast<std::int64_t>(std::floor(time_s / kEpoch_s)); }

std::vector<const PositionSample*> wanted_samples(const Samples& samples, const PositionOptions& options) {
  std::vector<const PositionSample*> wanted;
  if (!options.epochs_s) {
    for (const PositionSample& sample : samples) wanted.push_back(&sample);
    return wanted;
  }
  std::set<const PositionSample*> chosen;
  for (const double time_s : *options.epochs_s) {
    const auto after = std::lower_bound(samples.begin(), samples.end(), time_s,
                                        [](const PositionSample& s, double t) { return s.time_s < t; });
    const PositionSample* nearest = after != samples.end() ? &*after : &samples.back();
    if (after != samples.begin() && std::abs((after - 1)->time_s - time_s) < std::abs(nearest->time_s - time_s)) {
      nearest = &*(after - 1);
    }
    if (std::abs(nearest->time_s - time_s) <= kNearEpoch_s) chosen.insert(nearest);
  }
  return {chosen.begin(), chosen.end()};
}

// Epochs within TRUTH's time, and those of them that have a row nearby.
void count_epochs(const Samples& samples, const Samples& truth, const Clock& clock, const PositionOptions& options,
                  PositionComparison& out) {
  if (!options.epochs_s) return;
  std::set<std::int64_t> all, answered;
  for (const double time_s : *options.epochs_s) {
    if (!position_at(truth, clock(time_s), kMaxTruthGap_s)) continue;
    all.insert(epoch_of(time_s));
    const auto after = std::lower_bound(samples.begin(), samples.end(), time_s - kNearEpoch_s,
                                        [](const PositionSample& s, double t) { return s.time_s < t; });
    if (after != samples.end() && after->time_s <= time_s + kNearEpoch_s) answered.insert(epoch_of(time_s));
  }
  out.epochs = all.size();
  out.epochs_answered = answered.size();
}

double extent_of(const Samples& samples) {
  Vector3 low = samples.front().position_m, high = low;
  for (const PositionSample& s : samples) {
    low = low.cwiseMin(s.position_m);
    high = high.cwiseMax(s.position_m);
  }
  return (high - low).norm();
}

double spread_of_positions(const std::vector<const PositionSample*>& samples) {
  const double n = static_cast<double>(samples.size());
  Vector3 mean = Vector3::Zero();
  for (const PositionSample* s : samples) mean += s->position_m / n;
  double sum = 0.0;
  for (const PositionSample* s : samples) sum += (s->position_m - mean).squaredNorm();
  return std::sqrt(sum / n);
}

void fill_figures(const Matched& m, const Fit& fit, PositionComparison& out) {
  std::vector<double> norms;
  double squares = 0.0, nees = 0.0, judged = 0.0;
  for (std::size_t i = 0; i < m.truth.size(); ++i) {
    const Vector3 error = fit.error(*m.estimate[i], m.truth[i]);
    norms.push_back(error.norm());
    out.mean_m += error.norm() / static_cast<double>(m.truth.size());
    squares += error.squaredNorm();
    if (const auto square = normalised_square(*m.estimate[i], fit.lever, error)) {
      nees += *square / 3.0;
      judged += 1.0;
    }
  }
  std::sort(norms.begin(), norms.end());
  const auto quantile = [&norms](double fraction) {
    const double rank = std::ceil(fraction * static_cast<double>(norms.size()));
    return norms[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
  };
  out.compared = norms.size();
  out.rms_m = std::sqrt(squares / static_cast<double>(norms.size()));
  out.median_m = quantile(0.5);
  out.p95_m = quantile(0.95);
  out.max_m = norms.back();
  if (judged == static_cast<double>(norms.size())) out.nees_per_dof = nees / judged;
}

void count_beyond(const Samples& samples, const Samples& truth, const Clock& clock, const Fit& fit,
                  PositionComparison& out) {
  for (const PositionSample& sample : samples) {
    const auto at = position_at(truth, clock(sample.time_s), kMaxTruthGap_s);
    const auto square = at ? normalised_square(sample, fit.lever, fit.error(sample, *at)) : std::nullopt;
    if (!square) continue;
    ++out.judged;
    out.beyond_5_sigmas += *square <= kBeyond_sigmas * kBeyond_sigmas ? 0U : 1U;
  }
}

PositionComparison refused_positions(const char* word, std::string why) {
  PositionComparison out;
  out.refused = word;
  out.why = std::move(why);
  return out;
}

}  // namespace

PositionComparison compare_positions(const PositionTrack& estimate, const PositionTrack& truth,
                                     const PositionOptions& options) {
  if (estimate.samples.size() < kMinCompared) return refused_positions("refused_no_pose", "ESTIMATE has too few poses");
  if (truth.samples.size() < kMinCompared) return refused_positions("refused_no_truth", "TRUTH has too few positions");
  const std::vector<const PositionSample*> wanted = wanted_samples(estimate.samples, options);
  if (wanted.size() < kMinCompared) {
    return refused_positions("refused_too_few_poses", "fewer than 10 poses of ESTIMATE are near the epochs");
  }
  PositionComparison out;
  out.stationary = extent_of(truth.samples) < kStationary_m;
  const double t0 = truth.samples.front().time_s, t1 = truth.samples.back().time_s;
  std::optional<Clock> clock;
  if (options.marks_s) {
    clock = clock_through(options.marks_s->first, t0, options.marks_s->second, t1);
  } else if (out.stationary) {
    clock = Clock{t0 - estimate.samples.front().time_s, 1.0};
  } else {
    clock = coarse_clock(estimate.samples, truth.samples);
    if (!clock) {
      return refused_positions("refused_time_offset",
                               "the two do not move alike at any offset; give --clock-marks FIRST,LAST");
    }
  }
  // The rotor and the marks bound the clock; only a moving body tells more.
  if (!out.stationary && options.window_s > 0.0) {
    clock = ClockSearch(wanted, truth.samples, *clock, options.window_s).best();
  }
  const Matched m = match(wanted, truth.samples, *clock);
  if (m.truth.size() < kMinCompared) {
    return refused_positions("refused_no_overlap", "fewer than 10 poses of ESTIMATE fall where TRUTH knows a position");
  }
  Fit fit;
  if (out.stationary) {
    for (std::size_t i = 0; i < m.truth.size(); ++i) {
      fit.t += (m.estimate[i]->position_m - m.truth[i]) / static_cast<double>(m.truth.size());
    }
  } else {
    fit_world(m, fit);
  }
  if (options.estimate_lever_arm && !out.stationary) {
    if (!m.estimate.front()->R_world_body) {
      return refused_positions("refused_no_attitude", "a lever arm needs the attitudes of a pose table");
    }
    fit_lever(m, fit);
  }
  out.rate = clock->rate;
  out.reference_s = wanted.front()->time_s;
  out.offset_s = (*clock)(out.reference_s) - out.reference_s;
  out.R_estimate_truth = fit.R;
  out.t_estimate_truth_m = fit.t;
  out.lever_m = fit.lever;
  out.spread_m = spread_of_positions(m.estimate);
  count_epochs(estimate.samples, truth.samples, *clock, options, out);
  fill_figures(m, fit, out);
  count_beyond(estimate.samples, truth.samples, *clock, fit, out);
  return out;
}

}  // namespace pharos::evaluate
