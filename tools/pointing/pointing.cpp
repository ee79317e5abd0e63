// SPDX-License-Identifier: Apache-2.0
// pharos line: solar-panel edges of one telescope image, or of a pass, to the panel's axis (paper 003).
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "host/cameras/camera_file.hpp"
#include "host/support/input_error.hpp"
#include "host/vision/pointing/track_file.hpp"
#include "pharos/base/units.hpp"
#include "tools/pointing/paper/paper_pictures.hpp"
#include "tools/pointing/pointing_overlay.hpp"
#include "tools/pointing/pointing_table.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/image_input.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/picture_kind.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kExample =
    "Examples:\n"
    "  pharos line panel.png --camera camera.toml --azimuth-deg 288 --elevation-deg 52 --latitude-deg 34.27 "
    "--longitude-deg 108.95\n"
    "  pharos line panel.png --camera camera.toml --azimuth-deg 288 --elevation-deg 52 --method paper --stages steps\n"
    "  pharos line --track pass/track.csv --camera pass/camera.toml --law inertial\n"
    "Directions: s is the station's frame (east, north, up), e Earth-fixed (WGS-84); the axis has no sign, sz >= 0 is\n"
    "given. plane_n is the plane through the telescope that holds the axis: what one image always tells; sigma_deg "
    "says\n"
    "how well the axis is known, up to 52 deg for any direction in that plane. A pass (track: "
    "image,time_s,azimuth_deg,\n"
    "elevation_deg[,range_m,latitude_deg,longitude_deg,height_m]) ends with the row pass: one axis of all images, at\n"
    "the pass' middle, under the attitude law that --law states.";

struct Options {
  std::string image;
  std::string track;
  std::string camera;
  std::string overlay;
  std::string law = "inertial";
  std::string method = "edges";
  std::string stages;
  std::optional<double> slope_deg;
  std::optional<double> azimuth_deg, elevation_deg, latitude_deg, longitude_deg;
  double height_m = 0.0;
  double max_spin_deg_s = 5.0;
  int time = 0;
  OutputOptions output;
};

pointing::AttitudeLaw law_of(const std::string& word) {
  if (word == "nadir") return pointing::AttitudeLaw::kNadir;
  return word == "spin" ? pointing::AttitudeLaw::kSpin : pointing::AttitudeLaw::kInertial;
}

std::optional<pointing::Geodetic> station_of(const Options& options) {
  if (options.latitude_deg.has_value() != options.longitude_deg.has_value()) {
    throw host::InputError("--latitude-deg and --longitude-deg belong together; give both");
  }
  if (!options.latitude_deg) return std::nullopt;
  return pointing::Geodetic{*options.latitude_deg * kRadPerDeg, *options.longitude_deg * kRadPerDeg, options.height_m};
}

// One image's outcome as a row; its planes where it has an answer.
class Measurer {
 public:
  Measurer(const Options& options, std::optional<pointing::Geodetic> station, host::RowWriter& rows)
      : options_(options),
        camera_(host::read_camera_file(options.camera).camera.intrinsics),
        station_(station),
        rows_(rows) {}

  const PinholeCamera& camera() const { return camera_; }
  const std::string& last_error() const { return error_; }

  void refuse(const std::string& name, const std::string& reason, const std::string& advice) {
    error_ = "refused_" + reason + ": " + advice;
    write_pointing_refusal(rows_, name, reason);
  }

  std::optional<pointing::AxisPlanes> measure(const std::string& name, const host::GreyImage& image,
                                              const pointing::LineOfSight& sight, const std::string& picture) {
    const auto panel = pointing::measure_panel(image.view(), camera_);
    if (!panel) {
      refuse(name, pointing::name_of(panel.error()), pointing::advice_of(panel.error()));
      if (!picture.empty()) {
        write_pointing_overlay(picture, image.view(), std::string("refused_") + pointing::name_of(panel.error()));
      }
      return std::nullopt;
    }
    const pointing::PointingResult answer = pointing::answer_of(*panel, sight, pointing::tone_of_bits(image.bits));
    write_image(rows_, name, *panel, answer, station_);
    if (!picture.empty()) write_pointing_overlay(picture, image.view(), camera_, *panel, answer);
    if (answer.second_axis) return std::nullopt;  // a pass rests on what is sure
    return answer.planes_station;
  }

 private:
  const Options& options_;
  PinholeCamera camera_;
  std::optional<pointing::Geodetic> station_;
  host::RowWriter& rows_;
  std::string error_;
};

