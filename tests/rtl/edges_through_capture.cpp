// SPDX-License-Identifier: Apache-2.0
// A recording through the simulated capture block: from EDGES to the words that the firmware would read.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "host/support/input_error.hpp"
#include "host/table/edges_reader.hpp"
#include "pharos/base/ticks.hpp"
#include "rtl/edges_player.hpp"

namespace pharos::rtl {
namespace {

struct Arguments {
  std::string edges;
  std::string output;
  double from_s = 0.0;
  double seconds = 1e9;
  unsigned sensors = 32;
  bool hex = false;
  PlayOptions play;
};

std::vector<lighthouse::RawPulse> chosen_pulses(const Arguments& arguments) {
  host::EdgesReader reader{host::ByteSource(arguments.edges)};
  std::vector<lighthouse::RawPulse> pulses;
  std::int64_t start = INT64_MAX;
  while (const auto pulse = reader.next()) {
    pulses.push_back(*pulse);
    start = std::min(start, pulse->rise_ticks);
  }
  std::erase_if(pulses, [&](const lighthouse::RawPulse& pulse) {
    const double at_s = ticks_to_seconds(pulse.rise_ticks - start);
    return at_s < arguments.from_s || at_s >= arguments.from_s + arguments.seconds || pulse.sensor >= arguments.sensors;
  });
  return pulses;
}

void write_words(const Arguments& arguments, const PlayedEdges& played) {
  std::ofstream file(arguments.output, std::ios::binary);
  for (const RecordWords& record : played.records) {
    const std::array words{record.status, record.time, record.changed, record.levels};
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (arguments.hex) {
        std::array<char, 16> text{};
        std::snprintf(text.data(), text.size(), "%08x%c", words[i], i + 1 == words.size() ? '\n' : ' ');
        file << text.data();
      } else {
        for (unsigned shift = 0; shift < 32; shift += 8) file.put(static_cast<char>(words[i] >> shift & 0xFF));
      }
    }
  }
  file.close();
  if (!file) throw host::InputError(arguments.output + ": cannot be written");
}

int run(const Arguments& arguments) {
  const auto pulses = chosen_pulses(arguments);
  const auto begin = std::chrono::steady_clock::now();
  const PlayedEdges played = play_edges(pulses, arguments.play);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write_words(arguments, played);
  std::fprintf(stderr,
               "%zu pulses, %zu left out, %zu records, %u edges lost, worst fill %u; %.1f M ticks at %.1f M/s\n",
               pulses.size(), played.pulses_left_out, played.records.size(), played.lost_edges, played.worst_fill,
               static_cast<double>(played.simulated_ticks) * 1e-6,
               static_cast<double>(played.simulated_ticks) * 1e-6 / std::max(seconds, 1e-9));
  return played.records.empty() ? 1 : 0;
}

}  // namespace
}  // namespace pharos::rtl

int main(int count, char** values) {
  pharos::rtl::Arguments arguments;
  CLI::App app{
      "Puts a recording on the pins of the simulated capture block and writes what firmware reads from its FIFO:\n"
      "four 32-bit words a record, little-endian: STATUS, FIFO_TIME, FIFO_CHANGED, FIFO_LEVELS.\n"
      "Example: edges_through_capture hmd_static.edges.csv.gz --from 2 --seconds 1 --output words.bin"};
  app.add_option("EDGES", arguments.edges, "table sensor,rise_ticks,fall_ticks, or - for standard input")->required();
  app.add_option("--output", arguments.output, "file for the words")->required();
  app.add_option("--from", arguments.from_s, "seconds to leave out at the beginning");
  app.add_option("--seconds", arguments.seconds, "seconds to play");
  app.add_option("--sensors", arguments.sensors, "play sensors below this number")->check(CLI::Range(1, 32));
  app.add_option("--service-ticks", arguments.play.service_ticks,
                 "ticks between two looks of the reader, a record each")
      ->check(CLI::Range(8, 100'000'000));
  app.add_flag("--hex", arguments.hex, "write text: four words of hexadecimal digits a line");
  app.add_flag("!--every-tick", arguments.play.skip_idle, "simulate idle ticks too");
  CLI11_PARSE(app, count, values);
  try {
    return pharos::rtl::run(arguments);
  } catch (const pharos::host::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
