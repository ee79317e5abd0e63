// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/ring2/sweeps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pharos/base/units.hpp"
#include "pharos/ring2/paper_method.hpp"
#include "tools/evaluation/reproduce/ring2/centre_images.hpp"
#include "tools/evaluation/reproduce/ring2/paper_scene.hpp"
#include "tools/plot/curves.hpp"

namespace pharos::tools {
namespace {

using ring2::Scene;

constexpr double kMaxAttitude_deg = 25.0;

struct Sweep {
  const char* figure;
  const char* what;
  const char* abscissa;
  const char* published;
  std::vector<Scene> scenes;
  std::vector<double> at;

  void add(double x, const Scene& scene) {
    at.push_back(x);
    scenes.push_back(scene);
  }
};

std::vector<Sweep> sweeps_of(std::uint64_t seed) {
  std::vector<Sweep> sweeps = {{"figure 8a", "baseline 2.6 to 1.0 m", "baseline, m", "< 1", {}, {}},
                               {"figure 8b", "toe-in 30 to 0 deg", "toe-in, deg", "< 1", {}, {}},
                               {"section 3", "range 3.0 to 1.6 m", "range, m", "< 1", {}, {}},
                               {"figure 9a", "turn about Y, 0 to 5 deg", "turn about Y, deg", "< 0.5", {}, {}},
                               {"figure 9b", "turn about X, 0 to 5 deg", "turn about X, deg", "< 0.5", {}, {}},
                               {"figure 10", "both, 50 random to 5 deg", "attitude", "< 0.5", {}, {}}};
  // The rig sweeps at the attitude of figure 7.
  for (int mm = 2600; mm >= 1000; mm -= 50) {
    sweeps[0].add(mm * 1e-3, paper_scene(1.0, 1.0, kRing2Range_m, mm * 1e-3));
  }
  for (int deg = 30; deg >= 0; --deg) {
    sweeps[1].add(deg, paper_scene(1.0, 1.0, kRing2Range_m, kRing2Baseline_m, deg));
  }
  for (int mm = 3000; mm >= 1600; mm -= 50) sweeps[2].add(mm * 1e-3, paper_scene(1.0, 1.0, mm * 1e-3));
  for (int tenth = 0; tenth <= 50; ++tenth) {
    sweeps[3].add(tenth * 0.1, paper_scene(0.0, tenth * 0.1));
    sweeps[4].add(tenth * 0.1, paper_scene(tenth * 0.1, 0.0));
  }
  sim::RandomStream random(seed, "figure 10");
  for (int k = 1; k <= 50; ++k) {
    const double theta_deg = random.uniform(-5.0, 5.0);
    sweeps[5].add(k, paper_scene(theta_deg, random.uniform(-5.0, 5.0)));
  }
  return sweeps;
}

double angle_deg(const Vector3& a, const Vector3& b) { return kDegPerRad * std::atan2(a.cross(b).norm(), a.dot(b)); }

// Angles between estimated and true normal, of one scene each; without an answer not a number.
struct Errors {
  std::vector<double> paper_deg, left_deg, sizes_deg, exact_deg;
};

Errors errors_of(const std::vector<Scene>& scenes) {
  constexpr double kNoAnswer = std::numeric_limits<double>::quiet_NaN();
  Errors errors;
  for (const Scene& scene : scenes) {
    const ring2::Rig rig = ring2::core_rig(scene.rig);
    const ring2::ContourSet contours = ring2::clean_contours(scene);
    const Vector3& truth = scene.target.normal;
    const auto exact = ring2::solve_ring2(rig, contours);
    const auto paper = ring2::paper_attitudes(rig, contours);
    const auto sizes = ring2::attitude_by_one_camera(
        rig.views[0], *contours[0][0], *contours[0][1],
        {scene.target.ring_radius_m, scene.target.nozzle_radius_m, scene.target.distance_m});
    errors.paper_deg.push_back(paper ? angle_deg(ring2::normal_of(paper->both), truth) : kNoAnswer);
    errors.left_deg.push_back(paper ? angle_deg(ring2::normal_of(paper->camera[0]), truth) : kNoAnswer);
    errors.sizes_deg.push_back(sizes ? angle_deg(ring2::normal_of(*sizes), truth) : kNoAnswer);
    errors.exact_deg.push_back(exact ? angle_deg(exact->normal, truth) : kNoAnswer);
  }
  return errors;
}

bool all_answered(const std::vector<double>& errors_deg) {
  return std::all_of(errors_deg.begin(), errors_deg.end(), [](double error) { return std::isfinite(error); });
}

std::optional<double> largest(const std::vector<double>& errors_deg) {
  if (errors_deg.empty() || !all_answered(errors_deg)) return std::nullopt;
  return *std::max_element(errors_deg.begin(), errors_deg.end());
}

double sum_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum;
}

void add_rows(const Sweep& sweep, const Errors& errors, std::vector<ComparisonRow>& rows) {
  const std::string what = sweep.what;
  const auto remark = [](const std::vector<double>& all, const char* words) {
    return all_answered(all) ? std::string(words) : "some attitudes have no answer";
  };
  ComparisonRow both{sweep.figure,
                     what + ": largest error, two cameras",
                     "deg",
                     sweep.published,
                     largest(errors.exact_deg),
                     remark(errors.paper_deg, "ours: the exact solution, to rounding")};
  both.theirs = largest(errors.paper_deg);
  rows.push_back(both);
  ComparisonRow left{sweep.figure, what + ": largest error, left camera alone",
                     "deg",        "",
                     std::nullopt, remark(errors.left_deg, "the paper's steps with one camera")};
  left.theirs = largest(errors.left_deg);
  rows.push_back(left);
  ComparisonRow sizes{
      sweep.figure, what + ": largest error, one camera that knows the sizes",
      "deg",        "",
      std::nullopt, remark(errors.sizes_deg, "reference 10: ellipse's middle taken for the circle's centre")};
  sizes.theirs = largest(errors.sizes_deg);
  rows.push_back(sizes);
}

Curve curve_of(const char* name, const char* colour, const Sweep& sweep, const std::vector<double>& errors_deg) {
  Curve curve{name, colour, {}, std::string(sweep.figure) == "figure 10"};
  for (std::size_t i = 0; i < errors_deg.size(); ++i) curve.points.push_back({sweep.at[i], errors_deg[i]});
  return curve;
}

void add_picture(const Sweep& sweep, const Errors& errors, const std::filesystem::path& folder,
                 report::PartResult& result) {
  std::string file = sweep.figure;
  std::replace(file.begin(), file.end(), ' ', '_');
  file += ".svg";
  write_curves((folder / file).string(),
               {{"error of the normal, deg",
                 {curve_of("two cameras", "#3c82dc", sweep, errors.paper_deg),
                  curve_of("left alone", "#e1501e", sweep, errors.left_deg),
                  curve_of("exact", "#00a060", sweep, errors.exact_deg)}},
                {"error of the normal, one camera that knows the sizes, deg",
                 {curve_of("", "#909090", sweep, errors.sizes_deg)}}},
               sweep.abscissa);
  // The sweep over the range has no figure in the paper: it stands with those of the rig.
  const std::string label = std::string(sweep.figure).starts_with("figure") ? sweep.figure : "figure 8";
  result.pictures.push_back(
      {label, std::string(sweep.what) + ": the paper's method, its left camera alone, ours", file});
}

// How much smaller the mean error with two cameras is: of the paper's steps, and against the method with known sizes.
void add_gain(const std::string& over, const std::vector<const Errors*>& sweeps, const char* published,
              std::vector<ComparisonRow>& rows) {
  double both = 0.0, left = 0.0, sizes = 0.0;
  for (const Errors* errors : sweeps) {
    both += sum_of(errors->paper_deg);
    left += sum_of(errors->left_deg);
    sizes += sum_of(errors->sizes_deg);
  }
  ComparisonRow gain{"figure 9",   "two cameras better than one by, " + over,
                     "%",          published,
                     std::nullopt, "mean error; one: the paper's steps with the left camera"};
  gain.theirs = 100.0 * (1.0 - both / left);
  rows.push_back(gain);
  ComparisonRow known{"figure 9",   "two cameras better than one that knows the sizes by, " + over,
                      "%",          "",
                      std::nullopt, "mean error; one: reference 10"};
  known.theirs = 100.0 * (1.0 - both / sizes);
  rows.push_back(known);
}

}  // namespace

