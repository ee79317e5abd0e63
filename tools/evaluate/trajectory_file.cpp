// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/trajectory_file.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "host/support/input_error.hpp"
#include "host/table/table_reader.hpp"
#include "pharos/base/units.hpp"
#include "tools/evaluate/pose_lines.hpp"

namespace pharos::evaluate {
namespace {

constexpr double kQuaternionTolerance = 0.01;
// Poses of one time that are apart by less than this are one.
constexpr double kRepeated_m = 1e-4, kRepeated_rad = 0.1 * kRadPerDeg;
constexpr double kMicrosecond_s = 1e-6;
constexpr double kLargestPosition_m = 1e6;
constexpr std::size_t kPeek = 4096;

bool has_word(std::string_view flags, const std::string& word) {
  while (!flags.empty()) {
    const std::size_t bar = flags.find('|');
    if (flags.substr(0, bar) == word) return true;
    if (bar == std::string_view::npos) return false;
    flags.remove_prefix(bar + 1);
  }
  return false;
}

// A pose that was written twice: trackers that give an update within the clock's last digit do.
template <class WorldFromBody>
bool repeats(const Sample<WorldFromBody>& before, const Sample<WorldFromBody>& sample) {
  return sample.time_s == before.time_s && (sample.pose.t - before.pose.t).norm() < kRepeated_m &&
         rotation_angle_between(sample.pose.R, before.pose.R) < kRepeated_rad;
}

template <class WorldFromBody>
class Collector {
 public:
  Collector(std::string name, const TrajectoryChoice& choice) : name_(std::move(name)), choice_(choice) {}

  /// `one_time`: rows of one time are one, the last.
  void take(const RawRow& row, std::size_t line, bool one_time = false) {
    if (file_.rows == 0) file_.first_s = row.time_s;
    file_.last_s = row.time_s;
    ++file_.rows;
    if (row.refused) {
      ++file_.refused;
    } else if (row.ambiguous && !choice_.keep_ambiguous) {
      ++file_.ambiguous;
    } else if (is_flagged(row.flags)) {
      ++file_.flagged;
    } else {
      if (one_time) drop_same_time(row.time_s);
      keep(row, line);
    }
  }
  TrajectoryFile<WorldFromBody> result() && { return std::move(file_); }

 private:
  bool is_flagged(std::string_view flags) const {
    return std::any_of(choice_.without_flags.begin(), choice_.without_flags.end(),
                       [flags](const std::string& word) { return has_word(flags, word); });
  }
  void drop_same_time(double time_s) {
    if (file_.samples.empty() || file_.samples.back().time_s != time_s) return;
    file_.samples.pop_back();
    --file_.rows;
  }
  void keep(const RawRow& row, std::size_t line) {
    const double length = row.q.norm();
    if (!(std::abs(length - 1.0) <= kQuaternionTolerance)) {
      fail(line, "the quaternion has length " + std::to_string(length) + "; it must be 1");
    }
    if (!(row.t.cwiseAbs().maxCoeff() < kLargestPosition_m)) fail(line, "the position is beyond 1000 km; give metres");
    Sample<WorldFromBody> sample{row.time_s, {row.q.normalized().toRotationMatrix(), row.t}, {}, {}};
    if (!file_.samples.empty() && repeats(file_.samples.back(), sample)) {
      --file_.rows;
      ++file_.repeated;
      return;
    }
    if (!file_.samples.empty() && !(row.time_s > file_.samples.back().time_s)) {
      fail(line, "its time is not later than that of the pose before; sort the rows and keep one a time");
    }
    if (row.sigma_rot_deg && *row.sigma_rot_deg >= 0.0) sample.sigma_rotation_rad = *row.sigma_rot_deg * kRadPerDeg;
    if (row.sigma_pos_mm && *row.sigma_pos_mm >= 0.0) sample.sigma_position_m = *row.sigma_pos_mm / kMmPerM;
    file_.samples.push_back(sample);
  }
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw host::InputError(name_ + ": line " + std::to_string(line) + ": " + what);
  }

