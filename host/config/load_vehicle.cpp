// SPDX-License-Identifier: Apache-2.0
#include "host/config/load_vehicle.hpp"

#include <algorithm>
#include <set>

#include "host/config/config_parts.hpp"
#include "host/fusion/target_fuser.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

// A configured source that publishes poses.
struct Reporter {
  SourceKind kind = SourceKind::kLighthouse;
  std::string name;
  std::string target;
  bool is_replay = false;
  bool is_remote = false;

  std::string source() const {
    if (is_remote) return "remote/" + name;
    const std::string kind_word(word_of(kind));
    return kind == SourceKind::kLighthouse ? kind_word : kind_word + '/' + name;
  }
  std::string text() const { return (is_remote ? "remote " : "") + std::string(word_of(kind)) + ' ' + name; }
};

std::vector<Reporter> reporters_of(const SourceConfigs& configured) {
  std::vector<Reporter> out;
  for (const TargetConfig& t : configured.targets) {
    out.push_back({SourceKind::kLighthouse, t.name, t.name, t.is_replay()});
  }
  for (const TofConfig& camera : configured.cameras)
    out.push_back({SourceKind::kTof, camera.name, camera.target, camera.replays_camera});
  for (const StereoConfig& rig : configured.stereos) {
    if (rig.ring2) out.push_back({SourceKind::kRing2, rig.name, rig.target, rig.replays_camera});
    if (rig.slam) out.push_back({SourceKind::kSlam, rig.name, rig.target, rig.replays_camera});
  }
  for (const RemoteConfig& remote : configured.remotes) {
    out.push_back({remote.kind, remote.name, remote.target, false, true});
  }
  return out;
}

// Names in a mounting file have no capital letters.
std::string in_small_letters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

FusionChoices read_choices(const TomlTable& table, ConfigErrors& errors) {
  FusionChoices choices;
  const auto number = [&](const char* key, double& value, ChoiceRange range) {
    errors.attempt([&] { value = table.number_or(key, value, {range.min, range.max}); });
  };
  errors.attempt([&] {
    choices.motion =
        table.choice_or("motion", choices.motion, {kMotionWords[0], kMotionWords[1], kMotionWords[2], kMotionWords[3]});
  });
  number("mean_motion_rad_s", choices.mean_motion_rad_s, kMeanMotionRange);
  errors.attempt([&] {
    choices.inertia = table.vector_or<3>("inertia", choices.inertia, {kPositiveRange.min, kPositiveRange.max});
  });
  number("acceleration_density", choices.acceleration_density, kPositiveRange);
  number("angular_density", choices.angular_acceleration_density, kPositiveRange);
  number("bias_deg", choices.bias_deg, kBiasDegRange);
  number("bias_mm", choices.bias_mm, kBiasMmRange);
  number("bias_time_s", choices.bias_time_s, kPositiveRange);
  number("risk_per_hour", choices.risk_per_hour, kRiskRange);
  number("faults_per_hour", choices.faults_per_hour, kFaultsRange);
  return choices;
}

std::string read_station(const TomlTable& table) {
  std::string id = table.text("id");
  const bool hex = id.size() == 8 && id.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
  if (!hex) table.fail("id", "must be the station's id as eight hex digits, as on its label");
  std::transform(id.begin(), id.end(), id.begin(),
                 [](char c) { return c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c; });
  return id;
}

class VehicleReader {
 public:
  VehicleReader(const TomlTable& table, const SourceConfigs& configured, ConfigErrors& errors)
      : table_(table), reporters_(reporters_of(configured)), errors_(errors) {}

  VehicleConfig read(const fs::path& folder, const Environment& environment) {
    errors_.attempt([&] { vehicle_.rate_hz = table_.number_or("rate_hz", vehicle_.rate_hz, {0.1, 200.0}); });
    const bool knows_target = errors_.attempt([&] {
      if (table_.has("target")) asked_target_ = read_name(table_, "target", table_.text("target"));
    });
    const std::size_t before = errors_.count();
    vehicle_.fusion = read_choices(table_, errors_);
    const bool knows_wanted = errors_.attempt([&] { wanted_ = table_.texts("sources"); });
    Mounting mounting;
    const bool knows_mounting = errors_.attempt([&] {
      vehicle_.mounting_file = read_path(table_, "mounting_file", folder);
      try {
        mounting = environment.read_mounting(vehicle_.mounting_file.string());
      } catch (const InputError& error) {
        table_.fail("mounting_file", error.what());
      }
    });
    const std::vector<TomlTable> stations = table_.tables("station");
    for (const TomlTable& station : stations) errors_.attempt([&] { stations_.insert(station.text("source")); });
    bool fits = knows_target && knows_wanted && knows_mounting && before == errors_.count();
    fits = fits && errors_.attempt([&] { choose(mounting); });
    for (const TomlTable& station : stations) errors_.attempt([&] { take_station(station, fits); });
    if (fits) errors_.attempt([&] { check(); });
    errors_.add_unknown_keys(table_);
    return std::move(vehicle_);
  }