void report_time(const Options& options, const host::GreyImage& image, const PinholeCamera& camera,
                 const pointing::LineOfSight& sight) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> times_ms;
  for (int k = 0; k < options.time; ++k) {
    const auto start = Clock::now();
    if (const auto panel = pointing::measure_panel(image.view(), camera))
      static_cast<void>(pointing::answer_of(*panel, sight, pointing::tone_of_bits(image.bits)));
    times_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  if (times_ms.empty()) return;
  std::sort(times_ms.begin(), times_ms.end());
  note("median of " + std::to_string(options.time) + ": " + std::to_string(times_ms[times_ms.size() / 2]) + " ms");
}

// Paper 003 as printed: no sigma, no plane.
int run_paper(const Options& options, const host::GreyImage& image, const pointing::LineOfSight& sight) {
  const auto station = station_of(options);
  const PinholeCamera camera = host::read_camera_file(options.camera).camera.intrinsics;
  paper003::Constraints constraints;
  if (options.slope_deg) constraints.slope_rad = *options.slope_deg * kRadPerDeg;
  Output output(options.output, pointing_columns());
  const auto refuse = [&](paper003::Failure failure) {
    write_pointing_refusal(output.rows(), options.image, std::string(paper003::name_of(failure)));
    output.finish();
    note(options.image + ": refused_" + std::string(paper003::name_of(failure)));
    return kExitNoAnswer;
  };
  const auto stages = paper003::find_panel_edges(image.view(), constraints);
  if (!stages) return refuse(stages.error());
  if (!options.stages.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.stages, error);
    if (error) throw host::InputError(options.stages + ": cannot be made: " + error.message());
    paper003::write_stage_pictures(options.stages + "/", *stages, image.width_px, image.height_px);
  }
  const auto axis = paper003::axis_of(*stages, camera, sight.azimuth_rad, sight.elevation_rad);
  if (!axis) return refuse(axis.error());
  write_paper_axis(output.rows(), options.image, axis->direction_station, axis->square_rad, station);
  output.finish();
  return kExitAnswered;
}

int run_image(const Options& options) {
  if (!options.azimuth_deg || !options.elevation_deg) {
    throw host::InputError("an image needs --azimuth-deg and --elevation-deg: where the telescope pointed");
  }
  const auto station = station_of(options);
  ImageInput input;
  const host::GreyImage image = input.read(options.image);
  const pointing::LineOfSight sight{*options.azimuth_deg * kRadPerDeg, *options.elevation_deg * kRadPerDeg};
  if (options.method == "paper") return run_paper(options, image, sight);
  Output output(options.output, pointing_columns());
  Measurer measurer(options, station, output.rows());
  static_cast<void>(measurer.measure(options.image, image, sight, options.overlay));
  const bool answered = measurer.last_error().empty();  // an ambiguous answer is one
  output.finish();
  report_time(options, image, measurer.camera(), sight);
  if (answered) return kExitAnswered;
  note(options.image + ": " + measurer.last_error());
  return kExitNoAnswer;
}

std::string picture_of(const Options& options, const std::string& image) {
  if (options.overlay.empty()) return "";
  return (std::filesystem::path(options.overlay) / (std::filesystem::path(image).stem().string() + "_line.png"))
      .string();
}

// The images of a pass, a row each.
std::vector<pointing::PassImage> measure_rows(const Options& options, const pointing::TrackFile& track,
                                              ImageInput& input, Measurer& measurer) {
  std::vector<pointing::PassImage> images;
  Progress progress("line", "images", track.rows.size());
  for (const pointing::TrackRow& row : track.rows) {
    progress.step();
    if (!row.refusal.empty()) {
      measurer.refuse(row.image, row.refusal, "the track file's row is not complete or out of range");
      continue;
    }
    const auto image = input.try_read(pointing::image_path(options.track, row.image).string());
    if (!image) {
      measurer.refuse(row.image, "unreadable", "it could not be read");
      continue;
    }
    if (const auto planes =
            measurer.measure(row.image, *image, row.observation.sight, picture_of(options, row.image))) {
      images.push_back({row.observation, *planes});
    }
  }
  return images;
}

