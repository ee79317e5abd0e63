// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/bench_target.hpp"

#include <algorithm>
#include <cstdio>

#include "host/table/row_writer.hpp"
#include "pharos/base/ticks.hpp"
#include "tools/evaluation/bench/bench_cpu_load.hpp"
#include "tools/evaluation/bench/bench_decode.hpp"
#include "tools/evaluation/bench/bench_network.hpp"
#include "tools/evaluation/bench/target_images.hpp"
#include "tools/evaluation/bench/target_input.hpp"

namespace pharos::tools {
namespace {

constexpr double kCoreHz = 50e6;
constexpr int kTargetSensors = 12;
constexpr int kFromNothing = 50;
constexpr double kNetwork_s = 2.0;
// Cycles an instruction: of `decoder` on the simulated chip (firmware/rtl/soc); and with code in external memory,
// assumed.
constexpr double kMeasuredCycles = 1.67;
constexpr double kExternalCycles = 3.0;

double of(const TargetFigures& figures, const std::string& name) {
  const auto found = figures.find(name);
  return found == figures.end() ? 0.0 : static_cast<double>(found->second);
}

class Rows {
 public:
  void add(std::string what, double target, std::optional<double> limit, std::string unit,
           std::optional<double> host = std::nullopt, std::string host_unit = {}) {
    rows_.push_back({std::move(what), target, limit, std::move(unit), host, std::move(host_unit)});
  }
  std::vector<TargetRow> take() { return std::move(rows_); }

 private:
  std::vector<TargetRow> rows_;
};

std::string with_cycles(const std::string& what, double cycles) {
  char text[64];
  std::snprintf(text, sizeof text, " at %g cycles/instruction", cycles);
  return what + text;
}

// Load of the core in percent for so many instructions in so many ticks.
double fraction(double instructions, double ticks, double cycles) {
  return 100.0 * instructions * cycles / (ticks * kSecondsPerTick * kCoreHz);
}

void add_fractions(const TargetFigures& light, Rows& rows) {
  const double decoding = of(light, "edge_sum"), tracking = of(light, "track_sum"), ticks = of(light, "ticks");
  for (const double cycles : {1.0, kMeasuredCycles, kExternalCycles}) {
    rows.add(with_cycles("share of the core: decoder", cycles), fraction(decoding, ticks, cycles),
             cycles == kMeasuredCycles ? std::optional<double>(10.0) : std::nullopt, "%");
    rows.add(with_cycles("share of the core: decoder and poses", cycles), fraction(decoding + tracking, ticks, cycles),
             cycles == kExternalCycles ? std::optional<double>(100.0) : std::nullopt, "%");
  }
}

void add_flying(const std::filesystem::path& images, Rows& rows) {
  const std::string what = "share of the core: flying decoder with frames and line";
  for (const double cycles : {1.0, kMeasuredCycles, kExternalCycles}) {
    const CpuLoad fraction = cpu_load(images, cycles);
    rows.add(with_cycles(what, cycles), fraction.percent,
             cycles == kMeasuredCycles ? std::optional<double>(15.0) : std::nullopt, "%");
    if (cycles == kExternalCycles) rows.add("flying decoder: edges lost and frames skipped", fraction.lost, 0.0, "");
  }
}

void add_sizes(const std::filesystem::path& images, Rows& rows) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(images, error)) {
    const std::string name = entry.path().stem().string();
    const bool flies = name.rfind("decoder", 0) == 0 || name.find("_loader") != std::string::npos;
    if (entry.path().extension() == ".elf" && flies) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) {
    const auto sizes = image_sizes(images, name);
    if (!sizes) continue;
    rows.add(name + ": code and constants", static_cast<double>(sizes->code_and_constants), std::nullopt, "bytes");
    rows.add(name + ": data and stack", static_cast<double>(sizes->data + sizes->stack), std::nullopt, "bytes");
  }
}

void add_edges(const TargetFigures& light, double host_ns, Rows& rows) {
  rows.add("instructions an edge: median", of(light, "edge_median"), 250.0, "instructions", host_ns, "ns");
  rows.add("instructions an edge: mean", of(light, "edge_sum") / of(light, "edge_number"), std::nullopt,
           "instructions");
  rows.add("instructions an edge: 99 %", of(light, "edge_99_percent"), std::nullopt, "instructions");
  rows.add("instructions an edge: worst", of(light, "edge_worst"), std::nullopt, "instructions");
}

void add_poses(const TargetFigures& pose, const PoseInput& input, Rows& rows) {
  rows.add("instructions a pose of 8 sensors from the last one: median", of(pose, "warm_median"), 250e3, "instructions",
           input.host_warm_us, "us");
  rows.add("from the last one: worst", of(pose, "warm_worst"), std::nullopt, "instructions");
  rows.add("from the last one: farthest from the host's answer", 1e-6 * of(pose, "farthest_sigma_millionths"), 0.1,
           "sigma");
  rows.add("from the last one: flagged otherwise than the host", of(pose, "other_flags"), 0.0, "poses");
  rows.add("instructions a pose of 8 sensors from nothing: median", of(pose, "nothing_median"), 4e6, "instructions",
           input.host_nothing_us, "us");
  rows.add("from nothing: worst", of(pose, "nothing_worst"), std::nullopt, "instructions");
  rows.add("stack of a pose in integers; of one from nothing", of(pose, "stack_of_integers"), std::nullopt, "bytes",
           of(pose, "stack"), "bytes");
}