report::PartResult reproduce_ring2_sweeps(std::uint64_t seed, const std::filesystem::path& folder) {
  report::PartResult result;
  add_centre_images(result, folder);
  std::vector<Errors> turns;
  for (const Sweep& sweep : sweeps_of(seed)) {
    const Errors errors = errors_of(sweep.scenes);
    add_rows(sweep, errors, result.rows);
    if (!folder.empty()) add_picture(sweep, errors, folder, result);
    if (std::string(sweep.figure).starts_with("figure 9")) turns.push_back(errors);
  }
  add_gain("about Y", {turns.data()}, "", result.rows);
  add_gain("about X", {&turns[1]}, "", result.rows);
  add_gain("both sweeps", {turns.data(), &turns[1]}, "31.27", result.rows);
  return result;
}

report::Part ring2_part() {
  constexpr int kProblems = 400, kQuickProblems = 100;
  const auto problems = [](const report::PartSettings& settings) {
    return settings.quick ? kQuickProblems : kProblems;
  };
  return {"ring2",
          [problems](const report::PartSettings& settings) {
            return "pharos reproduce ring2 --problems " + std::to_string(problems(settings)) + " --seed " +
                   std::to_string(settings.seed);
          },
          [problems](const report::PartSettings& settings, const std::filesystem::path& folder) {
            report::PartResult result = reproduce_ring2_sweeps(settings.seed, folder);
            for (const ComparisonRow& row : reproduce_ring2_noise(problems(settings), settings.seed)) {
              result.rows.push_back(row);
            }
            return result;
          }};
}

