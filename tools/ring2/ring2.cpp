// SPDX-License-Identifier: Apache-2.0
// pharos circles: ring and nozzle of a satellite from two views.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <string_view>

#include "host/cameras/docking_target.hpp"
#include "host/cameras/pair_order.hpp"
#include "host/cameras/rig_file.hpp"
#include "host/device/pair_names.hpp"
#include "host/support/input_error.hpp"
#include "host/vision/ring2/ring2_rig.hpp"
#include "pharos/ring2/paper_method.hpp"
#include "tools/ring2/ellipse_table.hpp"
#include "tools/ring2/overlay.hpp"
#include "tools/ring2/ring2_rows.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/image_input.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/picture_kind.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/stopwatch.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Example:\n"
    "  pharos circles left.png right.png --rig rig.toml --overlay found.png\n"
    "  pharos circles left.png right.png --rig rig.toml --target target.toml\n"
    "  pharos circles --ellipses ellipses.csv --rig rig.toml --method paper\n"
    "  pharos circles pairs --rig rig.toml > poses.csv\n"
    "Rig frame: x right, y down, z ahead. n = Rx(theta) Ry(gamma) (0, 0, -1) points from the ring towards the "
    "cameras;\n"
    "c is the ring's centre, the nozzle's is c + distance n. Neither radii nor distance need be known. --ellipses "
    "takes\n"
    "[problem,]view,feature,cx_px,cy_px,a_px,b_px,theta_rad[,sigma_px,points]: view left or right, feature ring or\n"
    "nozzle, sigma_px of one edge point (0.1) and how many there are (one a pixel of contour); one ellipse of four "
    "may\n"
    "be missing, more where the rest can tell: `untold` says what they cannot. --method paper is paper 001 as "
    "published.\n"
    "--covariance: of T_rig_target, origin at the ring's centre, Z' = n; the turn about n is not measured: its "
    "variance "
    "is\n"
    "that of a uniform angle, pi^2/3 rad^2. Empty with --method paper, and where the position is not told. --format "
    "tum: "
    "the\n"
    "same pose with X' nearest the rig's x axis; time_s is the problem's number.";

struct Options {
  std::vector<std::string> images;
  std::string rig;
  std::string ellipses;
  std::string method = "exact";
  std::string overlay;
  std::string target;
  int repeats = 0;
  OutputOptions output;
};

// What a target description says of ring and nozzle.
host::RingSizes sizes_of(const std::string& path) {
  if (path.empty()) return {};
  const host::DockingTarget file = host::read_docking_target(path);
  const auto known = [](const std::optional<host::StatedLength>& length) {
    return length ? std::optional(host::KnownLength{length->value_m, length->sigma_m}) : std::nullopt;
  };
  return {known(file.outer_radius), known(file.inner_radius), known(file.exit_radius), known(file.nozzle_distance)};
}

using Solved = Result<ring2::Ring2Estimate, ring2::Ring2Failure>;

Solved solved(const ring2::Rig& rig, const ring2::ContourSet& contours, bool by_paper) {
  return by_paper ? ring2::solve_ring2_by_paper(rig, contours) : ring2::solve_ring2(rig, contours);
}

bool write(const Solved& estimate, const Ring2Row& row, host::RowWriter& rows) {
  if (estimate) {
    write_ring2(*estimate, row, rows);
  } else {
    write_refusal(name_of(estimate.error()), rows);
  }
  return estimate.ok();
}

// The problem's number where it has one, otherwise its place.
double time_of(const EllipseProblem& problem, std::size_t place) {
  std::uint64_t number = 0;
  const char* const end = problem.name.data() + problem.name.size();
  const auto [stop, error] = std::from_chars(problem.name.data(), end, number);
  return static_cast<double>(error == std::errc{} && stop == end ? number : place);
}

// No pair of images tells the turn: a line of TUM holds a conventional one.
void note_turn(const Options& options) {
  if (options.output.row_format() != host::RowFormat::kTum) return;
  note("the turn about the ring's axis is not measured; the quaternions' is such that X' is nearest the rig's x axis");
}

void print_time(const char* what, const Options& options, const std::function<void()>& work) {
  std::vector<double> times_s;
  for (int k = 0; k < options.repeats; ++k) times_s.push_back(seconds_of(work));
  if (!times_s.empty()) {
    std::fprintf(stderr, "%s: median %.3f ms (%d times)\n", what, 1e3 * middle_of(times_s), options.repeats);
  }
}

