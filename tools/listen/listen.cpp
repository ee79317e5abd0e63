// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstdio>
#include <lcm/lcm-cpp.hpp>

#include "host/runtime/event_loop.hpp"
#include "host/runtime/now.hpp"
#include "host/runtime/signals.hpp"
#include "host/runtime/timer.hpp"
#include "host/support/input_error.hpp"
#include "tools/listen/listener.hpp"
#include "tools/listen/subscription.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/number_option.hpp"

namespace pharos::tools {
namespace {

constexpr double kShortest_s = 1e-3;
constexpr double kLongest_s = 1e9;
constexpr std::chrono::milliseconds kTick{100};

struct ListenOptions {
  std::string channel = "PHAROS_LIGHTHOUSE_POSE";
  std::string url = kDefaultUrl;
  std::string truth;
  double duration_s = 0.0;
  std::int64_t count = 0;
  std::string format = "lines";
  bool covariance = false;
  bool csv = false;
  bool json = false;
  bool summary = false;
};

ListenFormat format_of(const ListenOptions& options) {
  if (options.summary) return ListenFormat::kNone;
  if (options.json || options.format == "json") return ListenFormat::kJson;
  if (options.format == "tum") return ListenFormat::kTum;
  return options.csv || options.format == "csv" ? ListenFormat::kCsv : ListenFormat::kLines;
}

void hear(const lcm_recv_buf_t* buffer, const char* channel, void* listener) {
  static_cast<Listener*>(listener)->take(channel, buffer->data, static_cast<int>(buffer->data_size), host::utc_now_ns(),
                                         host::monotonic_now_ns());
}

void listen_until_done(lcm::LCM& lcm, Listener& listener, host::Signals& signals, const ListenOptions& options) {
  host::EventLoop loop;
  host::Timer timer;
  if (options.duration_s > 0.0) {
    timer.start(
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(options.duration_s)));
  }
  host::Timer tick;
  tick.start_every(kTick);
  loop.watch(tick.fd(), [&] {
    tick.take_expiries();
    listener.tick(host::utc_now_ns(), host::monotonic_now_ns());
  });
  loop.watch(signals.fd(), [&] { loop.stop(); });
  loop.watch(timer.fd(), [&] { loop.stop(); });
  loop.watch(lcm.getFileno(), [&] {
    if (lcm.handle() != 0) return loop.stop();  // the end of a file
    if (options.count > 0 && listener.summary().poses() >= options.count) loop.stop();
  });
  loop.run();
}

void report_passed_over(const Listener::PassedOver& counts) {
  const auto report = [](std::int64_t count, const char* what) {
    if (count > 0) std::fprintf(stderr, "%lld messages %s\n", static_cast<long long>(count), what);
  };
  report(counts.other_types, "of other types passed over");
  report(counts.impossible, "passed over: their values are none that a pharosd sends");
  report(counts.too_many, "passed over: they are of more sources than are kept");
}

// What is received and is no row of the format.
void report_not_shown(const Listener& listener, ListenFormat format) {
  const bool of_poses = format == ListenFormat::kCsv || format == ListenFormat::kTum;
  if (of_poses && listener.other_messages() > 0) {
    std::fprintf(stderr, "%lld status or pointing messages not shown: they are no rows of this table; use --json\n",
                 static_cast<long long>(listener.other_messages()));
  }
  if (format != ListenFormat::kTum || listener.left_out() == nullptr) return;
  const std::string text = text_of(*listener.left_out());
  if (!text.empty()) std::fprintf(stderr, "%s\n", text.c_str());
}

int listen(const ListenOptions& options) {
  const ListenFormat format = format_of(options);
  if (options.covariance && format != ListenFormat::kCsv && format != ListenFormat::kJson) {
    throw host::InputError("--covariance is for tables: give --format csv or json");
  }
  // Signals are blocked before LCM starts its own thread, which would receive them otherwise.
  host::Signals signals{SIGINT, SIGTERM};
  std::optional<TruthFile> truth;
  if (!options.truth.empty()) truth.emplace(options.truth);
  lcm::LCM lcm(options.url);
  Listener listener(format, options.covariance, std::move(truth));
  subscribe(lcm, options.url, options.channel, hear, &listener);
  listener.begin();
  listen_until_done(lcm, listener, signals, options);
  listener.finish();
  const std::string text = summary_text(listener.summary().sources());
  std::fputs(text.c_str(), options.summary ? stdout : stderr);
  report_passed_over(listener.passed_over());
  report_not_shown(listener, format);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw host::InputError(
        "standard output: rows were lost, it cannot be written; free the disk or choose another file");
  }
  const bool received = listener.summary().poses() > 0 || listener.other_messages() > 0;
  return received ? kExitAnswered : kExitNoAnswer;
}

}  // namespace

void add_listen(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ListenOptions>();
  CLI::App* command =
      app.add_subcommand("listen", "Poses (or pointings, or status) on LCM as they arrive, one line each");
  command->add_option("CHANNEL", options->channel, "Channel, or a regular expression for several")
      ->capture_default_str();
  command->add_option("--url", options->url, "LCM URL")->capture_default_str();
  command->add_option("--truth", options->truth,
                      "File with the true poses (utime,qw,...,tz_m), as `pharos sim serial --truth` and `pharos sim "
                      "camera --truth` write it");
  command->add_option("--duration", options->duration_s, "Stop after this many seconds (default: at Ctrl-C)")
      ->check(number_from(kShortest_s, kLongest_s));
  command->add_option("--count", options->count, "Stop after this many valid poses")->check(CLI::Range(0, INT_MAX));
  command
      ->add_option(
          "--format", options->format,
          "lines; csv, json: a table; tum: lines `time_s x y z qx qy qz qw` (UTC) of the good poses of the first "
          "source heard, the others are counted on standard error")
      ->check(CLI::IsMember({"lines", "csv", "tum", "json"}))
      ->capture_default_str();
  command->add_flag(
      "--covariance", options->covariance,
      "36 further columns cov_rx_rx_rad2 ... cov_tz_tz_m2 of a table: the covariance of the message, row by "
      "row, rotation (rad) before translation (m), in the parent frame; where the turn about the target's "
      "axis is not measured, its variance is pi^2/3 rad^2; of an ambiguous pose about the first solution");
  command->add_flag("--csv", options->csv, "A CSV table of the poses, as --format csv");
  command->add_flag("--json", options->json, "One JSON object a line")->excludes("--csv");
  command->add_flag("--summary", options->summary, "Only the summary at the end, on standard output");
  command->footer(
      "Example: pharos listen --duration 10 --summary --truth truth.csv\n"
      "         pharos listen PHAROS_TOF_POSE\n"
      "         pharos listen 'PHAROS_(RING2|SLAM)_POSE'\n"
      "         pharos listen PHAROS_LINE_POINTING\n"
      "         pharos listen PHAROS_TARGET_STATE\n"
      "         pharos listen PHAROS_STATUS --json\n"
      "Ends with 0 when at least one pose, pointing or status message was received, with 1 when none was.");
  command->callback([options, &exit_code] { exit_code = listen(*options); });
}

}  // namespace pharos::tools
