// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pharos/lighthouse/station_calibration.hpp"

namespace pharos::host {

/// Station calibrations that were accepted once, by station id, kept in `stations.toml` across restarts.
///
/// The file has the form that `pharos track --calibration FILE` takes. It is replaced whole (written aside, synced,
/// renamed): a power cut leaves the old one or the new one.
class CalibrationMemory {
 public:
  /// An empty `directory` keeps nothing.
  explicit CalibrationMemory(const std::filesystem::path& directory);

  /// Reads the file; none there is an empty memory. Throws InputError for one that cannot be read or understood; the
  /// memory is empty then, and the next keep() replaces the file.
  void load();
  const std::vector<lighthouse::StationCalibration>& stations() const { return stations_; }
  /// Puts `calibration` in the place of the one of the same id and writes the file, unless nothing changed. What went
  /// wrong is returned in words.
  std::optional<std::string> keep(const lighthouse::StationCalibration& calibration);
  const std::filesystem::path& file() const { return file_; }

 private:
  std::optional<std::string> write() const;

  std::filesystem::path file_;
  std::vector<lighthouse::StationCalibration> stations_;
  bool written_ = true;  // the file holds what stations_ does
};

}  // namespace pharos::host
