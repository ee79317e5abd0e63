// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace pharos::tools {

/// A progress line on standard error, updated twice a second, only when that is a terminal; removed at the end.
class Progress {
 public:
  /// "what: 12,300 units", or with a total "what: 12 of 50 units".
  Progress(std::string what, std::string units, std::size_t total = 0);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  void step(std::size_t count = 1);

 private:
  void show();

  std::string what_;
  std::string units_;
  std::size_t total_ = 0;
  std::size_t done_ = 0;
  std::size_t looked_at_clock_ = 0;
  bool terminal_ = false;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace pharos::tools
