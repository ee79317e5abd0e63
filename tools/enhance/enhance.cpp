// SPDX-License-Identifier: Apache-2.0
// pharos enhance: dark images to bright ones (paper 004, section 1).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "host/support/input_error.hpp"
#include "host/vision/enhance/luma.hpp"
#include "tools/enhance/image_files.hpp"
#include "tools/enhance/step_files.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/image_input.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/picture_kind.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

using enhance::Denoiser;
using enhance::WeightStrategy;

constexpr const char* kExample =
    "Example:\n"
    "  pharos enhance dark.png bright.png --illumination light.png --reflectance reflectance.png\n"
    "  pharos enhance frames enhanced --denoiser fast --report frames.csv\n"
    "  pharos enhance noisy.png quiet.png --denoise-only --noise 15\n"
    "IN: a PNG, TIFF, PGM or PPM of 8 or 16 bits, a JPEG or BMP, grey or colour; - is standard input. Or a folder of\n"
    "them, taken in the order of their names as a video (each starts from the illumination of the one before); OUT and "
    "the files of the\n"
    "steps are then folders. OUT: a PNG of the input's bits and colours; - is standard output. Steps: 16 bits.\n"
    "--report writes a row an image: its mean before and after, the noise found, and what became of it.";

// The steps need some thirty floats a pixel.
constexpr std::size_t kMaxPixels = std::size_t{1} << 24;

struct Options {
  std::string in, out;
  enhance::EnhanceSettings settings;
  std::string denoiser = "bm3d";
  std::optional<double> noise;
  bool denoise_only = false;
  StepFiles steps;
  std::string report;
  bool json = false;
};

const std::vector<std::string> kColumns = {"image",   "width_px", "height_px",   "channels",         "bits",
                                           "mean_in", "mean_out", "noise_sigma", "reflectance_peak", "iterations",
                                           "seconds", "status"};

struct Outcome {
  host::Picture picture;  // empty where the image could not be read
  double mean_in = 0.0, mean_out = 0.0, noise_sigma = 0.0, peak = 1.0;
  int iterations = 0;
  double seconds = 0.0;
  std::string status = "ok";
};

double mean_of(const enhance::FloatImage& image) {
  double sum = 0.0;
  for (const float value : image.values) sum += static_cast<double>(std::min(value, 1.0F));
  return sum / static_cast<double>(image.values.size());
}

// Throws InputError for an image that cannot be read.
host::Picture read_image(const std::string& from, const std::string& name) {
  host::Picture picture = host::read_picture(from);
  if (picture.pixels() > kMaxPixels) {
    throw host::InputError(name + ": has " + std::to_string(picture.pixels()) + " pixels; at most " +
                           std::to_string(kMaxPixels) + " are enhanced: cut it or scale it down");
  }
  return picture;
}

class Worker {
 public:
  explicit Worker(const Options& options) : options_(options), enhancer_(options.settings) {}

  /// Throws InputError for a file that cannot be written; black and white images are refused in their row.
  Outcome work(host::Picture&& picture, const std::string& name, const std::string& to, const StepFiles& steps) {
    Outcome outcome;
    outcome.picture = std::move(picture);
    const auto [low, high] = std::minmax_element(outcome.picture.values.begin(), outcome.picture.values.end());
    if (*high == 0) return refused(std::move(outcome), name, "black", "every pixel is black: nothing to enhance");
    if (*low == 65535)
      return refused(std::move(outcome), name, "saturated", "every pixel is white: nothing to enhance");
    const auto start = std::chrono::steady_clock::now();
    const enhance::FloatImage frame = light_of(outcome.picture);
    outcome.mean_in = mean_of(frame);
    const enhance::FloatImage& result = options_.denoise_only ? quieten(frame, outcome) : brighten(frame, outcome);
    outcome.mean_out = mean_of(result);
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    host::write_picture(to, picture_of(result, outcome.picture.bits));
    if (!options_.denoise_only) steps.write(*steps_);
    return outcome;
  }

 private:
  static Outcome refused(Outcome outcome, const std::string& name, const char* reason, const char* why) {
    note(name + ": " + why);
    outcome.status = std::string("refused_") + reason;
    return outcome;
  }
  const enhance::FloatImage& brighten(const enhance::FloatImage& frame, Outcome& outcome) {
    steps_ = &enhancer_.enhance(frame);
    outcome.noise_sigma = steps_->noise_sigma;
    outcome.peak = steps_->peak;
    outcome.iterations = steps_->iterations;
    return steps_->result;
  }
  const enhance::FloatImage& quieten(const enhance::FloatImage& frame, Outcome& outcome) {
    outcome.noise_sigma = denoiser_.denoise(frame, 1.0F, options_.settings, quiet_);
    return quiet_;
  }

  const Options& options_;
  enhance::Enhancer enhancer_;
  const enhance::Enhanced* steps_ = nullptr;
  enhance::LumaDenoiser denoiser_;
  enhance::FloatImage quiet_;
};

void write_row(const std::string& image, const Outcome& outcome, host::RowWriter& rows) {
  rows.text(image);
  const host::Picture& picture = outcome.picture;
  if (picture.values.empty()) {
    rows.none(4);
  } else {
    rows.integer(picture.width_px).integer(picture.height_px).integer(picture.channels).integer(picture.bits);
  }
  if (outcome.status == "ok") {
    rows.number(outcome.mean_in).number(outcome.mean_out).number(outcome.noise_sigma).number(outcome.peak);
    rows.integer(outcome.iterations).number(outcome.seconds);
  } else {
    rows.none(6);
  }
  rows.text(outcome.status).end_row();
}

