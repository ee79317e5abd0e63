// SPDX-License-Identifier: Apache-2.0
#include "host/mounting/mounting.hpp"

namespace pharos::host {
namespace {

struct KindWord {
  SourceKind kind;
  std::string_view word;
};
constexpr std::array<KindWord, 4> kKinds{{{SourceKind::kLighthouse, "lighthouse"},
                                          {SourceKind::kTof, "tof"},
                                          {SourceKind::kRing2, "ring2"},
                                          {SourceKind::kSlam, "slam"}}};

}  // namespace

std::string_view word_of(SourceKind kind) { return kKinds[static_cast<std::size_t>(kind)].word; }

std::optional<SourceKind> source_kind(std::string_view word) {
  for (const KindWord& known : kKinds) {
    if (known.word == word) return known.kind;
  }
  return std::nullopt;
}

std::string_view word_of(MountingOrigin origin) {
  if (origin == MountingOrigin::kGiven) return "given";
  return origin == MountingOrigin::kEstimated ? "estimated" : "prior";
}

const SourceMounting* Mounting::find(std::string_view name) const {
  for (const SourceMounting& source : sources) {
    if (source.name == name) return &source;
  }
  return nullptr;
}

std::optional<VehicleFromTarget> vehicle_from_target(const SourceMounting& source, const SensorFromFeature& measured) {
  const std::optional<TargetFromFeature> feature = source.target_from_feature();
  if (!feature) return std::nullopt;
  return source.vehicle_from_sensor() * measured * feature->inverse();
}

}  // namespace pharos::host
