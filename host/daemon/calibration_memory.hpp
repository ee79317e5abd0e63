// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pharos/lighthouse/station_calibration.hpp"

namespace pharos::host {

/// Counts: failed writes of the file, calibrations that were dropped for newer ones or were implausible, damaged files.
struct MemoryCounters {
  std::int64_t write_failures = 0;
  std::int64_t dropped = 0;
  std::int64_t damaged_files = 0;
};

/// Accepted station calibrations by station id, stored in `stations.toml` across restarts.
///
/// The file has the format of `pharos track --calibration FILE`. It is replaced atomically (AtomicFile), so that a
/// reader, or the next start after a crash, finds the old or the new file. It is not synced: see README.md.
class CalibrationMemory {
 public:
  /// More stations than a site has; each target's own store takes only the newest eight. A limit is needed because a
  /// faulty target may send any id. The file stays below 32 KiB.
  static constexpr std::size_t kMaxStations = 64;
  /// Delay after a failed write until the next attempt.
  static constexpr std::int64_t kRetry_ns = 10'000'000'000;

  /// With an empty `directory` nothing is stored.
  explicit CalibrationMemory(const std::filesystem::path& directory);

  /// Reads the file; without a file the memory is empty. A file that cannot be read or was not written by pharosd is
  /// renamed to stations.toml.damaged and counted, and InputError is thrown; the memory is empty then.
  void load();
  /// Oldest acceptance first.
  const std::vector<lighthouse::StationCalibration>& stations() const { return stations_; }
  /// Appends `calibration` and removes the previous one with the same id; if the memory is full, the oldest is dropped.
  /// Does not write the file, so it is cheap enough between two cycles.
  void keep(const lighthouse::StationCalibration& calibration);
  /// Writes the file if the memory has changed; after a failure not before kRetry_ns have passed.
  void save(std::int64_t monotonic_ns);
  /// The same at the end of the program, without regard to kRetry_ns.
  void save_at_last();

  /// Why the memory could not be stored, as one readable line; empty without an error.
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
