// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <thread>

#include "host/support/input_error.hpp"
#include "host/support/unique_fd.hpp"
#include "tools/sim/capture_feed.hpp"
#include "tools/sim/command/add_sim.hpp"
#include "tools/sim/playback_input.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/seed_option.hpp"

namespace pharos::tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kStep_s = 0.001;
constexpr double kLead_s = 0.001;  // longer than any pulse: whoever is lit now is known when his light ends
constexpr double kTail_s = 1.2;    // after the last pulse, for the last sweep, counters and time to be said
constexpr double kOldest_s = 0.01;

struct CaptureArguments {
  std::string input;
  std::string output = "-";
  std::string truth;
  double speed = 0.0;
  unsigned sensors = 32;
  std::uint64_t seed = 1;
};

class Sink {
 public:
  explicit Sink(const std::string& path) : path_(path) {
    if (path == "-") return;
    file_.reset(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (!file_.valid()) throw host::InputError(path + ": cannot be written");
  }
  /// False when nobody reads any more.
  bool write(std::vector<std::uint8_t>& bytes) {
    const int fd = file_.valid() ? file_.get() : STDOUT_FILENO;
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count = ::write(fd, bytes.data() + done, bytes.size() - done);
      if (count < 0 && errno == EPIPE) return false;
      if (count < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), path_);
      if (count > 0) done += static_cast<std::size_t>(count);
    }
    bytes.clear();
    return true;
  }

 private:
  std::string path_;
  host::UniqueFd file_;
};

class CapturePlayer {
 public:
  CapturePlayer(sim::PlaybackInput input, const CaptureArguments& options)
      : input_(std::move(input)), options_(options), sink_(options.output) {
    if (!options.truth.empty()) truth_.emplace(sim::truth_of(input_, options.truth));
  }

  void play() {
    std::signal(SIGPIPE, SIG_IGN);
    const auto start = Clock::now();
    if (truth_) truth_->start(utc_us(), options_.speed > 0.0 ? options_.speed : 1.0);
    double time_s = 0.0;
    double last_s = 0.0;  // of the last pulse
    bool heard = true;
    while (heard && time_s < last_s + kTail_s) {
      time_s += kStep_s;
      if (options_.speed > 0.0) {
        const std::chrono::duration<double> ahead = start - Clock::now();
        std::this_thread::sleep_for(ahead + std::chrono::duration<double>(time_s / options_.speed));
      }
      while (const sim::PulseFeed::Due* due = input_.feed->peek()) {
        last_s = std::max(last_s, input_.clock.seconds_at(due->due_ticks));
        if (last_s > time_s + kLead_s) break;
        push(*due);
        input_.feed->pop();
      }
      feed_.advance(input_.clock.ticks_at(time_s));
      if (truth_) truth_->write_until(time_s);
      heard = sink_.write(feed_.bytes());
    }
    feed_.end();
    if (heard) sink_.write(feed_.bytes());
    std::cerr << "played " << time_s << " s: " << pulses_ << " pulses, " << strays_ + feed_.pulses_left_out()
              << " of them left out, as no pin could show them\n";
  }

 private:
  static std::int64_t utc_us() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
  }
  void push(const sim::PulseFeed::Due& due) {
    if (due.pulse.sensor >= options_.sensors) return;
    ++pulses_;
    const double off_s = input_.clock.seconds_at(due.pulse.fall_ticks) - input_.clock.seconds_at(due.due_ticks);
    if (std::abs(off_s) > kOldest_s) {
      ++strays_;
    } else {
      feed_.push(due.pulse);
    }
  }

  sim::PlaybackInput input_;
  const CaptureArguments& options_;
  Sink sink_;
  std::optional<sim::TruthLog> truth_;
  sim::CaptureFeed feed_;
  std::uint64_t pulses_ = 0;
  std::uint64_t strays_ = 0;
};

}  // namespace

void add_sim_capture(CLI::App& sim, int& exit_code) {
  auto options = std::make_shared<CaptureArguments>();
  CLI::App* command = sim.add_subcommand("capture", "Play a scenario or a recording as the capture block's registers");
  command
      ->add_option("INPUT", options->input,
                   "scenario (.toml), or edges (sensor,rise_ticks,fall_ticks; - is standard input)")
      ->required();
  command->add_option("--output", options->output, "file or pipe for the words; - is standard output")
      ->check(output_place())
      ->capture_default_str();
  command->add_option("--speed", options->speed, "times real speed; 0: as fast as the reader reads")
      ->check(number_from(0.0, 1e4))
      ->capture_default_str();
  command->add_option("--sensors", options->sensors, "play sensors below this number")
      ->check(CLI::Range(1, 32))
      ->capture_default_str();
  add_seed_option(*command, options->seed, "of the scenario");
  command->add_option("--truth", options->truth, "write true poses here while playing (utime: microseconds UTC)")
      ->check(output_place());
  command->footer(
      "Gives four little-endian 32-bit words a record, as firmware in the emulator reads them: see\n"
      "firmware/board/qemu_virt/capture_replay.hpp. tools/target-decode shows its use.\n\n"
      "Example: pharos sim capture tools/sim/scenarios/demo.toml --output words.bin");
  command->callback([options, &exit_code] {
    CapturePlayer player(sim::open_playback_input(options->input, options->seed), *options);
    player.play();
    exit_code = 0;
  });
}

}  // namespace pharos::tools