  std::string name_;
  const TrajectoryChoice& choice_;
  TrajectoryFile<WorldFromBody> file_;
};

/// The time columns of a table.
struct TimeColumn {
  const char* name;
  double unit_s;
};

TimeColumn time_column(std::string_view header, const TrajectoryChoice& choice) {
  const auto has = [header](std::string_view column) {
    const std::string line = "," + std::string(header) + ",";
    return line.find("," + std::string(column) + ",") != std::string::npos;
  };
  if (!has("time_s") && has("utime")) return {"utime", kMicrosecond_s};
  if (!has("time_s") && has("frame")) return {"frame", 1.0 / choice.frame_rate_hz};
  return {"time_s", 1.0};
}

class Table {
 public:
  Table(host::ByteSource source, TimeColumn time)
      : table_(std::move(source), {time.name, "qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m"}),
        unit_s_(time.unit_s),
        station_(table_.find_optional("station")),
        status_(table_.find_optional("status")),
        flags_(table_.find_optional("flags")),
        sigma_rot_(table_.find_optional("sigma_rot_deg")),
        sigma_pos_(table_.find_optional("sigma_pos_mm")),
        one_world_(table_.find_optional("cov_xx_m2").has_value()) {}

  /// The next selected row.
  std::optional<RawRow> next(const TrajectoryChoice& choice) {
    while (table_.next()) {
      if (is_wanted(choice)) return row();
    }
    return std::nullopt;
  }
  std::size_t line() const { return table_.line_number(); }
  /// A covariance in the axes of the world: a table of pharos track --sweeps. `station` only says whose light came
  /// last.
  bool one_world() const { return one_world_; }

 private:
  bool is_wanted(const TrajectoryChoice& choice) {
    if (!station_ || table_.empty(*station_)) return true;
    const std::int64_t station = table_.integer(*station_, 0, 1'000'000);
    if (choice.station) return station == *choice.station;
    if (one_world_) return true;
    if (!seen_station_) seen_station_ = station;
    if (*seen_station_ != station) {
      table_.fail(*station_, "rows of several stations, each in its own frame; choose one with --station");
    }
    return true;
  }
  RawRow row() const {
    RawRow row;
    row.time_s = table_.number(0) * unit_s_;
    if (flags_) row.flags = table_.text(*flags_);
    const std::string_view status = status_ ? table_.text(*status_) : "ok";
    row.ambiguous = status == "ambiguous";
    row.refused = table_.empty(1) || (status != "ok" && !row.ambiguous);
    if (row.refused) return row;
    row.q = Quaternion(table_.number(1), table_.number(2), table_.number(3), table_.number(4));
    row.t = {table_.number(5), table_.number(6), table_.number(7)};
    if (sigma_rot_) row.sigma_rot_deg = table_.optional_number(*sigma_rot_);
    if (sigma_pos_) row.sigma_pos_mm = table_.optional_number(*sigma_pos_);
    return row;
  }

  host::TableReader table_;
  double unit_s_;
  std::optional<std::size_t> station_, status_, flags_, sigma_rot_, sigma_pos_;
  bool one_world_;
  std::optional<std::int64_t> seen_station_;
};

template <class WorldFromBody, class RowOf>
TrajectoryFile<WorldFromBody> read_lines(host::ByteSource source, const TrajectoryChoice& choice, RowOf&& row_of) {
  host::LineReader lines(std::move(source), host::LastLine::kAccept);
  Collector<WorldFromBody> collector(lines.name(), choice);
  while (const std::optional<std::string_view> line = lines.next()) {
    const std::string where = lines.name() + ": line " + std::to_string(lines.line_number()) + ": ";
    if (const std::optional<RawRow> row = row_of(*line, where)) collector.take(*row, lines.line_number());
  }
  return std::move(collector).result();
}

}  // namespace

template <class WorldFromBody>
TrajectoryFile<WorldFromBody> read_trajectory(const std::string& path, const TrajectoryChoice& choice) {
  host::ByteSource source(path);
  std::string_view head = source.peek(kPeek);
  const std::size_t begin = head.find_first_not_of(" \t\r\n");
  head.remove_prefix(std::min(begin, head.size()));
  const std::string_view first = head.substr(0, head.find_first_of("\r\n"));
  const bool tum = first.starts_with('#') || (!first.empty() && first.find(',') == std::string_view::npos);
  if (tum) {
    return read_lines<WorldFromBody>(std::move(source), choice, looks_like_euroc(head) ? euroc_row : tum_row);
  }
  const TimeColumn time = time_column(first, choice);
  Collector<WorldFromBody> collector(source.name(), choice);
  Table table(std::move(source), time);
  while (const std::optional<RawRow> row = table.next(choice)) collector.take(*row, table.line(), table.one_world());
  return std::move(collector).result();
}

template TrajectoryFile<EstimatePose> read_trajectory(const std::string&, const TrajectoryChoice&);
template TrajectoryFile<TruthPose> read_trajectory(const std::string&, const TrajectoryChoice&);

}  // namespace pharos::evaluate
