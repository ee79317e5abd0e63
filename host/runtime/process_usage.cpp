// SPDX-License-Identifier: Apache-2.0
#include "host/runtime/process_usage.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace pharos::host {
namespace {

std::int64_t microseconds(const timeval& time) {
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000 + static_cast<std::int64_t>(time.tv_usec);
}

}  // namespace

ProcessUsage process_usage() {
  ProcessUsage usage;
  rusage times{};
  if (::getrusage(RUSAGE_SELF, &times) == 0) {
    usage.cpu_us = microseconds(times.ru_utime) + microseconds(times.ru_stime);
    usage.peak_resident_kib = times.ru_maxrss;
  }
  std::int64_t total_pages = 0;
  std::int64_t resident_pages = 0;
  std::ifstream("/proc/self/statm") >> total_pages >> resident_pages;
  usage.resident_kib = resident_pages * ::sysconf(_SC_PAGESIZE) / 1024;
  return usage;
}

}  // namespace pharos::host
