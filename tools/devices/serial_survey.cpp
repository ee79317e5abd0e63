// SPDX-License-Identifier: Apache-2.0
#include "tools/devices/serial_survey.hpp"

#include <poll.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <memory>
#include <set>
#include <utility>
#include <variant>

#include "host/serial/serial_port.hpp"
#include "pharos/report/link_decoder.hpp"

namespace pharos::tools {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code ignored;
  for (fs::directory_iterator place(folder, ignored), end; !ignored && place != end; place.increment(ignored)) {
    entries.push_back(place->path());
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

const char* word_of(host::OpenError error) {
  switch (error) {
    case host::OpenError::kMissing:
      return "missing";
    case host::OpenError::kNoPermission:
      return "no_permission";
    case host::OpenError::kBusy:
      return "busy";
    case host::OpenError::kBadSpeed:
      return "bad_speed";
    case host::OpenError::kNone:
    case host::OpenError::kNotATerminal:
    case host::OpenError::kOther:
      break;
  }
  return "error";
}

// A port that is listened to.
class Listened {
 public:
  Listened(const std::string& port, int baud) {
    finding_.port = port;
    auto opened = host::SerialPort::open(port, baud);
    if (opened) {
      port_ = std::move(*opened);
    } else {
      finding_.status = word_of(opened.error().error);
      finding_.message = opened.error().message;
    }
  }

  bool waits() const { return port_.is_open() && !gone_ && !finding_.hello; }
  int fd() const { return port_.fd(); }

  void read() {
    std::array<std::uint8_t, 4096> bytes;
    const host::Transfer transfer = port_.read(bytes);
    gone_ = transfer.gone;
    bytes_ += transfer.bytes;
    for (std::size_t i = 0; i < transfer.bytes; ++i) {
      const auto event = decoder_.push(bytes[i]);
      if (!event) continue;
      ++events_;
      if (const auto* hello = std::get_if<wire::Hello>(&*event)) finding_.hello = *hello;
    }
  }

  PortFinding finding() const {
    PortFinding out = finding_;
    if (!out.status.empty()) return out;
    if (out.hello) {
      out.status = "ok";
    } else if (gone_) {
      out.status = "missing";
      out.message = "was unplugged";
    } else if (events_ > 0) {
      out.status = "no_hello";
      out.message = "sends what Pharos' boards send, but no greeting; listen longer (--seconds)";
    } else if (bytes_ > 0) {
      out.status = "unknown_data";
      out.message = "sends bytes that are no frame; another device, or another speed (--baud)";
    } else {
      out.status = "silent";
      out.message = "sends nothing; is the board powered, and its line connected?";
    }
    return out;
  }

 private:
  PortFinding finding_;
  host::SerialPort port_;
  report::LinkDecoder decoder_;
  std::size_t bytes_ = 0;
  std::size_t events_ = 0;
  bool gone_ = false;
};

// One wait for any of them; false where none is left to wait for.
bool read_some(std::vector<std::unique_ptr<Listened>>& all, int timeout_ms) {
  std::vector<pollfd> waiting;
  std::vector<Listened*> of;
  for (const auto& one : all) {
    if (!one->waits()) continue;
    waiting.push_back({one->fd(), POLLIN, 0});
    of.push_back(one.get());
  }
  if (waiting.empty()) return false;
  if (::poll(waiting.data(), waiting.size(), timeout_ms) <= 0) return true;
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    if (waiting[i].revents != 0) of[i]->read();
  }
  return true;
}

}  // namespace

std::vector<std::string> serial_ports(const fs::path& dev) {
  std::vector<fs::path> candidates;
  const auto add = [&](const fs::path& folder, std::string_view prefix) {
    for (const fs::path& entry : entries_of(folder)) {
      if (entry.filename().string().starts_with(prefix)) candidates.push_back(entry);
    }
  };
  add(dev, "pharos-");
  add(dev / "serial" / "by-id", "");
  add(dev, "ttyUSB");
  add(dev, "ttyACM");
  std::vector<std::string> ports;
  std::set<fs::path> seen;
  for (const fs::path& candidate : candidates) {
    std::error_code error;
    const fs::path device = fs::canonical(candidate, error);
    if (!error && seen.insert(device).second) ports.push_back(candidate.string());
  }
  return ports;
}

std::vector<PortFinding> survey_ports(const std::vector<std::string>& ports, int baud,
                                      std::chrono::milliseconds limit) {
  std::vector<std::unique_ptr<Listened>> all;
  for (const std::string& port : ports) all.push_back(std::make_unique<Listened>(port, baud));
  const auto deadline = steady_clock::now() + limit;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - steady_clock::now());
    if (left.count() <= 0 || !read_some(all, static_cast<int>(left.count()))) break;
  }
  std::vector<PortFinding> findings;
  for (const auto& one : all) findings.push_back(one->finding());
  return findings;
}

std::string version_of(const wire::Hello& hello) {
  return std::to_string(hello.firmware_major) + "." + std::to_string(hello.firmware_minor) + "." +
         std::to_string(hello.firmware_patch);
}

std::string serial_of(const wire::Hello& hello) {
  if (hello.unique_id == 0) return "";
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%08X", hello.unique_id);
  return text.data();
}

int sensors_of(const wire::Hello& hello) { return std::popcount(hello.sensors); }

}  // namespace pharos::tools