// Sweeps of eight hits of two stations: cost of a hit with everything included, starts and checks too.
void add_motion(const std::filesystem::path& images, Rows& rows) {
  constexpr int kHits = 8;
  const TargetFigures motion = run_image(images, "measure_motion", simulated_light(kHits));
  for (const std::string how : {"alone", "fused"}) {
    const std::string name = how == "alone" ? "motion-aware, one station" : "motion-aware, two stations fused";
    rows.add(name + ": instructions a hit, mean", of(motion, how + "_sum") / of(motion, "hits_" + how), std::nullopt,
             "instructions");
    rows.add(name + ": instructions a sweep of 8 hits, worst", of(motion, how + "_worst"), std::nullopt,
             "instructions");
  }
  rows.add("motion tracker object", of(motion, "tracker_bytes"), std::nullopt, "bytes");
}

// The same poses on both sides; the start and the checks are in the mean.
void add_network(const std::filesystem::path& images, Rows& rows) {
  const NetworkFlight flight = network_flight(kNetwork_s);
  const TargetFigures network = run_image(images, "measure_network", network_hits(flight));
  const NetworkRun host = run_network(flight);
  rows.add("stations of a room: instructions a hit of two stations: mean",
           of(network, "hit_sum") / of(network, "hit_number"), std::nullopt, "instructions", host.cost_us, "us");
  rows.add("stations of a room: instructions a sweep: median", of(network, "sweep_median"), std::nullopt,
           "instructions");
  rows.add("stations of a room: instructions a sweep: worst", of(network, "sweep_worst"), std::nullopt, "instructions");
  rows.add("stations of a room: sweeps answered", of(network, "answered"), std::nullopt, "", host.answered, "");
  rows.add("tracker of a room: object", of(network, "tracker_bytes"), std::nullopt, "bytes");
}

// Light of Lighthouse 2.0, once a block in logic delivers the changes.
void add_lh2(const std::filesystem::path& images, Rows& rows) {
  const TargetFigures lh2 = run_image(images, "measure_lh2", simulated_light(1));
  const auto add = [&](const char* what, const std::string& name) {
    rows.add(std::string("Lighthouse 2.0: ") + what + ": median", of(lh2, name + "_median"), std::nullopt,
             "instructions");
    rows.add(std::string("Lighthouse 2.0: ") + what + ": worst", of(lh2, name + "_worst"), std::nullopt,
             "instructions");
  };
  add("bits of a burst", "lh2_bits");
  add("a burst of a known station", "lh2_known");
  add("a burst among all channels", "lh2_unknown");
  add("place of 17 bits", "lh2_search");
  rows.add("Lighthouse 2.0: sequences and decoder", of(lh2, "lh2_sequences_bytes"), std::nullopt, "bytes",
           of(lh2, "lh2_decoder_bytes"), "bytes");
}

double host_ns_an_edge(const std::string& edges) {
  constexpr double kEdgesAPulse = 2.0;
  return 1e3 / bench_decode(edges).front().ours / kEdgesAPulse;  // of M pulses/s
}

}  // namespace

std::vector<TargetRow> bench_target(const TargetBench& options) {
  const std::filesystem::path images = find_images(options.images);
  Rows rows;
  const TargetFigures simulated = run_image(images, "measure_light", simulated_light(kTargetSensors));
  const bool recorded = !options.edges.empty();
  const TargetFigures light = recorded ? run_image(images, "measure_light", recorded_light(options.edges)) : simulated;
  add_edges(light, host_ns_an_edge(options.edges), rows);
  const PoseInput input =
      pose_problems(test::frustum_target(), 8, 8, options.problems, std::min(options.problems, kFromNothing));
  add_poses(run_image(images, "measure_pose", input.bytes), input, rows);
  add_motion(images, rows);
  add_network(images, rows);
  add_lh2(images, rows);
  add_fractions(simulated, rows);
  add_flying(images, rows);
  rows.add("decoder object", of(simulated, "decoder_bytes"), std::nullopt, "bytes");
  rows.add("tracker object", of(simulated, "tracker_bytes"), std::nullopt, "bytes");
  add_sizes(images, rows);
  return rows.take();
}

std::vector<TargetRow> bench_target_by_sensors(const TargetBench& options) {
  constexpr int kFewFromNothing = 20;
  const std::filesystem::path images = find_images(options.images);
  Rows rows;
  for (const int sensors : {4, 8, 12, 16, 24, 32}) {
    const std::string name = std::to_string(sensors) + " sensors: ";
    const TargetFigures light = run_image(images, "measure_light", simulated_light(sensors));
    const PoseInput input = pose_problems(dome_target(sensors), sensors, sensors, options.problems,
                                          std::min(options.problems, kFewFromNothing));
    const TargetFigures pose = run_image(images, "measure_pose", input.bytes);
    const double ticks = of(light, "ticks");
    rows.add(name + "edges a second", of(light, "edge_number") / (ticks * kSecondsPerTick), std::nullopt, "1/s");
    rows.add(name + "instructions an edge: mean", of(light, "edge_sum") / of(light, "edge_number"), std::nullopt,
             "instructions");
    rows.add(name + "instructions a pose from the last one: median", of(pose, "warm_median"), std::nullopt,
             "instructions", input.host_warm_us, "us");
    rows.add(name + "instructions a pose from nothing: median", of(pose, "nothing_median"), std::nullopt,
             "instructions", input.host_nothing_us, "us");
    rows.add(name + with_cycles("share of the core: decoder", kMeasuredCycles),
             fraction(of(light, "edge_sum"), ticks, kMeasuredCycles), std::nullopt, "%");
    rows.add(name + with_cycles("share of the core: decoder and poses", kExternalCycles),
             fraction(of(light, "edge_sum") + of(light, "track_sum"), ticks, kExternalCycles), std::nullopt, "%");
  }
  return rows.take();
}

}  // namespace pharos::tools