std::vector<ComparisonRow> reproduce_ring2_noise(int problems, std::uint64_t seed) {
  std::vector<ComparisonRow> rows;
  for (const double sigma_px : {0.1, 0.5}) {
    double exact_sum = 0.0, paper_sum = 0.0, stated_sum = 0.0;
    int answered = 0;
    for (int k = 0; k < problems; ++k) {
      sim::RandomStream random(seed, "attitude " + std::to_string(k));
      const double theta_deg = random.uniform(-kMaxAttitude_deg, kMaxAttitude_deg);
      const Scene scene = paper_scene(theta_deg, random.uniform(-kMaxAttitude_deg, kMaxAttitude_deg));
      const ring2::Rig rig = ring2::core_rig(scene.rig);
      const ring2::ContourSet contours =
          ring2::noisy_contours(scene, sigma_px, seed * 1'000'003U + static_cast<std::uint64_t>(k));
      const auto exact = ring2::solve_ring2(rig, contours);
      const auto paper = ring2::solve_ring2_by_paper(rig, contours);
      if (!exact || !paper) continue;
      ++answered;
      exact_sum += std::pow(angle_deg(exact->normal, scene.target.normal), 2);
      paper_sum += std::pow(angle_deg(paper->normal, scene.target.normal), 2);
      stated_sum += std::pow(kDegPerRad * exact->sigma_normal_rad(), 2);
    }
    const std::string what = sigma_px < 0.2 ? "edges good to 0.1 px" : "edges good to 0.5 px";
    const double per_problem = answered > 0 ? 1.0 / answered : 0.0;
    ComparisonRow rms{"noise",
                      what + ": RMS",
                      "deg",
                      sigma_px < 0.2 ? "<= 0.008" : "<= 0.04",
                      std::sqrt(exact_sum * per_problem),
                      "attitudes to 25 deg, beyond the paper's; 3 m, a point a pixel; asked of ours"};
    rms.theirs = std::sqrt(paper_sum * per_problem);
    rows.push_back(rms);
    rows.push_back({"noise", what + ": ours, RMS over stated sigma", "", "1", std::sqrt(exact_sum / stated_sum), ""});
    rows.push_back({"noise", what + ": answered", "%", "", 100.0 * answered / problems, ""});
  }
  return rows;
}

}  // namespace pharos::tools
