// SPDX-License-Identifier: Apache-2.0
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <lcm/lcm-cpp.hpp>

#include "host/runtime/event_loop.hpp"
#include "host/runtime/now.hpp"
#include "host/runtime/signals.hpp"
#include "host/runtime/timer.hpp"
#include "host/support/input_error.hpp"
#include "tools/listen/subscription.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/number_option.hpp"
#include "tools/watch/watch_table.hpp"

namespace pharos::tools {
namespace {

constexpr double kShortest_s = 1e-3;
constexpr double kLongest_s = 1e9;
// The eye follows no more; a log of it, once a second.
constexpr std::chrono::milliseconds kRedraw{200};
constexpr std::chrono::milliseconds kPrint{1000};
constexpr std::size_t kUnlimited = 4096;

struct WatchOptions {
  std::string channel = "PHAROS_.*";
  std::string url = kDefaultUrl;
  double duration_s = 0.0;
};

void hear(const lcm_recv_buf_t* buffer, const char* channel, void* table) {
  static_cast<SourceTable*>(table)->take(channel, buffer->data, static_cast<int>(buffer->data_size), host::utc_now_ns(),
                                         host::monotonic_now_ns());
}

/// The terminal's second screen while it is needed; the first one returns with what was on it.
class Screen {
 public:
  Screen() : terminal_(::isatty(STDOUT_FILENO) == 1) {
    if (terminal_) std::fputs("\x1b[?1049h\x1b[?25l", stdout);
  }
  ~Screen() {
    if (terminal_) std::fputs("\x1b[?25h\x1b[?1049l", stdout);
    std::fflush(stdout);
  }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  bool is_terminal() const { return terminal_; }

  void draw(const SourceTable& table) const {
    winsize size{};
    const bool sized =
        terminal_ && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 1;
    std::vector<std::string> lines = watch_lines(table, host::monotonic_now_ns(), sized ? size.ws_col : kUnlimited);
    if (sized) lines.resize(std::min<std::size_t>(lines.size(), size.ws_row - 1U));
    std::string text = terminal_ ? "\x1b[H" : "";
    for (const std::string& line : lines) text += line + (terminal_ ? "\x1b[K\n" : "\n");
    text += terminal_ ? "\x1b[J" : "\n";
    std::fputs(text.c_str(), stdout);
    if (std::fflush(stdout) != 0) throw host::InputError("standard output cannot be written");
  }

 private:
  bool terminal_;
};

int watch(const WatchOptions& options) {
  // Signals are blocked before LCM starts its own thread, which would receive them otherwise.
  host::Signals signals{SIGINT, SIGTERM};
  lcm::LCM lcm(options.url);
  SourceTable table;
  subscribe(lcm, options.url, options.channel, hear, &table);
  const Screen screen;
  host::EventLoop loop;
  host::Timer end;
  host::Timer redraw;
  redraw.start_every(screen.is_terminal() ? kRedraw : kPrint);
  if (options.duration_s > 0.0) {
    end.start(std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(options.duration_s)));
  }
  loop.watch(redraw.fd(), [&] {
    redraw.take_expiries();
    table.tick(host::utc_now_ns(), host::monotonic_now_ns());
    screen.draw(table);
  });
  loop.watch(signals.fd(), [&] { loop.stop(); });
  loop.watch(end.fd(), [&] { loop.stop(); });
  loop.watch(lcm.getFileno(), [&] {
    if (lcm.handle() != 0) loop.stop();  // the end of a file
  });
  loop.run();
  if (!screen.is_terminal()) screen.draw(table);
  return table.received() > 0 ? kExitAnswered : kExitNoAnswer;
}

}  // namespace

void add_watch(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<WatchOptions>();
  CLI::App* command =
      app.add_subcommand("watch", "All sources in a table in place: status, rate, age, pose, sigma, flags, events");
  command->add_option("CHANNEL", options->channel, "Channel, or a regular expression for several")
      ->capture_default_str();
  command->add_option("--url", options->url, "LCM URL")->capture_default_str();
  command->add_option("--duration", options->duration_s, "Stop after this many seconds (default: at Ctrl-C)")
      ->check(number_from(kShortest_s, kLongest_s));
  command->footer(
      "Example: pharos watch\n"
      "         pharos watch 'PHAROS_(TOF_POSE|STATUS)' --duration 60 > watch.log\n"
      "A row a source: BY is the station or the camera, 1/s the valid poses of the last second, AGE that of the newest "
      "one, REFUS. and\n"
      "LOST count refused cycles and gaps in the sequence. Below: each pharosd's state, what its sources lack, and the "
      "last\n"
      "events. Where standard output is no terminal the table is printed once a second.\n"
      "Ends with 0 when at least one pose, pointing or status message was received, with 1 when none was.");
  command->callback([options, &exit_code] { exit_code = watch(*options); });
}

}  // namespace pharos::tools