bool from_table(const ring2::Rig& rig, const Options& options) {
  const EllipseTable table = read_ellipse_table(host::ByteSource(options.ellipses));
  if (table.problems.empty()) throw host::InputError(options.ellipses + ": no row; give at least two ellipses");
  Output output(options.output, ring2_columns(table.has_problems));
  const bool by_paper = options.method == "paper";
  bool answered = false;
  std::string refusal;  // the last one
  for (const EllipseProblem& problem : table.problems) {
    if (table.has_problems) output.rows().text(problem.name);
    const Solved estimate = solved(rig, problem.contours, by_paper);
    if (!estimate) refusal = name_of(estimate.error());
    const auto place = static_cast<std::size_t>(&problem - table.problems.data());
    answered = write(estimate, {by_paper, 0, time_of(problem, place)}, output.rows()) || answered;
  }
  output.finish();
  if (answered) note_turn(options);
  if (!answered) {
    const std::size_t count = table.problems.size();
    note(options.ellipses + ": " +
         (count > 1 ? "none of " + std::to_string(count) + " has an answer; the last: " : "") + refusal_text(refusal));
  }
  print_time("all problems", options, [&] {
    for (const EllipseProblem& problem : table.problems) static_cast<void>(solved(rig, problem.contours, by_paper));
  });
  return answered;
}

// Whether the images show more of ring and nozzle, and fit, when they are taken for each other's: a rig whose cameras
// look towards each other also sees a smaller or larger circle in images that were exchanged.
bool better_exchanged(host::Ring2Detector& finder, const host::Ring2Detection& given, const host::Ring2Images& images) {
  if (given.refusal == name_of(ring2::Ring2Failure::kExchanged)) return true;
  const host::Ring2Detection exchanged = finder.find({images[1], images[0]});
  if (!exchanged.estimate) return false;
  return !given.estimate || exchanged.estimate->ellipses > given.estimate->ellipses;
}

void solve_again_by_paper(const ring2::Rig& rig, host::Ring2Detection& circles) {
  if (!circles.estimate) return;
  const Solved estimate = solved(rig, circles.contours, true);
  circles.estimate = estimate ? std::optional(*estimate) : std::nullopt;
  if (!estimate) circles.refusal = name_of(estimate.error());
}

void write_detection(const host::Ring2Detection& circles, const Ring2Row& row, host::RowWriter& rows) {
  if (circles.estimate) {
    write_ring2(*circles.estimate, row, rows);
  } else {
    write_refusal(circles.refusal, rows);
  }
}

// Of both images: the left one's without its side.
std::string name_of(const host::PairName& pair) {
  constexpr std::string_view kLeft = "_left";
  return pair.stem.ends_with(kLeft) ? pair.stem.substr(0, pair.stem.size() - kLeft.size()) : pair.stem;
}

bool are_folders(const Options& options) {
  return std::all_of(options.images.begin(), options.images.end(),
                     [](const std::string& path) { return std::filesystem::is_directory(path); });
}

// Of one pair of many. Empty where it cannot be used, which is told and counted; what is wrong with the first that can
// be read would be wrong with all, and only that one is asked for exchanged sides.
std::optional<host::Ring2Detection> detected(const host::PairName& pair, bool first, host::Ring2Detector& finder,
                                             ImageInput& input) {
  bool read = false;
  try {
    const std::array<host::GreyImage, 2> images{host::read_grey_image(pair.left), host::read_grey_image(pair.right)};
    read = true;
    const host::Ring2Images views{images[0].view(), images[1].view()};
    host::Ring2Detection circles = finder.find(views);
    host::PairFault fault = host::pair_fault({views[0], views[1]});
    if (fault == host::PairFault::kNone && first && better_exchanged(finder, circles, views)) {
      fault = host::PairFault::kExchanged;
    }
    if (fault != host::PairFault::kNone) throw host::NoPairError(pair.left + ": " + text_of(fault));
    input.count_read(images[0].from_colour ? pair.left : images[1].from_colour ? pair.right : "");
    return circles;
  } catch (const host::InputError& error) {
    if (read && first) throw;
    input.leave_out(error);
    return std::nullopt;
  }
}

// Every pair of two folders, or of one that holds both sides. The exit code.
int from_folders(const ring2::Rig& rig, const Options& options) {
  constexpr double kRate_hz = 1.0;  // times are not used
  const std::vector<host::PairName> pairs = options.images.size() == 1
                                                ? host::pair_names_in(options.images[0], kRate_hz)
                                                : host::pair_names(options.images[0], options.images[1], kRate_hz);
  const bool by_paper = options.method == "paper";
  host::Ring2Settings settings;
  settings.sizes = sizes_of(options.target);
  host::Ring2Detector finder(rig, settings);
  ImageInput input("pair");
  Output output(options.output, ring2_columns(true));
  Progress progress("searched", "pairs", pairs.size());
  bool answered = false, first = true;
  for (const host::PairName& pair : pairs) {
    std::optional<host::Ring2Detection> circles = detected(pair, first, finder, input);
    progress.step();
    if (!circles) continue;
    first = false;
    if (by_paper) solve_again_by_paper(rig, *circles);
    output.rows().text(name_of(pair));
    const double time_s = pair.stamp_ns ? static_cast<double>(*pair.stamp_ns) * 1e-9 : pair.time_s;
    write_detection(*circles, {by_paper, circles->one_edge, time_s}, output.rows());
    answered = answered || circles->estimate;
  }
  output.finish();
  if (answered) note_turn(options);
  return input.finish(answered);
}

