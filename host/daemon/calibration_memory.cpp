// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/calibration_memory.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "host/stations/station_file.hpp"
#include "host/support/input_error.hpp"
#include "host/support/unique_fd.hpp"

namespace pharos::host {
namespace {

using lighthouse::StationCalibration;

constexpr const char* kHeading =
    "# Calibrations that stations sent of themselves and that pharosd accepted. Written by pharosd; delete the file to "
    "forget them.\n";

bool write_all(int fd, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(fd, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return true;
}

}  // namespace

CalibrationMemory::CalibrationMemory(const std::filesystem::path& directory)
    : file_(directory.empty() ? directory : directory / "stations.toml") {}

void CalibrationMemory::load() {
  stations_.clear();
  std::error_code error;
  if (file_.empty() || !std::filesystem::exists(file_, error)) return;
  std::vector<StationCalibration> stations;
  for (const StationEntry& entry : read_station_file(file_)) {
    if (!entry.id) throw InputError(file_.string() + ": a [[station]] without id is not pharosd's; delete the file");
    stations.push_back(entry.calibration);
  }
  stations_ = std::move(stations);
  while (stations_.size() > kMaxStations) drop_oldest();
}

void CalibrationMemory::drop_oldest() {
  stations_.erase(stations_.begin());
  ++counters_.dropped;
}

void CalibrationMemory::keep(const StationCalibration& calibration) {
  if (!stations_.empty() && stations_.back() == calibration) return;
  if (!is_plausible(calibration)) {  // one such entry, and the next start could read none
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
  std::error_code ignored;  // if the folder cannot be made, opening says why
  std::filesystem::create_directories(file_.parent_path(), ignored);
  const std::filesystem::path aside = file_.string() + ".new";
  UniqueFd fd(::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  unsaved_ = !fd.valid() || !write_all(fd.get(), text) || ::rename(aside.c_str(), file_.c_str()) != 0;
  error_ = unsaved_ ? file_.string() + ": cannot be written: " + std::strerror(errno) +
                          "; calibrations are not kept across a restart"
                    : "";
  if (!unsaved_) return;
  ++counters_.write_failures;
  if (fd.valid()) (void)::unlink(aside.c_str());
}

}  // namespace pharos::host
