// SPDX-License-Identifier: Apache-2.0
#include <sys/random.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <memory>

#include "host/runtime/event_loop.hpp"
#include "host/runtime/now.hpp"
#include "host/runtime/signals.hpp"
#include "host/runtime/timer.hpp"
#include "host/support/input_error.hpp"
#include "host/table/target_file.hpp"
#include "tools/listen/subscription.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output.hpp"
#include "tools/view/http_server.hpp"
#include "tools/view/log_player.hpp"
#include "tools/view/state_json.hpp"

namespace pharos::tools {
namespace {

// The eye sees no more, and a browser draws no more on a small computer.
constexpr std::chrono::nanoseconds kFrame{1'000'000'000 / 30};
// Ages and lights change also where nothing comes.
constexpr int kFramesAtRest = 10;
// Messages that arrive in a frame: 32 targets tell 8000 a second, with room for a pause of a second.
constexpr int kQueue = 10'000;
constexpr std::uint16_t kDefaultPort = 7668;
constexpr std::size_t kTokenBytes = 16;
constexpr std::size_t kMinToken = 16;
constexpr std::size_t kMaxToken = 128;
constexpr double kShortest_s = 1e-3;
constexpr double kLongest_s = 1e9;

struct ViewOptions {
  std::string channel = "PHAROS_.*";
  std::string url = kDefaultUrl;
  std::string listen = "127.0.0.1";
  int port = kDefaultPort;
  std::string token_file;
  std::string log;
  std::vector<std::string> targets;
  double duration_s = 0.0;
};

std::string random_token() {
  std::array<unsigned char, kTokenBytes> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw host::InputError("no random numbers for a token; give --token-file");
  }
  std::string text;
  for (const unsigned char byte : bytes) {
    text += "0123456789abcdef"[byte / 16];
    text += "0123456789abcdef"[byte % 16];
  }
  return text;
}

std::string read_token(const std::string& path) {
  std::ifstream file(path);
  std::string token;
  std::getline(file, token);
  const bool plain =
      token.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ-_.") == std::string::npos;
  if (!file || token.size() < kMinToken || token.size() > kMaxToken || !plain) {
    throw host::InputError(path + ": its first line must be a token of 16 to 128 letters, digits, '-', '_', '.'");
  }
  return token;
}

std::map<std::string, Target> read_targets(const std::vector<std::string>& options) {
  std::map<std::string, Target> targets;
  for (const std::string& option : options) {
    const std::size_t equals = option.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw host::InputError("--target " + option +
                             ": give NAME=FILE, with the target's name in pharosd's configuration");
    }
    targets[option.substr(0, equals)] = host::read_target(option.substr(equals + 1)).target;
  }
  return targets;
}

HttpServer::Settings settings_of(const ViewOptions& options, bool loopback) {
  HttpServer::Settings settings;
  settings.address = options.listen;
  settings.port = static_cast<std::uint16_t>(options.port);
  settings.has_controls = !options.log.empty();
  settings.targets = targets_json(read_targets(options.targets));
  if (!options.token_file.empty()) {
    settings.token = read_token(options.token_file);
  } else if (!loopback) {
    settings.token = random_token();
  }
  return settings;
}

bool is_loopback(const std::string& address) { return address.starts_with("127.") || address == "::1"; }

void print_address(const ViewOptions& options, const HttpServer& server, const std::string& token) {
  const bool all = options.listen == "0.0.0.0" || options.listen == "::";
  std::string host = all ? "127.0.0.1" : options.listen;
  if (host.find(':') != std::string::npos) host = '[' + host + ']';
  std::printf("http://%s:%u/%s\n", host.c_str(), server.port(), token.empty() ? "" : ("?token=" + token).c_str());
  std::fflush(stdout);
  if (!server.is_loopback()) {
    note("warning: everyone on the network who knows this address sees the page; it travels unencrypted" +
         std::string(all ? ". Elsewhere write this computer's address instead of 127.0.0.1" : ""));
  }
}

/// The sources live, or those of a log; and what the page is told of them.
class Feed {
 public:
  explicit Feed(const ViewOptions& options) {
    if (!options.log.empty()) {
      player_ = std::make_unique<LogPlayer>(options.log);
      return;
    }
    if (options.url.starts_with("file:"))
      throw host::InputError("--url " + options.url + ": replay a log with --log FILE");
    lcm_ = std::make_unique<lcm::LCM>(options.url);
    subscribe(*lcm_, options.url, options.channel, &Feed::hear, &live_, kQueue);
  }

  /// Takes what came since the last frame. Not when each message comes: that would wake the program 8000 times a
  /// second.
  void advance(double elapsed_s) {
    if (player_) return player_->advance(elapsed_s);
    for (int i = 0; i < kQueue && lcm_->handleTimeout(0) > 0; ++i) {
    }
    live_.tick(host::utc_now_ns(), host::monotonic_now_ns());
  }

