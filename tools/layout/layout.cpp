// SPDX-License-Identifier: Apache-2.0
// pharos layout: sensor positions on a body (002, section 3.3: precision factors guide the layout).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <memory>

#include "host/support/input_error.hpp"
#include "host/table/pose_table.hpp"
#include "host/table/target_file.hpp"
#include "pharos/base/units.hpp"
#include "pharos/pose/precision.hpp"
#include "tools/layout/layout_plot.hpp"
#include "tools/layout/layout_search.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/picture_kind.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/seed_option.hpp"
#include "tools/support/standard_input.hpp"

namespace pharos::tools {
namespace {

using layout::Objective;

constexpr const char* kExample =
    "Example:\n"
    "  pharos layout --body target12.off --sensors 12 --poses manoeuvre_poses.csv --target target12.csv \\\n"
    "    --output better.csv --plot better.svg\n"
    "Minimises W ADOP/ADOP0 + (1 - W) PDOP/PDOP0 over the poses, W being --attitude-weight and 0 the present layout\n"
    "(--target) or, without one, sensors spread evenly. BODY is a closed convex polyhedron in metres (OFF); its faces\n"
    "give the sensors' normals, and being convex it casts no shadow on a sensor that faces the station.";

// Layouts are evaluated at this many of the poses, distributed over the file; at all of them where single poses decide.
constexpr std::size_t kMaxPoses = 400;

struct Options {
  std::string body;
  std::string poses;
  std::string present;
  std::string target;
  std::string plot;
  std::string objective = "mean";
  double attitude_weight = 0.5;
  double incidence_deg = pose::kVisibleIncidence_rad * kDegPerRad;
  double rho = 0.0;
  double spacing_mm = 12.0;
  double edge_mm = 3.0;
  int sensors = 0;
  int starts = 3;
  std::uint64_t seed = 1;
  bool json = false;

