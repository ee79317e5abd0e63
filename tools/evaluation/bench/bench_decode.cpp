// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/bench_decode.hpp"

#include <unistd.h>

#include <filesystem>
#include <memory>

#include "host/support/input_error.hpp"
#include "host/table/edges_reader.hpp"
#include "pharos/lighthouse/decoder.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"
#include "tools/sim/recording_writer.hpp"
#include "tools/support/stopwatch.hpp"

namespace pharos::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kRepeats = 9;
constexpr double kMillion = 1e6;

// A folder that is removed at the end of the benchmark.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((fs::temp_directory_path() / "pharos-bench-XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) throw host::InputError(path_ + ": cannot make a temporary folder");
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string simulate(const TemporaryFolder& folder) {
  sim::LighthouseScenario scenario;
  scenario.duration_s = 60.0;
  scenario.target = test::frustum_target();
  scenario.stations.emplace_back();
  const Matrix3 facing = Vector3(1.0, -1.0, -1.0).asDiagonal();
  scenario.trajectory = std::make_shared<sim::StationaryTrajectory>(
      std::vector<sim::RoomFromBody>{{facing, {0.2, -0.15, 2.0}}}, scenario.duration_s, 0.0);
  sim::write_recording(scenario, 1, folder.path());
  return folder.path() + "/edges.csv.gz";
}

std::vector<lighthouse::RawPulse> read_all(const std::string& path) {
  host::EdgesReader reader{host::ByteSource(path)};
  std::vector<lighthouse::RawPulse> pulses;
  while (const auto pulse = reader.next()) pulses.push_back(*pulse);
  return pulses;
}

// Reads the decoder's results, so that its queues never fill.
class Sink {
 public:
  void push(const lighthouse::RawPulse& pulse) {
    decoder_->push(pulse);
    while (decoder_->take_sweep()) ++sweeps_;
    while (decoder_->take_ootx()) ++sweeps_;
  }
  std::size_t sweeps() const { return sweeps_; }

 private:
  std::unique_ptr<lighthouse::Decoder> decoder_ = std::make_unique<lighthouse::Decoder>();
  std::size_t sweeps_ = 0;
};

}  // namespace

std::vector<BenchRow> bench_decode(const std::string& edges) {
  const TemporaryFolder folder;
  const std::string path = edges.empty() ? simulate(folder) : edges;
  const std::vector<lighthouse::RawPulse> pulses = read_all(path);
  if (pulses.empty()) throw host::InputError(path + ": holds no pulses to decode; give a longer recording");
  double memory_s = 1e9, file_s = 1e9;
  for (int k = 0; k < kRepeats; ++k) {
    memory_s = std::min(memory_s, seconds_of([&] {
                          Sink sink;
                          for (const lighthouse::RawPulse& pulse : pulses) sink.push(pulse);
                        }));
    file_s = std::min(file_s, seconds_of([&] {
                        host::EdgesReader reader{host::ByteSource(path)};
                        Sink sink;
                        while (const auto pulse = reader.next()) sink.push(*pulse);
                      }));
  }
  const double count = static_cast<double>(pulses.size()) / kMillion;
  return {{"decoding from memory", count / memory_s, std::nullopt, "M pulses/s", false},
          {"decoding from a file", count / file_s, std::nullopt, "M pulses/s", false}};
}

}  // namespace pharos::tools
