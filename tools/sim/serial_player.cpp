// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/serial_player.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <ctime>

namespace pharos::sim {
namespace {

constexpr double kStep_s = 0.001;          // period at which the line is served
constexpr double kBitsPerByte = 10.0;      // start, eight, stop
constexpr double kEndLinger_s = 0.3;       // for the reader to take the last bytes
constexpr std::size_t kQueueBytes = 8192;  // size of the queue of frames; when it is full, new ones are dropped

std::int64_t clock_ns(clockid_t id) {
  timespec now{};
  ::clock_gettime(id, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

sigset_t stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

}  // namespace

SerialPlayer::SerialPlayer(LightFeed& feed, const PlayClock& clock, SimulatedTarget& target, PseudoTerminal& line,
                           const SerialOptions& options, std::optional<PlayTruth> truth)
    : feed_(feed),
      clock_(clock),
      target_(target),
      line_(line),
      options_(options),
      random_(options.seed, "serial line") {
  std::sort(options_.unplugs.begin(), options_.unplugs.end(),
            [](const Unplug& a, const Unplug& b) { return a.at_s < b.at_s; });
  if (truth) truth_.emplace(std::move(*truth));
}

double SerialPlayer::elapsed_s() const {
  return static_cast<double>(clock_ns(CLOCK_MONOTONIC) - start_ns_) * 1e-9 * options_.speed;
}

// True when a stop signal came.
bool SerialPlayer::sleep_or_signal(double seconds) {
  const sigset_t set = stop_signals();
  const auto ns = static_cast<std::int64_t>(std::max(seconds, 0.0) * 1e9);
  const timespec timeout{ns / 1'000'000'000, ns % 1'000'000'000};
  summary_.stopped = summary_.stopped || ::sigtimedwait(&set, nullptr, &timeout) > 0;
  return summary_.stopped;
}

bool SerialPlayer::wait_for_reader() {
  while (options_.wait_for_reader && !line_.opened()) {
    if (sleep_or_signal(0.01)) return false;
  }
  return true;
}

SerialSummary SerialPlayer::play() {
  const sigset_t set = stop_signals();
  sigset_t before;
  ::sigprocmask(SIG_BLOCK, &set, &before);
  if (wait_for_reader()) {
    start_ns_ = clock_ns(CLOCK_MONOTONIC);
    if (truth_) truth_->start(clock_ns(CLOCK_REALTIME) / 1000, options_.speed > 0.0 ? options_.speed : 1.0);
    double time_s = 0.0;
    while (feed_.due_ticks() && !summary_.stopped) {
      if (options_.speed > 0.0) {
        sleep_or_signal(kStep_s);
        time_s = elapsed_s();
      } else {
        time_s += kStep_s;
        sleep_or_signal(0.0);
      }
      play_until(time_s);
    }
    target_.finish();
    if (!summary_.stopped) drain();
    summary_.played_s = time_s;
  }
  summary_.sweeps = target_.sweeps();
  summary_.payloads = target_.payloads();
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
  return summary_;
}

void SerialPlayer::play_until(double time_s) {
  unplug_or_plug_in(time_s);
  notice_reader();
  while (const auto due_ticks = feed_.due_ticks()) {
    if (clock_.seconds_at(*due_ticks) > time_s) break;
    feed_.give(target_);
    ++summary_.pulses;
  }
  target_.advance(clock_.ticks_at(time_s));
  target_.receive(line_.read());
  if (truth_) truth_->write_until(time_s);
  if (options_.speed > 0.0) {
    // Capacity of the line in the elapsed time; unused capacity is lost.
    const double per_step = options_.baud / kBitsPerByte * kStep_s * options_.speed;
    const double passed_steps = std::max((time_s - summary_.played_s) / (kStep_s * options_.speed), 0.0);
    byte_credit_ = std::min(byte_credit_ + per_step * passed_steps, per_step * std::max(passed_steps, 4.0));
    const auto budget = static_cast<std::size_t>(byte_credit_);
    byte_credit_ -= static_cast<double>(budget);
    send(budget);
  } else {
    send(SIZE_MAX);
  }
  summary_.played_s = time_s;
}

void SerialPlayer::unplug_or_plug_in(double time_s) {
  if (unplugs_done_ == options_.unplugs.size()) return;
  const Unplug& unplug = options_.unplugs[unplugs_done_];
  if (!unplugged_ && time_s >= unplug.at_s) {
    line_.unplug();
    unplugged_ = true;
  }
  if (unplugged_ && time_s >= unplug.at_s + unplug.for_s) {
    line_.plug_in();
    unplugged_ = false;
    ++unplugs_done_;
  }
}

void SerialPlayer::notice_reader() {
  const bool reader = line_.opened();
  if (reader && !had_reader_) {
    sending_.clear();
    target_.restart_line();
  }
  had_reader_ = reader;
}

void SerialPlayer::damage(std::vector<std::uint8_t>& bytes) {
  if (options_.corrupt_rate == 0.0 && options_.drop_rate == 0.0) return;
  std::vector<std::uint8_t> kept;
  for (const std::uint8_t byte : bytes) {
    if (random_.chance(options_.drop_rate)) {
      ++summary_.bytes_dropped;
      continue;
    }
    const bool flip = random_.chance(options_.corrupt_rate);
    if (flip) ++summary_.bytes_corrupted;
    kept.push_back(static_cast<std::uint8_t>(byte ^ (flip ? 1u << random_.below(8) : 0u)));
  }
  bytes = std::move(kept);
}

void SerialPlayer::send(std::size_t budget_bytes) {
  std::deque<std::vector<std::uint8_t>>& frames = target_.frames();
  while (budget_bytes > 0) {
    if (sending_.empty()) {
      if (frames.empty()) break;
      sending_ = std::move(frames.front());
      frames.pop_front();
      damage(sending_);
      continue;
    }
    const std::size_t size = std::min(sending_.size(), budget_bytes);
    const bool heard = line_.opened();
    const std::size_t taken = line_.write({sending_.data(), size});
    summary_.bytes += taken;
    if (!heard) summary_.bytes_unheard += taken;
    sending_.erase(sending_.begin(), sending_.begin() + static_cast<std::ptrdiff_t>(taken));
    budget_bytes -= taken;
    if (taken < size) {
      if (options_.speed > 0.0) break;
      if (sleep_or_signal(0.0005)) return;  // as fast as the reader reads
    }
  }
  // As in a real target's send buffer, the newest frame is dropped.
  std::size_t waiting = 0;
  for (const auto& frame : frames) waiting += frame.size();
  while (waiting > kQueueBytes && options_.speed > 0.0) {
    waiting -= frames.back().size();
    frames.pop_back();
    target_.count_skipped();
    ++summary_.frames_skipped;
  }
}

void SerialPlayer::drain() {
  const auto unsent = [&] { return line_.opened() && (!sending_.empty() || !target_.frames().empty()); };
  const double per_step = options_.baud / kBitsPerByte * kStep_s * std::max(options_.speed, 1.0);
  for (int step = 0; unsent() && step < 2000; ++step) {
    send(options_.speed > 0.0 ? static_cast<std::size_t>(per_step) : SIZE_MAX);
    if (sleep_or_signal(kStep_s)) return;
  }
  sleep_or_signal(line_.opened() ? kEndLinger_s : 0.0);
}

}  // namespace pharos::sim
