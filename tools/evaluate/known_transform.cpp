// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/known_transform.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "host/support/input_error.hpp"
#include "host/table/table_reader.hpp"
#include "pharos/base/units.hpp"

namespace pharos::evaluate {
namespace {

constexpr double kQuaternionTolerance = 0.01;
constexpr std::array<const char*, 7> kPose = {"qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m"};
constexpr std::array<const char*, 6> kPsi = {"phi_x_rad", "phi_y_rad", "phi_z_rad", "x_mm", "y_mm", "z_mm"};

// Columns of one form, where the header has all of them.
template <std::size_t N>
using Columns = std::array<std::size_t, N>;
template <std::size_t N>
std::optional<Columns<N>> columns_of(host::TableReader& table, const std::array<const char*, N>& names,
                                     const std::string& prefix = "") {
  Columns<N> columns{};
  for (std::size_t i = 0; i < N; ++i) {
    const auto column = table.find_optional(prefix + names[i]);
    if (!column) return std::nullopt;
    columns[i] = *column;
  }
  return columns;
}

template <class AnyPose>
AnyPose pose_of(const host::TableReader& table, const Columns<7>& at) {
  const Quaternion q(table.number(at[0]), table.number(at[1]), table.number(at[2]), table.number(at[3]));
  if (!(std::abs(q.norm() - 1.0) <= kQuaternionTolerance)) {
    table.fail_row("the quaternion has length " + std::to_string(q.norm()) + "; it must be 1");
  }
  return {q.normalized().toRotationMatrix(), {table.number(at[4]), table.number(at[5]), table.number(at[6])}};
}

}  // namespace

Alignment read_transform(const std::string& path) {
  host::TableReader table(host::ByteSource(path), {});
  const auto pose = columns_of(table, kPose);
  const auto psi = columns_of(table, kPsi);
  const auto world = columns_of(table, kPose, "world_"), body = columns_of(table, kPose, "body_");
  const int forms = (pose ? 1 : 0) + (psi ? 1 : 0) + (world && body ? 1 : 0);
  if (forms != 1) {
    throw host::InputError(path +
                           ": give either qw,qx,qy,qz,tx_m,ty_m,tz_m, or phi_x_rad,phi_y_rad,phi_z_rad,x_mm,y_mm,z_mm, "
                           "or a row of pharos evaluate (world_qw ... body_tz_m)");
  }
  if (!table.next()) throw host::InputError(path + ": holds no row; one transformation is needed");
  Alignment alignment;
  if (pose) {
    alignment.world = pose_of<Pose<EstimateWorld, TruthWorld>>(table, *pose);
  } else if (psi) {
    const auto value = [&](std::size_t i) { return table.number((*psi)[i]); };
    alignment.world.R = paper_rotation({value(0), value(1), value(2)});
    alignment.world.t = Vector3(value(3), value(4), value(5)) / kMmPerM;
  } else {
    alignment.world = pose_of<Pose<EstimateWorld, TruthWorld>>(table, *world);
    alignment.body = pose_of<Pose<TruthBody, EstimateBody>>(table, *body);
  }
  if (table.next()) table.fail_row("a second row; one transformation is needed");
  return alignment;
}

}  // namespace pharos::evaluate