int run_folder(const Options& options, Output* report) {
  const std::vector<ImageFile> files = image_files(options.in);
  make_folder(options.out);
  for (const std::string& folder : options.steps.names()) make_folder(folder);
  Worker worker(options);
  Progress progress("enhance", "images", files.size());
  ImageInput input;
  bool any = false;
  for (const ImageFile& file : files) {
    Outcome outcome;
    std::optional<host::Picture> picture;
    try {
      picture = read_image(file.path, file.path);
      input.count_read();
    } catch (const host::InputError& error) {
      input.leave_out(error);
      outcome.status = "refused_unreadable";
    }
    if (picture) {
      outcome =
          worker.work(std::move(*picture), file.path, (std::filesystem::path(options.out) / file.png_name).string(),
                      options.steps.inside(file.png_name));
    }
    any |= outcome.status == "ok";
    if (report != nullptr) write_row(file.path, outcome, report->rows());
    progress.step();
  }
  return input.finish(any);
}

int run(Options options) {
  if (options.noise) options.settings.noise_sigma = *options.noise / 255.0;
  options.settings.denoiser = options.denoiser == "none"   ? Denoiser::kNone
                              : options.denoiser == "fast" ? Denoiser::kFast
                                                           : Denoiser::kBm3d;
  if (options.denoiser == "bm3d-video") options.settings.bm3d = enhance::kVideoBm3d;
  if (options.denoise_only && options.steps.any()) {
    throw host::InputError("--denoise-only has no steps to write; leave the files of the steps away");
  }
  if (options.denoise_only && options.settings.denoiser == Denoiser::kNone) {
    throw host::InputError("--denoise-only with --denoiser none does nothing; give another denoiser");
  }
  if (options.out == "-" && options.report == "-") {
    throw host::InputError("OUT and --report cannot both be standard output (-); give a file for one");
  }
  std::optional<Output> report;
  if (!options.report.empty()) report.emplace(OutputOptions{options.json, options.report}, kColumns);
  int code = kExitAnswered;
  if (options.in != "-" && std::filesystem::is_directory(options.in)) {
    code = run_folder(options, report ? &*report : nullptr);
  } else {
    Worker worker(options);
    const std::string name = options.in == "-" ? "standard input" : options.in;
    const Outcome outcome = worker.work(read_image(options.in, name), name, options.out, options.steps);
    if (report) write_row(name, outcome, report->rows());
    code = outcome.status == "ok" ? kExitAnswered : kExitNoAnswer;
  }
  if (report) report->finish();
  return code;
}

void add_settings(CLI::App& command, Options& options) {
  enhance::EnhanceSettings& settings = options.settings;
  command
      .add_option("--strategy", settings.strategy,
                  "Weights of (4): I (none), II (by the gradient), III (by a window, (6); default)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, WeightStrategy>{{"I", WeightStrategy::kUniform},
                                                                                {"II", WeightStrategy::kGradient},
                                                                                {"III", WeightStrategy::kWindow}},
                                          CLI::ignore_case)
                      .description("{I,II,III}"));
  command.add_option("--alpha", settings.alpha, "Weight of smoothness in (4)")
      ->capture_default_str()
      ->check(number_from(0.0, 100.0));
  command.add_option("--sigma-px", settings.sigma_px, "Of the Gaussian window in (6)")
      ->capture_default_str()
      ->check(number_from(0.1, 50.0));
  command.add_option("--gamma", settings.gamma, "Exponent of (7)")
      ->capture_default_str()
      ->check(number_from(0.01, 3.0));
  command
      .add_option("--denoiser", options.denoiser,
                  "bm3d (default), bm3d-video (a fifth of its time), fast (thresholds on blocks) or none")
      ->check(CLI::IsMember({"bm3d", "bm3d-video", "fast", "none"}));
  command
      .add_option("--noise", options.noise,
                  "Standard deviation of the noise in the reflectance's luma, of 255 (default: estimated)")
      ->check(number_from(0.0, 255.0));
  command.add_flag("--denoise-only", options.denoise_only, "Leave the light alone: only denoise the luma of IN");
  command.add_flag("!--clip", settings.fit_to_white,
                   "Cut what is above white off, as in print; else R is divided by what 99.5 % of it stay below");
  command.add_option("--threads", settings.threads, "Same result with any number")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
}

}  // namespace

void add_enhance(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("enhance", "Dark images to bright ones, step by step");
  const auto options = std::make_shared<Options>();
  command->add_option("IN", options->in, "Image, folder of images, or - (standard input)")->required();
  command->add_option("OUT", options->out, "PNG, folder, or - (standard output)")
      ->check(output_place())
      ->check(picture_kind(".png"))
      ->required();
  command->add_option("--max-rgb", options->steps.start, "Write the illumination's start (2)")->check(output_place());
  command->add_option("--refined", options->steps.refined, "Write the solution of (5)")->check(output_place());
  command->add_option("--illumination", options->steps.illumination, "Write the illumination L, after (7)")
      ->check(output_place());
  command
      ->add_option(
          "--reflectance", options->steps.reflectance,
          "Write the reflectance R, (3), as (8) uses it: divided by the report's reflectance_peak, cut at white")
      ->check(output_place());
  command
      ->add_option("--denoised", options->steps.denoised,
                   "Write the denoised reflectance R_d: OUT is R L + R_d (1 - L), (8)")
      ->check(output_place());
  command->add_option("--report", options->report, "A row an image (CSV) into this file; - is standard output")
      ->check(output_place());
  command->add_flag("--json", options->json, "The report as one JSON object a line");
  add_settings(*command, *options);
  command->footer(kExample);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace pharos::tools
