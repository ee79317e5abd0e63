// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/calibration_memory.hpp"

#include <algorithm>
#include <exception>

#include "host/files/atomic_file.hpp"
#include "host/stations/station_file.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

using lighthouse::StationCalibration;

constexpr const char* kHeading =
    "# Calibrations that stations sent of themselves and that pharosd accepted. Written by pharosd; delete the file to "
    "forget them.\n";

}  // namespace

CalibrationMemory::CalibrationMemory(const std::filesystem::path& directory)
    : file_(directory.empty() ? directory : directory / "stations.toml") {}

void CalibrationMemory::load() {
  stations_.clear();
  std::error_code error;
  if (file_.empty() || !std::filesystem::exists(file_, error)) return;
  try {
    read();
  } catch (const std::exception& damage) {
    stations_.clear();
    ++counters_.damaged_files;
    throw InputError(std::string(damage.what()) + set_aside());
  }
}

void CalibrationMemory::read() {
  std::error_code error;
  // Opening a pipe would wait for a writer.
  if (!std::filesystem::is_regular_file(file_, error)) throw InputError(file_.string() + ": is no file");
  for (const StationEntry& entry : read_station_file(file_)) {
    if (!entry.id) throw InputError(file_.string() + ": a [[station]] without id was not written by pharosd");
    stations_.push_back(entry.calibration);
  }
  while (stations_.size() > kMaxStations) drop_oldest();
}

// Kept for diagnosis; replaces an older damaged file.
std::string CalibrationMemory::set_aside() const {
  const std::filesystem::path aside = file_.string() + ".damaged";
  std::error_code error;
  std::filesystem::rename(file_, aside, error);
  return error ? "; it cannot be renamed: " + error.message() : "; it is " + aside.string() + " now";
}

void CalibrationMemory::drop_oldest() {
  stations_.erase(stations_.begin());
  ++counters_.dropped;
}

void CalibrationMemory::keep(const StationCalibration& calibration) {
  if (!stations_.empty() && stations_.back() == calibration) return;
  if (!is_plausible(calibration)) {  // with such an entry the next start would refuse the whole file
    ++counters_.dropped;
    return;
  }
  std::erase_if(stations_, [&](const StationCalibration& station) { return station.id == calibration.id; });
  if (stations_.size() == kMaxStations) drop_oldest();
  stations_.push_back(calibration);
  unsaved_ = !file_.empty();
}

void CalibrationMemory::save(std::int64_t monotonic_ns) {
  if (!unsaved_ || (!error_.empty() && monotonic_ns < retry_at_ns_)) return;
  write();
  retry_at_ns_ = monotonic_ns + kRetry_ns;
}

void CalibrationMemory::save_at_last() {
  if (unsaved_) write();
}

void CalibrationMemory::write() {
  std::string text = kHeading;
  for (const StationCalibration& station : stations_) text += "\n" + station_text(station);
  std::error_code ignored;  // if the folder cannot be created, opening the file reports why
  std::filesystem::create_directories(file_.parent_path(), ignored);
  try {
    write_file(file_.string(), text);
    unsaved_ = false;
    error_.clear();
  } catch (const InputError& error) {
    unsaved_ = true;
    error_ = std::string(error.what()) + "; calibrations are not kept across a restart";
    ++counters_.write_failures;
  }
}

}  // namespace pharos::host