bool from_images(const ring2::Rig& rig, const Options& options) {
  ImageInput input;
  const std::array<host::GreyImage, 2> images{input.read(options.images[0]), input.read(options.images[1])};
  host::Ring2Settings settings;
  settings.sizes = sizes_of(options.target);
  host::Ring2Detector finder(rig, settings);
  const host::Ring2Images views{images[0].view(), images[1].view()};
  host::Ring2Detection circles = finder.find(views);
  host::PairFault fault = host::pair_fault({views[0], views[1]});
  if (fault == host::PairFault::kNone && better_exchanged(finder, circles, views)) fault = host::PairFault::kExchanged;
  if (fault != host::PairFault::kNone) {
    note(text_of(fault));
    circles.estimate.reset();
    circles.refusal = fault == host::PairFault::kEqual ? "left_right_equal" : name_of(ring2::Ring2Failure::kExchanged);
  }
  Output output(options.output, ring2_columns(false));
  const bool by_paper = options.method == "paper";
  if (by_paper) solve_again_by_paper(rig, circles);
  if (!circles.estimate && fault == host::PairFault::kNone) {
    note(options.images[0] + ", " + options.images[1] + ": " + refusal_text(circles.refusal));
  }
  write_detection(circles, {by_paper, circles.one_edge}, output.rows());
  if (!options.overlay.empty()) write_ring2_overlay(options.overlay, images, rig, circles);
  output.finish();
  if (circles.estimate) note_turn(options);
  print_time("a pair", options, [&] { finder.find({images[0].view(), images[1].view()}); });
  return circles.estimate.has_value();
}

int run(const Options& options) {
  const bool table = !options.ellipses.empty();
  if (table != options.images.empty()) throw host::InputError("give two images LEFT RIGHT, or --ellipses FILE");
  const bool folders = !table && are_folders(options);
  if (folders && !options.overlay.empty()) throw host::InputError("--overlay draws on one pair; give two images");
  if (folders && options.repeats > 0) throw host::InputError("--time repeats one pair; give two images");
  if (!table && !folders && options.images.size() != 2)
    throw host::InputError("give both images: LEFT RIGHT; one tells no length");
  if (table && !options.target.empty()) {
    throw host::InputError("--target decides between circles of images; --ellipses names them");
  }
  if (table && !options.overlay.empty()) throw host::InputError("--overlay draws on images; --ellipses has none");
  const std::string& read = table ? options.ellipses : options.images[0];
  const bool twice = read == "-" && (options.rig == "-" || (!table && options.images[1] == "-"));
  if (twice) throw host::InputError("standard input (-) can be read once");
  const ring2::Rig rig = host::ring2_rig(host::read_rig_file(options.rig));
  if (folders) return from_folders(rig, options);
  return (table ? from_table(rig, options) : from_images(rig, options)) ? kExitAnswered : kExitNoAnswer;
}

}  // namespace

void add_ring2(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("circles", "Docking ring and nozzle seen by two cameras to their attitude");
  const auto options = std::make_shared<Options>();
  command
      ->add_option(
          "IMAGES", options->images,
          "LEFT RIGHT: PNG, TIFF, PGM, PPM, JPEG or BMP; - is standard input; or two folders, or one of NAME_left and "
          "NAME_right")
      ->expected(0, 2);
  command->add_option("--rig", options->rig, "Rig file of both cameras (pharos calibrate stereo)")->required();
  command->add_option("--ellipses", options->ellipses, "Ellipses instead of images; - is standard input");
  command->add_option("--target", options->target,
                      "Target description (TOML): sizes that tell which circle is the ring");
  command->add_option("--method", options->method, "exact, or paper: as published")
      ->check(CLI::IsMember({"exact", "paper"}))
      ->capture_default_str();
  command->add_option("--overlay", options->overlay, "Draw what was found into this PNG")
      ->check(output_place())
      ->check(picture_kind(".png"));
  command->add_option("--time", options->repeats, "Solve so many times more; median ms on standard error")
      ->check(CLI::Range(1, 1'000'000));
  add_output_options(*command, options->output);
  add_pose_format_options(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