  void control(const ControlRequest& request) {
    if (player_) player_->control(request);
  }

  std::string state(const HttpServer& server) const {
    ViewContext context;
    context.viewers = server.viewers();
    context.refused_requests = server.refused();
    if (!player_) {
      context.utc_ns = host::utc_now_ns();
      context.now_ns = host::monotonic_now_ns();
      return state_json(live_, context);
    }
    context.utc_ns = context.now_ns = player_->utc_ns();
    context.replay = player_->state();
    return state_json(player_->table(), context);
  }

  HttpServer::Picture preview(std::size_t number) const {
    const std::vector<CameraPreview>& previews = (player_ ? player_->table() : live_).previews();
    return number < previews.size() ? previews[number].jpeg : nullptr;
  }

  std::int64_t received() const { return player_ ? player_->table().received() : live_.received(); }

 private:
  static void hear(const lcm_recv_buf_t* buffer, const char* channel, void* table) {
    static_cast<SourceTable*>(table)->take(channel, buffer->data, static_cast<int>(buffer->data_size),
                                           host::utc_now_ns(), host::monotonic_now_ns());
  }

  std::unique_ptr<lcm::LCM> lcm_;
  std::unique_ptr<LogPlayer> player_;
  SourceTable live_;
};

void serve(Feed& feed, HttpServer& server, host::Signals& signals, double duration_s) {
  host::EventLoop loop;
  host::Timer frame;
  host::Timer end;
  frame.start_every(kFrame);
  if (duration_s > 0.0) {
    end.start(std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(duration_s)));
  }
  std::int64_t shown = -1;
  int rests = 0;
  loop.watch(frame.fd(), [&] {
    const auto frames = static_cast<double>(frame.take_expiries());
    feed.advance(frames * std::chrono::duration<double>(kFrame).count());
    server.tick();
    const bool fresh = feed.received() != shown || ++rests >= kFramesAtRest;
    if (!fresh || server.viewers() == 0) return;
    shown = feed.received();
    rests = 0;
    server.publish(feed.state(server));
  });
  loop.watch(server.listen_fd(), [&] { server.accept(); });
  loop.watch(server.work_fd(), [&] { server.work(); });
  loop.watch(signals.fd(), [&] { loop.stop(); });
  loop.watch(end.fd(), [&] { loop.stop(); });
  loop.run();
}

int view(const ViewOptions& options) {
  // Signals are blocked before LCM starts its own thread, which would receive them otherwise.
  host::Signals signals{SIGINT, SIGTERM};
  std::signal(SIGPIPE, SIG_IGN);  // a viewer that goes is no reason to end
  Feed feed(options);
  const HttpServer::Settings settings = settings_of(options, is_loopback(options.listen));
  HttpServer server(
      settings, [&feed](const ControlRequest& request) { feed.control(request); },
      [&feed](std::size_t number) { return feed.preview(number); });
  print_address(options, server, settings.token);
  serve(feed, server, signals, options.duration_s);
  return feed.received() > 0 ? kExitAnswered : kExitNoAnswer;
}

}  // namespace

void add_view(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* command =
      app.add_subcommand("view", "All sources live on a page for the browser: scene, plots, lights, events");
  command->add_option("CHANNEL", options->channel, "Channel, or a regular expression for several")
      ->capture_default_str();
  command->add_option("--url", options->url, "LCM URL")->capture_default_str();
  auto* log = command->add_option("--log", options->log, "Replay this log of lcm-logger instead, with a time slider");
  log->excludes("--url");
  command->add_option("--port", options->port, "Port of the page; 0 takes any free one")
      ->capture_default_str()
      ->check(CLI::Range(0, 65535));
  command->add_option("--listen", options->listen, "Address to serve on; any but this computer's own requires a token")
      ->capture_default_str();
  command->add_option("--token-file", options->token_file,
                      "File with the token in its first line (default: a new one each time, with --listen)");
  command
      ->add_option("--target", options->targets,
                   "NAME=FILE: sensor positions of a target, to draw its sensors where they are; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--duration", options->duration_s, "Stop after this many seconds (default: at Ctrl-C)")
      ->check(number_from(kShortest_s, kLongest_s));
  command->footer(
      "Example: pharos view\n"
      "         pharos view --target dock=target.csv\n"
      "         pharos view --log lcmlog-2026-11-23.00\n"
      "         pharos view --listen 0.0.0.0 --port 8080\n"
      "Prints the page's address. On the page, ? shows the keys.\n"
      "Ends with 0 when at least one pose, pointing or status message was received, with 1 when none was.");
  command->callback([options, &exit_code] { exit_code = view(*options); });
}

}  // namespace pharos::tools
