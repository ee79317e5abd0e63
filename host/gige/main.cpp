// SPDX-License-Identifier: Apache-2.0
// pharos-camera: operates one GigE Vision camera for pharosd, which starts it. Faults that packets cause in the library
// that parses them stay in this process.
#include <glib.h>
#include <poll.h>
#include <sys/socket.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <exception>
#include <optional>

#include "host/camera_link/camera_message.hpp"
#include "host/camera_link/camera_process.hpp"
#include "host/gige/camera_server.hpp"
#include "host/gige/process_limits.hpp"
#include "host/gige/program_options.hpp"

namespace {

namespace host = pharos::host;

constexpr int kExitFailure = 1;
constexpr int kExitUsage = 2;
// pharosd sends the order before this program starts.
constexpr int kOrderTimeout_ms = 1000;

std::optional<host::CameraOrder> receive_order() {
  pollfd waiting{host::kCameraSocketFd, POLLIN, 0};
  if (::poll(&waiting, 1, kOrderTimeout_ms) <= 0) return std::nullopt;
  std::array<std::uint8_t, host::kMaxCameraMessage_bytes> buffer{};
  const ssize_t count = ::recv(host::kCameraSocketFd, buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (count <= 0) return std::nullopt;
  auto message = host::decode_camera_message({buffer.data(), static_cast<std::size_t>(count)});
  if (!message || !std::holds_alternative<host::CameraOrder>(*message)) return std::nullopt;
  return std::get<host::CameraOrder>(*message);
}

// GLib's last message before it aborts the process, as when memory runs out; pharosd logs it.
void tell_last_words(const char*, GLogLevelFlags level, const char* text, void*) {
  if ((level & (G_LOG_LEVEL_ERROR | G_LOG_FLAG_FATAL)) == 0 || text == nullptr) return;
  const std::vector<std::uint8_t> bytes = host::encode(host::LastWords{text});
  static_cast<void>(::send(host::kCameraSocketFd, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT) > 0);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) {
    CLI::App app("", "pharos-camera");
    host::add_camera_program_options(app);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? 0 : kExitUsage;
    }
  }
  host::bind_to_parent();
  try {
    const auto order = receive_order();
    if (!order || !host::is_child_of(order->parent_pid)) {
      std::fputs("pharos-camera: is started by pharosd, of the same version, for a camera of its configuration\n",
                 stderr);
      return kExitUsage;
    }
    host::limit_address_space(host::address_space_limit(order->settings));
    g_log_set_default_handler(tell_last_words, nullptr);
    host::CameraServer(order->settings, host::kCameraSocketFd, host::kCameraMemoryFd).run();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pharos-camera: %s\n", error.what());
    return kExitFailure;
  }
}
