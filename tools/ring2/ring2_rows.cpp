// SPDX-License-Identifier: Apache-2.0
#include "tools/ring2/ring2_rows.hpp"

#include <array>
#include <cmath>

#include "host/support/flag_text.hpp"
#include "host/vision/ring2/rim.hpp"
#include "host/vision/ring2/ring2_pose.hpp"
#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

using ring2::Ring2Estimate;

constexpr std::array<FlagWord, 3> kUnobservableWords = {
    {{ring2::kUnobservableScale, "scale"}, {ring2::kUnobservableRing, "ring"}, {ring2::kUnobservableNozzle, "nozzle"}}};

constexpr std::array<FlagWord, 2> kOneEdgeWords = {{{host::kOneEdgeRing, "ring"}, {host::kOneEdgeNozzle, "nozzle"}}};

const std::vector<std::string> kContract = {
    "theta_deg",     "gamma_deg",       "nx",         "ny",        "nz",    "cx_m", "cy_m", "cz_m",
    "ring_radius_m", "nozzle_radius_m", "distance_m", "sigma_deg", "status"};
const std::vector<std::string> kDetails = {"sigma_position_mm",
                                           "sigma_ring_radius_mm",
                                           "sigma_nozzle_radius_mm",
                                           "sigma_distance_mm",
                                           "nozzle_cx_m",
                                           "nozzle_cy_m",
                                           "nozzle_cz_m",
                                           "rms_px",
                                           "chi2",
                                           "ellipses",
                                           "untold",
                                           "alt_theta_deg",
                                           "alt_gamma_deg",
                                           "delta_chi2",
                                           "one_edge",
                                           "centre_cov_xx_m2",
                                           "centre_cov_xy_m2",
                                           "centre_cov_xz_m2",
                                           "centre_cov_yy_m2",
                                           "centre_cov_yz_m2",
                                           "centre_cov_zz_m2",
                                           "alt_cx_m",
                                           "alt_cy_m",
                                           "alt_cz_m"};

// Only where ring and scale are observable. No focal length: the residual is not used.
host::RowPose row_pose(const Ring2Estimate& e, bool by_paper, double time_s) {
  const auto estimate = host::ring2_pose(e, 1.0);
  return {time_s, estimate.pose.quaternion(), estimate.pose.t,
          by_paper ? std::nullopt : std::optional<Matrix6>(estimate.covariance),
          e.ambiguous() ? host::PoseGrade::kAmbiguous : host::PoseGrade::kGood};
}

void write_vector(const Vector3& vector, bool told, host::RowWriter& rows) {
  for (int axis = 0; axis < 3; ++axis) rows.number(told ? std::optional<double>(vector[axis]) : std::nullopt);
}

// What is told of lengths.
struct Observable {
  explicit Observable(std::uint8_t unobservable)
      : ring((unobservable & (ring2::kUnobservableScale | ring2::kUnobservableRing)) == 0),
        nozzle((unobservable & (ring2::kUnobservableScale | ring2::kUnobservableNozzle)) == 0) {}
  bool ring, nozzle;
};

void write_sigmas(const Ring2Estimate& e, const Observable& told, host::RowWriter& rows) {
  const auto sigma_mm = [&e](int unknown) { return kMmPerM * std::sqrt(e.covariance(unknown, unknown)); };
  const auto when = [](bool is_observable, double value) {
    return is_observable ? std::optional<double>(value) : std::nullopt;
  };
  const int c = ring2::kCentre;
  const double position_mm =
      kMmPerM * std::sqrt(e.covariance(c, c) + e.covariance(c + 1, c + 1) + e.covariance(c + 2, c + 2));
  // Without a ring the first circle's centre and radius are the nozzle's.
  rows.number(when(told.ring || told.nozzle, position_mm));
  rows.number(when(told.ring, sigma_mm(ring2::kRadius)));
  rows.number(when(told.nozzle, sigma_mm(told.ring ? ring2::kSecondRadius : ring2::kRadius)));
  rows.number(when(told.ring && told.nozzle, sigma_mm(ring2::kDistance)));
}