 private:
  // A lighthouse with a station of its own may have any name.
  bool is_of_kind(const SourceMounting& mounting) const {
    return mounting.name == word_of(mounting.kind) ||
           (mounting.kind == SourceKind::kLighthouse && stations_.contains(mounting.name));
  }

  // Null where no configured source has the name of this mounting.
  const Reporter* reporter_of(const SourceMounting& mounting) const {
    const std::string kind(word_of(mounting.kind));
    std::vector<const Reporter*> alone;
    for (const Reporter& reporter : reporters_) {
      if (reporter.kind != mounting.kind) continue;
      if (!asked_target_.empty() && reporter.target != asked_target_) continue;
      const std::string name = in_small_letters(reporter.name);
      if (mounting.name == name || mounting.name == kind + '-' + name) return &reporter;
      alone.push_back(&reporter);
    }
    if (!is_of_kind(mounting) || alone.empty()) return nullptr;
    if (alone.size() > 1) {
      table_.fail("mounting_file", "source \"" + mounting.name + "\" may be " + alone[0]->text() + " or " +
                                       alone[1]->text() + ": name it " + kind + '-' + in_small_letters(alone[0]->name) +
                                       " in the mounting file, or set target");
    }
    return alone.front();
  }

  void choose(const Mounting& mounting) {
    std::set<const Reporter*> fused;
    for (const SourceMounting& source : mounting.sources) {
      const bool asked = std::find(wanted_.begin(), wanted_.end(), source.name) != wanted_.end();
      if (!wanted_.empty() && !asked) continue;
      const Reporter* reporter = reporter_of(source);
      if (reporter == nullptr) {
        if (asked) table_.fail("sources", "\"" + source.name + "\": no source of that name and kind is configured");
        vehicle_.not_configured.push_back(source.name);
        continue;
      }
      if (!fused.insert(reporter).second && source.kind != SourceKind::kLighthouse) {
        table_.fail("mounting_file", "has " + reporter->text() + " twice; remove one");
      }
      take(source, *reporter);
    }
    for (const std::string& name : wanted_) {
      if (mounting.find(name) == nullptr) table_.fail("sources", "\"" + name + "\" is not in the mounting file");
    }
    for (const Reporter& reporter : reporters_) {
      if (!fused.contains(&reporter)) vehicle_.not_mounted.push_back(reporter.text());
    }
    if (vehicle_.sources.empty()) {
      table_.fail("mounting_file", "has no source that is configured here: it has " + joined(vehicle_.not_configured) +
                                       ", configured are " + joined(vehicle_.not_mounted));
    }
  }

  void take(const SourceMounting& mounting, const Reporter& reporter) {
    if (vehicle_.target.empty()) vehicle_.target = reporter.target;
    if (reporter.target != vehicle_.target) {
      table_.fail("target", "is missing: " + reporter.text() + " observes \"" + reporter.target +
                                "\", another source \"" + vehicle_.target + "\"; one state is of one target");
    }
    (reporter.is_replay ? replayed_ : live_) = true;
    vehicle_.sources.push_back({mounting, reporter.source(), "", reporter.is_remote});
  }

  void take_station(const TomlTable& table, bool fits) {
    const std::string name = table.text("source"), id = read_station(table);
    errors_.add_unknown_keys(table);
    if (!fits) return;
    for (FusedSourceConfig& source : vehicle_.sources) {
      if (source.mounting.name != name || source.mounting.kind != SourceKind::kLighthouse) continue;
      source.station = id;
      return;
    }
    table.fail("source", "\"" + name + "\" is no lighthouse of the mounting file that is fused here");
  }

  void check() const {
    std::set<std::string> stations;
    std::vector<SourceMounting> mountings;
    std::size_t lighthouses = 0;
    for (const FusedSourceConfig& source : vehicle_.sources) {
      mountings.push_back(source.mounting);
      if (source.mounting.kind != SourceKind::kLighthouse) continue;
      ++lighthouses;
      stations.insert(source.station);
    }
    if (lighthouses > 1 && (stations.size() < lighthouses || stations.contains(""))) {
      table_.fail("station", "is missing: of several lighthouses each needs [[vehicle.station]] source, id");
    }
    if (replayed_ && live_) {
      table_.fail("mounting_file",
                  "a recording (replay: of a target, frames of [recording]) has its own times, the other sources "
                  "today's: choose one kind with sources");
    }
    try {
      static_cast<void>(checked_settings(mountings, vehicle_.fusion));
    } catch (const InputError& error) {
      table_.fail("mounting_file", error.what());
    }
  }

  const TomlTable& table_;
  std::vector<Reporter> reporters_;
  ConfigErrors& errors_;
  std::string asked_target_;
  std::vector<std::string> wanted_;
  std::set<std::string> stations_;  // mountings that [[vehicle.station]] names
  bool replayed_ = false, live_ = false;
  VehicleConfig vehicle_;
};

}  // namespace

std::optional<VehicleConfig> read_vehicle(const TomlTable& root, const fs::path& folder, const Environment& environment,
                                          const SourceConfigs& configured, ConfigErrors& errors) {
  if (!root.has("vehicle")) return std::nullopt;
  const TomlTable table = root.table("vehicle");
  return VehicleReader(table, configured, errors).read(folder, environment);
}

}  // namespace pharos::host