  layout::Sight sight() const { return {incidence_deg * kRadPerDeg, rho}; }
  layout::Rules rules() const { return {static_cast<std::size_t>(sensors), spacing_mm / kMmPerM, edge_mm / kMmPerM}; }
};

const std::vector<std::string> kColumns = {"objective",
                                           "sensors",
                                           "poses",
                                           "measured",
                                           "compared",
                                           "adop_deg_per_rad",
                                           "pdop_m_per_rad",
                                           "present_measured",
                                           "present_adop_deg_per_rad",
                                           "present_pdop_m_per_rad",
                                           "gain_adop_percent",
                                           "gain_pdop_percent",
                                           "status"};

std::optional<Objective> parsed_objective(const std::string& text) {
  if (text == "mean") return Objective{Objective::Kind::kMean, 0.0};
  if (text == "worst") return Objective{Objective::Kind::kWorst, 0.0};
  constexpr std::string_view kPercentile = "percentile:";
  if (!text.starts_with(kPercentile)) return std::nullopt;
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + kPercentile.size(), end, value);
  if (error != std::errc{} || stop != end || !(value > 0.0 && value <= 100.0)) return std::nullopt;
  return Objective{Objective::Kind::kPercentile, value};
}

std::vector<LighthouseFromBody> poses_in(const std::string& path) {
  std::vector<LighthouseFromBody> poses;
  for (const host::PoseRow& row : host::read_poses(path, "pose")) {
    if (row.T_lighthouse_body) poses.push_back(*row.T_lighthouse_body);
  }
  return poses;
}

std::vector<LighthouseFromBody> some(const std::vector<LighthouseFromBody>& poses, const Objective& objective) {
  if (objective.kind != Objective::Kind::kMean || poses.size() <= kMaxPoses) return poses;
  std::vector<LighthouseFromBody> chosen;
  for (std::size_t i = 0; i < kMaxPoses; ++i) chosen.push_back(poses[i * poses.size() / kMaxPoses]);
  return chosen;
}

/// Poses from which a sensor on some face of the body would be seen.
std::vector<LighthouseFromBody> visible_ones(const layout::ConvexBody& body, const Options& options) {
  const std::vector<LighthouseFromBody> all = poses_in(options.poses);
  std::vector<LighthouseFromBody> visible;
  std::copy_if(all.begin(), all.end(), std::back_inserter(visible), [&](const LighthouseFromBody& pose) {
    return !layout::seen_facets(body, {pose}, options.sight().incidence_rad).empty();
  });
  if (all.empty()) {
    note(options.poses + ": no pose in the table");
  } else if (visible.empty()) {
    note(options.poses + ": no face of the body is seen at any pose; is T_lighthouse_body given, z ahead?");
  } else if (visible.size() < all.size()) {
    note(options.poses + ": " + std::to_string(all.size() - visible.size()) + " of " + std::to_string(all.size()) +
         " poses show no face of the body; they are left out");
  }
  return visible;
}

layout::Assessed assessed(const Target& target, const std::vector<LighthouseFromBody>& poses, const Options& options) {
  return {target, layout::dops_of(target, poses, options.sight())};
}

/// Only poses that both measure, so that a layout is not rated worse for covering more.
layout::Dops where_both(const layout::Dops& dops, const layout::Dops& other) {
  layout::Dops both = dops;
  for (std::size_t i = 0; i < both.size(); ++i) {
    if (!other[i]) both[i].reset();
  }
  return both;
}

void write_target(const std::string& path, const Target& target) {
  Output output({false, path}, {"sensor", "x_m", "y_m", "z_m", "nx", "ny", "nz"});
  for (const SensorPlacement& s : target) {
    output.rows().integer(s.sensor);
    for (const Vector3& v : {s.position_m, s.normal}) output.rows().number(v.x()).number(v.y()).number(v.z());
    output.rows().end_row();
  }
  output.finish();
}

void write_gain(const Options& options, const Objective& objective, std::size_t poses, const layout::Assessed& found,
                const std::optional<layout::Assessed>& present) {
  Output output({options.json, "-"}, kColumns);
  host::RowWriter& rows = output.rows();
  const layout::Dops& other = present ? present->dops : found.dops;
  const layout::Score ours = layout::score_of(where_both(found.dops, other), objective);
  rows.text(options.objective).integer(options.sensors).integer(static_cast<std::int64_t>(poses));
  rows.integer(static_cast<std::int64_t>(layout::score_of(found.dops, objective).measured));
  rows.integer(static_cast<std::int64_t>(ours.measured));
  rows.number(ours.adop_deg_per_rad).number(ours.pdop_m_per_rad);
  if (present) {
    const layout::Score other_score = layout::score_of(where_both(other, found.dops), objective);
    rows.integer(static_cast<std::int64_t>(layout::score_of(present->dops, objective).measured));
    rows.number(other_score.adop_deg_per_rad).number(other_score.pdop_m_per_rad);
    rows.number(100.0 * (1.0 - ours.adop_deg_per_rad / other_score.adop_deg_per_rad));
    rows.number(100.0 * (1.0 - ours.pdop_m_per_rad / other_score.pdop_m_per_rad));
  } else {
    rows.none(5);
  }
  rows.text("ok").end_row();
  output.finish();
}

void check(const Options& options) {
  require_one_standard_input({{"--body", options.body}, {"--poses", options.poses}, {"--target", options.present}});
  if (options.target == "-") throw host::InputError("--output must be a file; the gain goes to standard output");
  require_writable(options.target);
  if (!options.plot.empty()) require_writable(options.plot);
}

/// The reference layout: the present one or sensors distributed evenly.
layout::Score reference_of(const Target& spread, const std::optional<layout::Assessed>& present,
                           const std::vector<LighthouseFromBody>& poses, const Options& options,
                           const Objective& objective) {
  if (present) {
    const layout::Score score = layout::score_of(present->dops, objective);
    if (score.measured > 0) return score;
  }
  return layout::score_of(layout::dops_of(spread, poses, options.sight()), objective);
}

int run(const Options& options) {
  check(options);
  const Objective objective = *parsed_objective(options.objective);
  const layout::ConvexBody body = layout::read_body(options.body);
  std::optional<layout::Assessed> present;
  const std::vector<LighthouseFromBody> poses = visible_ones(body, options);
  if (poses.empty()) return kExitNoAnswer;
  if (!options.present.empty()) present = assessed(host::read_target(options.present).target, poses, options);
  const layout::LayoutSearch search(body, layout::seen_facets(body, poses, options.sight().incidence_rad),
                                    options.rules(), options.seed);
  const std::optional<layout::MountPoints> spread = search.spread();
  if (!spread) {
    note(options.body + ": no room for " + std::to_string(options.sensors) +
         " sensors on the faces that are seen; lower --sensors, --spacing-mm or --edge-mm");
    return kExitNoAnswer;
  }
  const layout::Score reference = reference_of(layout::target_of(body, *spread), present, poses, options, objective);
  if (reference.measured == 0) {
    note(options.poses + ": at no pose are three sensors seen, however they are spread; give more --sensors");
    return kExitNoAnswer;
  }
  layout::MountPoints best;
  {
    Progress progress("layout", "rounds of moves");
    const layout::LayoutEvaluator evaluator(some(poses, objective), options.sight(), objective, options.attitude_weight,
                                            reference);
    best = search.best(evaluator, options.starts, [&progress] { progress.step(); });
  }
  const layout::Assessed found = assessed(layout::target_of(body, best), poses, options);
  write_target(options.target, found.target);
  if (!options.plot.empty()) layout::plot_layout(options.plot, body, poses, found, present);
  write_gain(options, objective, poses.size(), found, present);
  return kExitAnswered;
}

void add_options(CLI::App& command, Options& options) {
  command.add_option("--body", options.body, "Closed convex polyhedron, OFF, metres; .gz; - is standard input")
      ->required();
  command.add_option("--sensors", options.sensors, "How many")
      ->required()
      ->check(number_from(4, static_cast<double>(kMaxSensors)));
  command.add_option("--poses", options.poses, "Table pose,qw,qx,qy,qz,tx_m,ty_m,tz_m (T_lighthouse_body)")->required();
  command.add_option("-o,--output", options.target, "File for the target found, sensor,x_m,y_m,z_m,nx,ny,nz")
      ->check(output_place())
      ->required();
  command.add_option("--target", options.present, "The present layout, to compare with");
  command.add_option("--objective", options.objective, "Over the poses: mean, worst or percentile:P")
      ->check(CLI::Validator(
          [](const std::string& text) {
            return parsed_objective(text) ? std::string() : text + " is none of mean, worst, percentile:P (P to 100)";
          },
          "", "objective"))
      ->capture_default_str();
  command.add_option("--attitude-weight", options.attitude_weight, "Weight of ADOP against PDOP")
      ->check(number_from(0.0, 1.0))
      ->capture_default_str();
  command.add_option("--incidence-deg", options.incidence_deg, "A sensor sees light up to this far off its normal")
      ->check(number_from(5.0, 89.0))
      ->capture_default_str();
  command.add_option("--rho", options.rho, "Correlation of bearings within a rotor")
      ->check(number_from(0.0, 0.999))
      ->capture_default_str();
  command.add_option("--spacing-mm", options.spacing_mm, "Least distance between sensors")
      ->check(number_from(0.5, 1000.0))
      ->capture_default_str();
  command.add_option("--edge-mm", options.edge_mm, "Least distance of a sensor from the edges of its face")
      ->check(number_from(0.0, 1000.0))
      ->capture_default_str();
  command.add_option("--starts", options.starts, "Layouts to start from; the best one counts")
      ->check(number_from(1, 100))
      ->capture_default_str();
  add_seed_option(command, options.seed, "Of the starts but the first");
  command.add_option("--plot", options.plot, "File for a picture (SVG) of layout and precision")
      ->check(output_place())
      ->check(picture_kind(".svg"));
  command.add_flag("--json", options.json, "The gain as one JSON object instead of CSV");
}

}  // namespace

void add_layout(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("layout", "Where sensors should sit on a body, for the best precision");
  const auto options = std::make_shared<Options>();
  add_options(*command, *options);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
