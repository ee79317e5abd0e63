// SPDX-License-Identifier: Apache-2.0
// pharos ellipses: images to the ellipses in them.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "host/support/input_error.hpp"
#include "pharos/ellipse/detect.hpp"
#include "pharos/ellipse/tone_error.hpp"
#include "tools/ellipses/overlay.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/image_input.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/picture_kind.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/stopwatch.hpp"

namespace pharos::tools {
namespace {

using ellipse::DetectedEllipse;
using ellipse::EllipseWorkspace;

constexpr const char* kExample =
    "Example:\n"
    "  pharos ellipses frame.png --overlay found.png\n"
    "  pharos ellipses frames/*_intensity.png --min-minor 15 > ellipses.csv\n"
    "One row an ellipse, best score first; an image without any has no row and a note. Pixel (0, 0) is the centre of\n"
    "the first pixel; a_px >= b_px are semi-axes, theta_rad runs from +u (right) towards +v (down). score is F_val,\n"
    "coverage the share of the contour that has edges, bright_inside 1 where the inside is the brighter side.\n"
    "Images: PNG, TIFF, PGM or PPM of 8 or 16 bits, JPEG or BMP, grey or colour (luma); - is standard input.\n"
    "Values of 16 bits are taken for linear in light; of 8 bits the sigmas of the axes include what a tone curve does.";

struct Options {
  std::vector<std::string> images;
  ellipse::EllipseSettings settings;
  int repeats = 0;
  std::string overlay;
  OutputOptions output;
};

const std::vector<std::string> kColumns = {"image",      "cx_px",           "cy_px",       "a_px",        "b_px",
                                           "theta_rad",  "score",           "sigma_cx_px", "sigma_cy_px", "sigma_a_px",
                                           "sigma_b_px", "sigma_theta_rad", "rms_px",      "coverage",    "points",
                                           "arcs",       "bright_inside"};

void write_row(const std::string& image, const DetectedEllipse& found, host::RowWriter& rows) {
  const ellipse::Ellipse& e = found.ellipse;
  rows.text(image).number(e.cx_px).number(e.cy_px).number(e.a_px).number(e.b_px).number(e.theta_rad);
  rows.number(found.score);
  for (int k = 0; k < 5; ++k) rows.number(std::sqrt(found.covariance(k, k)));
  rows.number(found.rms_px).number(found.coverage).integer(found.points).integer(found.arcs);
  rows.integer(found.bright_inside ? 1 : 0).end_row();
}

// Memory for the largest image so far.
class Detector {
 public:
  std::span<const DetectedEllipse> detect(const host::GreyImage& image, const ellipse::EllipseSettings& settings) {
    planes_.resize(std::max(planes_.size(), ellipse::kPlanes * image.pixels.size()));
    workspace_->planes = planes_;
    const auto found = ellipse::detect_ellipses(image.view(), settings, *workspace_);
    // Of 8 bits, which may have been made for screens, nobody says that values are linear in light.
    if (image.bits == 8) ellipse::add_tone_error(image.view(), *workspace_);
    return found;
  }
  const EllipseWorkspace& workspace() const { return *workspace_; }

 private:
  std::vector<std::uint16_t> planes_;
  std::unique_ptr<EllipseWorkspace> workspace_ = std::make_unique<EllipseWorkspace>(std::span<std::uint16_t>());
};

void time_image(const std::string& name, const host::GreyImage& image, const Options& options, Detector& detector) {
  std::vector<double> times_s;
  Progress progress("timing", "rounds", static_cast<std::size_t>(options.repeats));
  for (int k = 0; k < options.repeats; ++k) {
    times_s.push_back(seconds_of([&] { detector.detect(image, options.settings); }));
    progress.step();
  }
  std::fprintf(stderr, "%s: median %.3f ms (%d times)\n", name.c_str(), 1e3 * middle_of(times_s), options.repeats);
}

void print_limits(const std::string& name, const host::GreyImage& image, const EllipseWorkspace& workspace) {
  if (std::min(image.width_px, image.height_px) < ellipse::kMinSide_px) {
    note(name + ": " + std::to_string(image.width_px) + " x " + std::to_string(image.height_px) +
         " pixels are too few for an ellipse");
  }
  const ellipse::EllipseCounters& c = workspace.counters;
  const std::uint32_t dropped = c.edge_points_dropped + c.contours_dropped + c.arcs_dropped + c.ellipses_dropped;
  if (dropped > 0) {
    note(name + ": busier than there is memory for: " + std::to_string(c.edge_points_dropped) + " edge points, " +
         std::to_string(c.contours_dropped) + " contours, " + std::to_string(c.arcs_dropped) + " arcs, " +
         std::to_string(c.ellipses_dropped) + " ellipses left out");
  }
}

int run(const Options& options) {
  if (!options.overlay.empty() && options.images.size() > 1) {
    throw host::InputError("--overlay draws one picture; give one image at a time");
  }
  if (std::count(options.images.begin(), options.images.end(), "-") > 1) {
    throw host::InputError("standard input (-) can be read once");
  }
  Output output(options.output, kColumns);
  Detector detector;
  Progress progress("ellipses", "images", options.images.size());
  ImageInput images;
  std::size_t ellipses = 0;
  for (const std::string& name : options.images) {
    const std::optional<host::GreyImage> read = images.try_read(name);
    progress.step();
    if (!read) continue;
    const host::GreyImage& image = *read;
    const std::span<const DetectedEllipse> found = detector.detect(image, options.settings);
    for (const DetectedEllipse& e : found) write_row(name, e, output.rows());
    ellipses += found.size();
    if (found.empty()) note(name + ": no ellipse");
    print_limits(name, image, detector.workspace());
    if (!options.overlay.empty()) {
      host::Canvas canvas(image.view(), host::Canvas::zoom_for(image.width_px));
      draw_arcs(detector.workspace(), canvas);
      draw_ellipses(found, canvas);
      canvas.write_png(options.overlay);
    }
    if (options.repeats > 0) time_image(name, image, options, detector);
  }
  if (!images.nothing_read()) output.finish();
  return images.finish(ellipses > 0);
}

}  // namespace

void add_ellipses(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("ellipses", "Images to the ellipses in them");
  const auto options = std::make_shared<Options>();
  command->add_option("IMAGE", options->images, "Images (PNG, TIFF, PGM, PPM, JPEG, BMP); - is standard input")
      ->required();
  command->add_option("--min-minor", options->settings.min_minor_px, "Least semi-minor axis, px")
      ->capture_default_str()
      ->check(number_from(2.0, 10'000.0));
  command->add_option("--max-ratio", options->settings.max_axis_ratio, "Greatest a/b (T1; the paper's is 2)")
      ->capture_default_str()
      ->check(number_from(1.01, 100.0));
  command->add_option("--min-score", options->settings.min_score, "Least F_val (T_val)")
      ->capture_default_str()
      ->check(number_from(0.0, 1.0));
  command->add_option("--time", options->repeats, "Detect so many times more; median ms an image on standard error")
      ->check(CLI::Range(1, 1'000'000));
  command->add_option("--overlay", options->overlay, "Draw edges, arcs and ellipses into this PNG")
      ->check(output_place())
      ->check(picture_kind(".png"));
  add_output_options(*command, options->output);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
