// SPDX-License-Identifier: Apache-2.0
#include "host/record/recording_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <ctime>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "host/support/time_units.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

constexpr int kFilePermissions = 0644;
/// Names tried, where another program takes them too.
constexpr int kMaxNamesakes = 1000;
constexpr int kMaxNamesake = 1'000'000;
constexpr std::string_view kTimeShape = "00000000T000000Z";

std::string utc_word(std::int64_t utc_ns) {
  const std::time_t seconds = utc_ns / kNsPerSecond;
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 32> word{};
  const std::size_t size = std::strftime(word.data(), word.size(), "%Y%m%dT%H%M%SZ", &parts);
  return {word.data(), size};
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_time(std::string_view word) {
  return std::equal(word.begin(), word.end(), kTimeShape.begin(), kTimeShape.end(),
                    [](char is, char shape) { return is_digit(shape) ? is_digit(is) : is == shape; });
}

using Place = std::pair<std::string, int>;  // time, number among its namesakes
using Entry = std::pair<Place, fs::path>;

// Empty for a file of another series.
std::optional<Place> place_of(std::string_view file, std::string_view name, std::string_view suffix) {
  if (!file.starts_with(name) || !file.ends_with(suffix) || file.size() < name.size() + suffix.size()) return {};
  file.remove_prefix(name.size());
  file.remove_suffix(suffix.size());
  if (!file.starts_with('_') || !is_time(file.substr(1, kTimeShape.size()))) return {};
  const std::string time(file.substr(1, kTimeShape.size()));
  file.remove_prefix(1 + kTimeShape.size());
  if (file.empty()) return Place{time, 0};
  int number = 0;
  const auto [end, error] = std::from_chars(file.data() + 1, file.data() + file.size(), number);
  if (file.front() != '_' || error != std::errc{} || end != file.data() + file.size() || number < 1 ||
      number > kMaxNamesake) {
    return {};
  }
  return Place{time, number};
}

// In the order of their times.
std::vector<Entry> entries_of(const fs::path& directory, const std::string& name, const std::string& suffix) {
  std::error_code error;
  std::vector<Entry> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, error)) {
    if (const auto place = place_of(entry.path().filename().string(), name, suffix)) {
      found.emplace_back(*place, entry.path());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

UniqueFd create_recording_file(const fs::path& directory, const std::string& name, const std::string& suffix,
                               std::int64_t utc_ns, fs::path& path) {
  std::error_code ignored;  // if the folder cannot be created, opening the file fails and reports why
  fs::create_directories(directory, ignored);
  const std::string time = utc_word(utc_ns);
  // Behind the last one of this second, also where earlier ones were deleted: names are in the order of time.
  int namesake = 0;
  const std::vector<Entry> files = entries_of(directory, name, suffix);
  if (!files.empty() && files.back().first.first == time) namesake = files.back().first.second + 1;
  UniqueFd fd;
  for (const int last = namesake + kMaxNamesakes; namesake < last && !fd.valid(); ++namesake) {
    path = directory / (name + "_" + time + (namesake == 0 ? "" : "_" + std::to_string(namesake)) + suffix);
    fd.reset(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kFilePermissions));
    if (!fd.valid() && errno != EEXIST) break;
  }
  return fd;
}

bool write_all(int fd, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

bool is_frame_recording(const fs::path& path, const std::string& camera) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return path.extension() == kFramesSuffix;
  return !recording_files(path, camera, kFramesSuffix).empty();
}

std::vector<fs::path> recording_files(const fs::path& path, const std::string& name, const std::string& suffix) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return {path};
  std::vector<fs::path> files;
  for (auto& [place, file] : entries_of(path, name, suffix)) files.push_back(std::move(file));
  return files;
}

}  // namespace pharos::host