int run_track(const Options& options) {
  if (options.azimuth_deg || options.elevation_deg) {
    throw host::InputError("--azimuth-deg and --elevation-deg are of one image; the track file tells them of a pass");
  }
  const pointing::TrackFile track = pointing::read_track_file(options.track);
  auto station = station_of(options);
  if (!station) station = track.station;
  if (!options.overlay.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.overlay, error);
    if (error) throw host::InputError(options.overlay + ": cannot be made: " + error.message());
  }
  Output output(options.output, pointing_columns());
  ImageInput input;
  Measurer measurer(options, station, output.rows());
  const std::vector<pointing::PassImage> images = measure_rows(options, track, input, measurer);
  bool answered = !images.empty();
  if (!station) {
    write_pointing_refusal(output.rows(), "pass", "no_station");
    note(
        "the pass needs the station: give --latitude-deg and --longitude-deg, or the track file's columns of that "
        "name");
  } else {
    const auto workspace = std::make_unique<pointing::PassWorkspace>();
    const pointing::AttitudeLaw law = law_of(options.law);
    const auto answer =
        pointing::estimate_pass(images, {*station, law, options.max_spin_deg_s * kRadPerDeg}, *workspace);
    write_pass(output.rows(), answer, law, *station);
    if (answer.failure)
      note(std::string("pass: refused_") + pointing::name_of(*answer.failure) + " (law " + options.law + ")");
  }
  output.finish();
  if (!answered) note(options.track + ": no image has an answer; the last one: " + measurer.last_error());
  return input.finish(answered);
}

}  // namespace

void add_pointing(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("line", "Solar-panel edges of a telescope's images to the panel's axis");
  const auto options = std::make_shared<Options>();
  auto* image = command->add_option("IMAGE", options->image, "An image (PNG, TIFF, PGM, PPM, JPEG, BMP)");
  command->add_option("--track", options->track, "A pass: image,time_s,azimuth_deg,elevation_deg; - is standard input")
      ->excludes(image);
  command->add_option("--camera", options->camera, "Camera file (TOML)")->required();
  command->add_option("--azimuth-deg", options->azimuth_deg, "Of the optical axis, clockwise from north")
      ->check(number_from(pointing::kMinAzimuth_deg, pointing::kMaxAzimuth_deg));
  command->add_option("--elevation-deg", options->elevation_deg, "Of the optical axis, above the horizon")
      ->check(number_from(pointing::kMinElevation_deg, pointing::kMaxElevation_deg));
  command->add_option("--latitude-deg", options->latitude_deg, "Of the station (WGS-84), for Earth-fixed directions")
      ->check(number_from(-90.0, 90.0));
  command->add_option("--longitude-deg", options->longitude_deg, "Of the station, east positive")
      ->check(number_from(-180.0, 360.0));
  command->add_option("--height-m", options->height_m, "Of the station above the ellipsoid (default 0)")
      ->check(number_from(-500.0, 9000.0));
  CLI::Option* method =
      command->add_option("--method", options->method, "edges (default), or paper: paper 003 as printed, one image")
          ->check(CLI::IsMember({"edges", "paper"}));
  command
      ->add_option("--paper-slope-deg", options->slope_deg,
                   "With --method paper: slope of the panel's long edges in the image, from right towards down")
      ->check(number_from(0.0, 180.0))
      ->needs(method);
  command->add_option("--stages", options->stages, "With --method paper: a folder for pictures of its steps")
      ->check(output_place())
      ->needs(method);
  command->add_option("--law", options->law, "How the target holds its axis during a pass: inertial, nadir or spin")
      ->check(CLI::IsMember({"inertial", "nadir", "spin"}));
  command
      ->add_option("--most-spin-deg-s", options->max_spin_deg_s, "Fastest turn that --law spin looks for (default 5)")
      ->check(number_from(0.001, 180.0));
  command->add_option("--overlay", options->overlay, "A picture of what was found; for a pass a folder of them")
      ->check(output_place())
      ->check(picture_kind(".png"));
  command->add_option("--time", options->time, "Repeat so often and print the median time on standard error")
      ->check(CLI::Range(1, 100'000));
  add_output_options(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] {
    if (options->image.empty() == options->track.empty()) {
      throw host::InputError("give an IMAGE, or --track FILE for a pass (`pharos line --help`)");
    }
    if (options->method == "paper" && (!options->track.empty() || !options->overlay.empty() || options->time > 0)) {
      throw host::InputError("--method paper is of one IMAGE, without --track, --overlay and --time");
    }
    if (options->method != "paper" && (!options->stages.empty() || options->slope_deg)) {
      throw host::InputError("--stages and --paper-slope-deg are of --method paper");
    }
    exit_code = options->track.empty() ? run_image(*options) : run_track(*options);
  });
}

}  // namespace pharos::tools
