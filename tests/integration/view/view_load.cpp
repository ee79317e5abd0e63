// SPDX-License-Identifier: Apache-2.0
// usage: view_load SECONDS [TARGETS [VIEWERS]]: the load of `pharos view`: two stations' poses and bearings of each
// target at 60 Hz, five cameras at 10 Hz with two pictures a second each, and viewers that take every state and
// picture.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "host/support/unique_fd.hpp"
#include "integration/child_process.hpp"
#include "pharos/bearings_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/preview_t.hpp"

namespace {

using pharos::host::ChildProcess;
using pharos::host::UniqueFd;
using Clock = std::chrono::steady_clock;

struct Usage {
  double processor_s = 0.0;
  double resident_mib = 0.0;
};

Usage usage_of(int pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  std::getline(file, line);
  std::istringstream fields(line.substr(line.rfind(')') + 2));
  std::vector<std::string> all;
  for (std::string field; fields >> field;) all.push_back(field);
  const double ticks = std::stod(all[11]) + std::stod(all[12]);
  const double pages = std::stod(all[21]);
  return {ticks / static_cast<double>(::sysconf(_SC_CLK_TCK)),
          pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1048576.0};
}

UniqueFd connected(int port) {
  UniqueFd client(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(client.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) std::exit(2);
  return client;
}

bool ask(const UniqueFd& client, int port, const std::string& path) {
  const std::string text = "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n\r\n";
  return ::send(client.get(), text.data(), text.size(), MSG_NOSIGNAL) >= 0;
}

UniqueFd viewer(int port) {
  UniqueFd client = connected(port);
  if (!ask(client, port, "/states")) std::exit(2);
  return client;
}

// Reads one answer with a picture; false where it is none or the connection ended.
bool take_picture(const UniqueFd& client) {
  std::string text;
  std::vector<char> buffer(1 << 16);
  for (std::size_t whole = 0; whole == 0 || text.size() < whole;) {
    const ssize_t count = ::recv(client.get(), buffer.data(), buffer.size(), 0);
    if (count <= 0) return false;
    text.append(buffer.data(), static_cast<std::size_t>(count));
    const std::size_t head = text.find("\r\n\r\n"), length = text.find("Content-Length: ");
    if (head != std::string::npos && length != std::string::npos) {
      whole = head + 4 + static_cast<std::size_t>(std::atol(text.c_str() + length + 16));
    }
  }
  return text.find("image/jpeg") != std::string::npos;
}

// As a page: the picture of every camera twice a second.
void take_pictures(const UniqueFd& client, int port, const std::atomic<bool>& stopping, std::atomic<int>& pictures) {
  while (!stopping) {
    for (int camera = 0; camera < 5; ++camera) {
      if (!ask(client, port, "/preview/" + std::to_string(camera))) return;
      pictures += take_picture(client) ? 1 : 0;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  }
}

pharos::pose_t pose_of(int target, int station, std::int64_t k) {
  pharos::pose_t pose{};
  pose.utime =
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count();
  pose.sequence = 2 * k + station;
  pose.source = "lighthouse/chaser";
  pose.target = "target" + std::to_string(target);
  pose.station = static_cast<std::int8_t>(station);
  pose.station_or_camera = station == 0 ? "C33B4DE1" : "BEC08E38";
  pose.parent_frame = "lighthouse";
  pose.child_frame = "body";
  pose.status = "ok";
  pose.flags = "prior";
  pose.valid = 1;
  pose.position_m[0] = std::sin(static_cast<double>(k) * 0.01 + target);
  pose.position_m[2] = 2.5 + std::cos(static_cast<double>(k) * 0.013);
  pose.orientation_wxyz[0] = 1.0;
  pose.covariance[21] = pose.covariance[28] = pose.covariance[35] = 1.234567e-6;
  pose.sigma_pos_m = 1.23456e-3;
  pose.residual_rms_rad = 3.2101e-5;
  return pose;
}

pharos::bearings_t bearings_of(const pharos::pose_t& pose) {
  pharos::bearings_t bearings{};
  bearings.utime = pose.utime;
  bearings.source = pose.source;
  bearings.target = pose.target;
  bearings.station = pose.station;
  for (int k = 0; k < 24; ++k) {  // twelve sensors
    pharos::bearing_t bearing{};
    bearing.sensor = static_cast<std::int8_t>(k / 2);
    bearing.axis = static_cast<std::int8_t>(k % 2);
    bearing.ideal_theta_rad = 1.5 + 0.001 * k + 0.01 * pose.position_m[0];
    bearing.used = 1;
    bearings.bearings.push_back(bearing);
  }
  bearings.count = 24;
  return bearings;
}

// As large as pictures are at most.
pharos::preview_t preview_of(const pharos::pose_t& pose) {
  pharos::preview_t preview{};
  preview.utime = pose.utime;
  preview.sequence = pose.sequence / 3;
  preview.source = pose.source;
  preview.target = pose.target;
  preview.status = "ok";
  preview.width_px = 640;
  preview.height_px = 480;
  preview.format = "jpeg";
  preview.data.assign(32 * 1024, 0x55);
  preview.data[0] = preview.data[preview.data.size() - 2] = 0xFF;
  preview.data[1] = 0xD8;
  preview.data.back() = 0xD9;
  preview.size = static_cast<std::int32_t>(preview.data.size());
  return preview;
}

void publish_cycle(lcm::LCM& lcm, int targets, std::int64_t k) {
  for (int target = 0; target < targets; ++target) {
    for (int station = 0; station < 2; ++station) {
      const pharos::pose_t pose = pose_of(target, station, k);
      const pharos::bearings_t bearings = bearings_of(pose);
      lcm.publish("PHAROS_LIGHTHOUSE_POSE", &pose);
      lcm.publish("PHAROS_LIGHTHOUSE_BEARINGS", &bearings);
    }
  }
  for (int camera = 0; camera < 5 && k % 6 == 0; ++camera) {
    pharos::pose_t pose = pose_of(camera, 0, k);
    pose.source = "tof/camera" + std::to_string(camera);
    pose.sequence = k / 6;
    lcm.publish("PHAROS_TOF_POSE", &pose);
    if (k % 30 != 0) continue;
    const pharos::preview_t preview = preview_of(pose);
    lcm.publish("PHAROS_PREVIEW", &preview);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 20.0;
  const int targets = argc > 2 ? std::atoi(argv[2]) : 32;
  const int viewer_count = argc > 3 ? std::atoi(argv[3]) : 3;
  const std::string url = "udpm://239.255.76.67:" + std::to_string(20000 + ::getpid() % 10000) + "?ttl=0";
  ChildProcess view({PHAROS, "view", "--port", "0", "--url", url});
  if (!view.wait_for("/\n")) return 2;
  const int port = std::atoi(view.text().c_str() + view.text().find("127.0.0.1:") + 10);
  lcm::LCM lcm(url);
  std::vector<std::thread> readers;
  std::vector<UniqueFd> viewers;
  std::vector<std::size_t> bytes(static_cast<std::size_t>(viewer_count)), states(bytes);
  for (int k = 0; k < viewer_count; ++k) viewers.push_back(viewer(port));
  for (std::size_t k = 0; k < viewers.size(); ++k) {
    readers.emplace_back([&, k] {
      std::vector<char> buffer(1 << 20);
      for (ssize_t count = 0; (count = ::recv(viewers[k].get(), buffer.data(), buffer.size(), 0)) > 0;) {
        const std::string_view text(buffer.data(), static_cast<std::size_t>(count));
        bytes[k] += text.size();
        for (std::size_t at = 0; (at = text.find("data: ", at)) != std::string_view::npos; ++at) ++states[k];
      }
    });
  }
  std::atomic<bool> stopping = false;
  std::atomic<int> pictures = 0;
  std::vector<std::thread> page_threads;
  std::vector<UniqueFd> page_connections;
  const auto open_pages = [&] {
    for (int k = 0; k < viewer_count; ++k) page_connections.push_back(connected(port));
    for (const UniqueFd& connection : page_connections) {
      page_threads.emplace_back([&] { take_pictures(connection, port, stopping, pictures); });
    }
  };
  const auto play = [&](double duration_s) {
    const auto start = Clock::now();
    for (std::int64_t k = 0; std::chrono::duration<double>(Clock::now() - start).count() < duration_s; ++k) {
      publish_cycle(lcm, targets, k);
      std::this_thread::sleep_until(start + std::chrono::microseconds(k * 1'000'000 / 60));
    }
  };
  play(3.0);  // all rows and pictures are there
  open_pages();
  const Usage before = usage_of(view.pid());
  const auto bytes_before = bytes;
  const auto states_before = states;
  std::array<double, 4> quarters{};  // resident after each, MiB
  for (double& resident_mib : quarters) {
    play(seconds / 4);
    resident_mib = usage_of(view.pid()).resident_mib;
    std::fprintf(stderr, "resident %.2f MiB\n", resident_mib);
  }
  const Usage after = usage_of(view.pid());
  std::printf("%d targets, two stations each, five cameras; %d viewers; %.0f s; %.1f pictures/s taken\n", targets,
              viewer_count, seconds, pictures / seconds);
  std::printf("processor: %.1f %% of one core; resident %.2f MiB, after each quarter %.2f %.2f %.2f %.2f\n",
              100.0 * (after.processor_s - before.processor_s) / seconds, before.resident_mib, quarters[0], quarters[1],
              quarters[2], quarters[3]);
  for (std::size_t k = 0; k < viewers.size(); ++k) {
    std::printf("viewer %zu: %.1f states/s, %.0f kB/s\n", k,
                static_cast<double>(states[k] - states_before[k]) / seconds,
                static_cast<double>(bytes[k] - bytes_before[k]) / seconds / 1e3);
    ::shutdown(viewers[k].get(), SHUT_RDWR);
  }
  stopping = true;
  for (std::thread& page : page_threads) page.join();
  for (std::thread& reader : readers) reader.join();
  return 0;
}
