// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "host/support/input_error.hpp"
#include "tools/sim/camera/camera_play.hpp"
#include "tools/sim/camera/make_sequence.hpp"
#include "tools/sim/command/add_sim.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

// Two seconds of frames, 150 MB; shown to and fro.
constexpr std::size_t kUsualFrames = 60;
constexpr int kMaxFrames = 2000;

const std::map<std::string, sim::PtpNames> kPtpNames{
    {"new", sim::PtpNames::kNew}, {"old", sim::PtpNames::kOld}, {"none", sim::PtpNames::kNone}};

struct CameraOptions {
  std::string input;
  std::uint64_t seed = 1;
  std::size_t frames = kUsualFrames;
  std::string camera_file;
  std::string view;  // left, right: of pairs; else a depth camera
  std::vector<std::string> stalls;
  std::vector<std::string> deaths;
  std::vector<std::string> freezes;
  std::vector<std::string> masterless;
  double jitter_ms = 0.0;
  sim::CameraPlay play;
};

std::vector<sim::Outage> parse_intervals(const char* option, const std::vector<std::string>& texts) {
  std::vector<sim::Outage> intervals;
  for (const std::string& text : texts) {
    sim::Outage& interval = intervals.emplace_back();
    const std::size_t comma = text.find(',');
    const char* const end = text.data() + text.size();
    const auto at = std::from_chars(text.data(), end, interval.at_s);
    const bool at_good = at.ec == std::errc() && comma != std::string::npos && at.ptr == text.data() + comma;
    const auto duration = at_good ? std::from_chars(at.ptr + 1, end, interval.for_s) : at;
    if (!at_good || duration.ec != std::errc() || duration.ptr != end || interval.at_s < 0.0 || interval.for_s < 0.0) {
      throw host::InputError(std::string(option) + " " + text + ": give AT,FOR in seconds, as 5,1.5");
    }
  }
  return intervals;
}

sim::FrameSequence make_reel(const CameraOptions& options) {
  if (!options.view.empty()) {
    return sim::sequence_of_pairs(options.input, options.view == "left" ? 0 : 1, options.frames);
  }
  if (std::filesystem::is_directory(options.input)) return sim::sequence_of_directory(options.input, options.frames);
  Progress progress("rendered", "frames", options.frames);
  return sim::sequence_of_scenario(options.input, options.seed, options.frames, options.camera_file,
                                   [&progress] { progress.step(); });
}

// Before any thread begins, so that none takes them.
void block_stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

int serve(CameraOptions options) {
  options.play.stalls = parse_intervals("--stall", options.stalls);
  options.play.deaths = parse_intervals("--death", options.deaths);
  options.play.freezes = parse_intervals("--freeze", options.freezes);
  options.play.ptp_masterless = parse_intervals("--ptp-masterless", options.masterless);
  options.play.grey = !options.view.empty();
  options.play.clock_jitter_s = options.jitter_ms * 1e-3;
  const sim::FrameSequence reel = make_reel(options);
  block_stop_signals();
  // There before the camera is, so that whoever waits for it finds both.
  if (!options.play.truth_file.empty()) std::ofstream(options.play.truth_file).flush();
  const auto ready = [&options] { std::cout << options.play.address << std::endl; };
  const sim::CameraPlaySummary summary = sim::serve_camera(reel, options.play, ready);
  std::cerr << "served " << summary.frames << " frames in " << summary.played_s << " s\n";
  return 0;
}

void add_behaviour(CLI::App& command, CameraOptions& options) {
  sim::CameraPlay& play = options.play;
  command.add_option("--loss", play.loss, "share of packets lost")->check(number_from(0.0, 1.0));
  command.add_option("--stall", options.stalls, "AT,FOR: no packet from AT s for FOR s (may be repeated)");
  command.add_option("--death", options.deaths, "AT,FOR: no camera from AT s for FOR s (may be repeated)");
  command.add_option("--freeze", options.freezes,
                     "AT,FOR: the same frame and time from AT s for FOR s (may be repeated)");
  command.add_flag("--apart", play.depth_and_intensity_apart, "offer Coord3D_C16 and Mono16 only");
  command.add_option("--clock-ppm", play.clock_ppm, "how much the camera's clock runs fast")
      ->check(number_from(-1000.0, 1000.0));
  command.add_option("--clock-start", play.clock_start_s, "what the camera's clock shows at its start, s")
      ->check(number_from(0.0, 1e9))
      ->capture_default_str();
  command.add_option("--jitter-ms", options.jitter_ms, "with --view: sigma of what the camera's times are off")
      ->check(number_from(0.0, 1000.0));
  command.add_flag("--ptp", play.ptp, "follow UTC once it is told to (PtpEnable)");
  command.add_option("--ptp-names", play.ptp_names, "PtpEnable (new), GevIEEE1588 (old), or no PTP (none)")
      ->transform(CLI::CheckedTransformer(kPtpNames));
  command.add_flag("--ptp-refused", play.ptp_refused, "take no order to follow PTP");
  command.add_option("--ptp-masterless", options.masterless,
                     "AT,FOR: no PTP master from AT s for FOR s (may be repeated)");
}

}  // namespace

void add_sim_camera(CLI::App& sim, int& exit_code) {
  auto options = std::make_shared<CameraOptions>();
  sim::CameraPlay& play = options->play;
  CLI::App* command = sim.add_subcommand("camera", "Serve frames as a Helios on the network (GigE Vision)");
  command
      ->add_option(
          "INPUT", options->input,
          "scenario (tools/sim/scenarios/tof_*.toml), or a directory of frames with its camera.toml; with --view "
          "a directory of pairs")
      ->required();
  command
      ->add_option("--view", options->view,
                   "left or right: serve that side of recorded pairs as a grey camera (Mono8, Mono16), triggered at "
                   "the beats of UTC: two of them show one pair at a time")
      ->check(CLI::IsMember({"left", "right"}));
  add_seed_option(*command, options->seed, "of the scenario");
  command->add_option("--frames", options->frames, "how many frames are made beforehand; they are shown to and fro")
      ->check(CLI::Range(1, kMaxFrames))
      ->capture_default_str();
  command->add_option("--camera-file", options->camera_file, "write the scenario's camera file here")
      ->check(output_place());
  command->add_option("--truth", play.truth_file, "write true poses here as they are shown (utime: microseconds UTC)")
      ->check(output_place());
  command->add_option("--address", play.address, "address of this computer to serve at")->capture_default_str();
  command->add_option("--serial", play.serial, "serial number")->capture_default_str();
  command->add_option("--rate", play.frame_rate_hz, "frames a second")
      ->check(number_from(0.1, 200.0))
      ->capture_default_str();
  command->add_option("--mode", play.mode, "Scan3dOperatingMode at the start")->capture_default_str();
  command->add_option("--duration", play.duration_s, "stop after this many seconds (default: at Ctrl-C)")
      ->check(number_from(0.1, 1e9));
  add_behaviour(*command, *options);
  command->footer(
      "Prints its address once the camera can be found there; ends on SIGINT or SIGTERM. One camera an address.\n\n"
      "Example: pharos sim camera tools/sim/scenarios/tof_approach.toml --truth /tmp/truth.csv --camera-file "
      "/tmp/camera.toml\n         pharos sim camera /tmp/pairs --view left --address 127.0.0.2 --serial L1 --rate 10");
  command->callback([options, &exit_code] { exit_code = serve(*options); });
}

}  // namespace pharos::tools