// Without their side, where they have one.
constexpr std::pair<const char*, const char*> kRefusals[] = {
    {"no_ellipse", "no ellipse was found; look with `pharos ellipses --overlay`"},
    {"black", "is black; take it with light and without the lens cover"},
    {"saturated", "is saturated; expose it shorter"},
    {"even", "has no contrast; is the target before the camera?"},
    {"no_common_circle",
     "no two ellipses are one circle seen by both cameras; are both images of the target at one time, "
     "and is the rig theirs?"},
    {"too_few_ellipses", "fewer than two ellipses; give ring or nozzle of both views"},
    {"bad_ellipse", "an ellipse with impossible axes, or where the lens has no pixels; correct the table"},
    {"inconsistent", "no two parallel circles before this rig give these ellipses; is the rig that of these images?"},
    {"undetermined", "the ellipses do not determine the circles; give more of them"},
    {"left_right_exchanged", "left and right seem to be exchanged; exchange them"},
    {"cameras_coincide", "the rig's cameras stand at one place; correct the rig file"},
};

}  // namespace

std::vector<std::string> ring2_columns(bool with_problem) {
  std::vector<std::string> columns;
  if (with_problem) columns.emplace_back("problem");
  columns.insert(columns.end(), kContract.begin(), kContract.end());
  columns.insert(columns.end(), kDetails.begin(), kDetails.end());
  return columns;
}

std::string unobservable_words(std::uint8_t unobservable) {
  return host::joined_flags(unobservable, kUnobservableWords);
}

void write_ring2(const Ring2Estimate& e, const Ring2Row& row, host::RowWriter& rows) {
  const bool by_paper = row.by_paper;
  const ring2::Attitude attitude = ring2::attitude_of(e.normal);
  const Observable told(e.unobservable);
  const auto when = [](bool is_observable, double value) {
    return is_observable ? std::optional<double>(value) : std::nullopt;
  };
  rows.number(attitude.theta_rad * kDegPerRad).number(attitude.gamma_rad * kDegPerRad);
  write_vector(e.normal, true, rows);
  write_vector(e.ring_centre_m, told.ring, rows);
  rows.number(when(told.ring, e.ring_radius_m)).number(when(told.nozzle, e.nozzle_radius_m));
  rows.number(when(told.ring && told.nozzle, e.distance_m));
  rows.number(when(!by_paper, e.sigma_normal_rad() * kDegPerRad));
  rows.text(e.ambiguous() ? "ambiguous" : "ok");
  if (by_paper) {
    rows.none(4);
  } else {
    write_sigmas(e, told, rows);
  }
  write_vector(e.nozzle_centre_m, told.nozzle, rows);
  rows.number(when(!by_paper, e.rms_px)).number(when(!by_paper, e.chi2)).integer(e.ellipses);
  rows.text(unobservable_words(e.unobservable));
  if (e.second) {
    const ring2::Attitude other = ring2::attitude_of(e.second->normal);
    rows.number(other.theta_rad * kDegPerRad).number(other.gamma_rad * kDegPerRad).number(e.second->delta_chi2);
  } else {
    rows.none(3);
  }
  rows.text(host::joined_flags(row.one_edge, kOneEdgeWords));
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      rows.number(when(!by_paper && told.ring, e.covariance(ring2::kCentre + i, ring2::kCentre + j)));
    }
  }
  write_vector(e.second ? e.second->ring_centre_m : Vector3::Zero().eval(), e.second.has_value() && told.ring, rows);
  if (told.ring) rows.pose(row_pose(e, by_paper, row.time_s));
  rows.end_row();
}

std::string refusal_text(const std::string& reason) {
  for (const auto& [word, text] : kRefusals) {
    if (reason == word) return text;
    for (const char* side : {"left", "right"}) {
      if (reason == std::string(side) + '_' + word) return std::string(side) + " image: " + text;
    }
  }
  return "no answer: " + reason;
}

void write_refusal(const std::string& reason, host::RowWriter& rows) {
  rows.none(kContract.size() - 1).text("refused_" + reason).none(kDetails.size()).end_row();
}

}  // namespace pharos::tools
