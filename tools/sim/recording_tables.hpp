// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "host/files/atomic_file.hpp"
#include "pharos/geometry/target.hpp"
#include "tools/sim/lighthouse_simulator.hpp"

namespace pharos::sim {

/// A gzip table of whole numbers, gathered into large writes. Throws host::InputError when it cannot be written.
class GzipTable {
 public:
  GzipTable(const std::filesystem::path& path, const std::string& header);
  GzipTable(const GzipTable&) = delete;
  GzipTable& operator=(const GzipTable&) = delete;
  ~GzipTable();

  void row(std::initializer_list<std::int64_t> values);
  void close();

 private:
  void flush();

  std::filesystem::path path_;
  host::AtomicFile place_;
  gzFile file_;
  std::string buffer_;
};

/// sensor,x_m,y_m,z_m,nx,ny,nz.
void write_target(const std::filesystem::path& path, const Target& target);
/// time_s,kind,station,sensor,amount.
void write_faults(const std::filesystem::path& path, const std::vector<InjectedFault>& faults);

}  // namespace pharos::sim
