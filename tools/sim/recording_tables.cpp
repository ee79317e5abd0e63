// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/recording_tables.hpp"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>

#include "host/support/input_error.hpp"
#include "host/table/row_writer.hpp"

namespace pharos::sim {
namespace {

constexpr std::size_t kGather = 1 << 16;

[[noreturn]] void refuse_output(const std::filesystem::path& path) {
  throw host::InputError(path.string() + ": cannot be written: " + std::strerror(errno) + "; choose another --output");
}

}  // namespace

GzipTable::GzipTable(const std::filesystem::path& path, const std::string& header)
    : path_(path), place_(path.string()), file_(gzdopen(::dup(::fileno(place_.stream())), "wb6")) {
  if (file_ == nullptr) refuse_output(path);
  buffer_ = header + "\n";
}

GzipTable::~GzipTable() {
  if (file_ != nullptr) gzclose(file_);
}

void GzipTable::row(std::initializer_list<std::int64_t> values) {
  char text[24];
  for (const std::int64_t value : values) {
    buffer_.append(text, std::to_chars(text, text + sizeof text, value).ptr);
    buffer_.push_back(',');
  }
  buffer_.back() = '\n';
  if (buffer_.size() > kGather) flush();
}

void GzipTable::close() {
  flush();
  gzFile file = file_;
  file_ = nullptr;
  if (gzclose(file) != Z_OK) refuse_output(path_);
  place_.commit();
}

void GzipTable::flush() {
  const auto size = static_cast<unsigned>(buffer_.size());
  if (size != 0 && gzwrite(file_, buffer_.data(), size) != static_cast<int>(size)) refuse_output(path_);
  buffer_.clear();
}

void write_target(const std::filesystem::path& path, const Target& target) {
  host::AtomicFile file(path.string());
  host::RowWriter rows(file.stream(), host::RowFormat::kCsv, {"sensor", "x_m", "y_m", "z_m", "nx", "ny", "nz"});
  for (const SensorPlacement& sensor : target) {
    rows.integer(sensor.sensor);
    for (int i = 0; i < 3; ++i) rows.number(sensor.position_m[i]);
    if (sensor.has_normal()) {
      for (int i = 0; i < 3; ++i) rows.number(sensor.normal[i]);
    } else {
      rows.none(3);
    }
    rows.end_row();
  }
  rows.flush();
  file.commit();
}

void write_faults(const std::filesystem::path& path, const std::vector<InjectedFault>& faults) {
  host::AtomicFile file(path.string());
  host::RowWriter rows(file.stream(), host::RowFormat::kCsv, {"time_s", "kind", "station", "sensor", "amount"});
  for (const InjectedFault& fault : faults) {
    rows.number(fault.time_s).text(fault.kind);
    fault.station < 0 ? rows.none() : rows.integer(fault.station);
    fault.sensor < 0 ? rows.none() : rows.integer(fault.sensor);
    rows.number(fault.amount);
    rows.end_row();
  }
  rows.flush();
  file.commit();
}

}  // namespace pharos::sim
