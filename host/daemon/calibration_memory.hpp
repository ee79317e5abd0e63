// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pharos/lighthouse/station_calibration.hpp"

namespace pharos::host {

/// How often the file could not be written, how many calibrations made room for others or were none of any station, and
/// how many files were damaged.
struct MemoryCounters {
  std::int64_t write_failures = 0;
  std::int64_t dropped = 0;
  std::int64_t damaged_files = 0;
};

/// Station calibrations that were accepted once, by station id, kept in `stations.toml` across restarts.
///
/// The file has the form that `pharos track --calibration FILE` takes. It is replaced whole
/// (AtomicFile), so a reader and a program that dies see the old one or the new one. It is not synced: see README.md.
class CalibrationMemory {
 public:
  /// More stations than a site has, and each target's own store takes only the newest eight; ids are what a target says
  /// they are, so there must be an end. The file stays below 32 KiB.
  static constexpr std::size_t kMaxStations = 64;
  /// After a failure the file is tried again so much later.
  static constexpr std::int64_t kRetry_ns = 10'000'000'000;

  /// An empty `directory` keeps nothing.
  explicit CalibrationMemory(const std::filesystem::path& directory);

  /// Reads the file; none there is an empty memory. One that cannot be read or is not what pharosd wrote
  /// is renamed to stations.toml.damaged and counted, and an InputError says so; the memory is empty then.
  void load();
  /// Oldest acceptance first.
  const std::vector<lighthouse::StationCalibration>& stations() const { return stations_; }
  /// Puts `calibration` last, in the place of the one of the same id; the first makes room where there is none. Writes
  /// nothing: cheap between two cycles.
  void keep(const lighthouse::StationCalibration& calibration);
  /// Writes the file where it does not hold what was kept; after a failure only once kRetry_ns have passed.
  void save(std::int64_t monotonic_ns);
  /// The same without waiting: there is no later time.
  void save_at_last();

  /// Why the file does not hold what was kept, one line for a person; empty when all is well.
  const std::string& error() const { return error_; }
  const MemoryCounters& counters() const { return counters_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  void read();
  std::string set_aside() const;
  void write();
  void drop_oldest();

  std::filesystem::path file_;
  std::vector<lighthouse::StationCalibration> stations_;
  bool unsaved_ = false;
  std::int64_t retry_at_ns_ = 0;
  std::string error_;
  MemoryCounters counters_;
};

}  // namespace pharos::host
