// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/connector.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/tof/connector_heights.hpp"
#include "pharos/tof/constants.hpp"
#include "pharos/tof/surroundings.hpp"

namespace pharos::tof {
namespace {

// Pixels beyond a region's outline that are checked for the step down: past the lens' blur and the mask's own error.
constexpr std::int32_t kBeyond_px = 3;
// Fraction of the outline along which the step must be seen; corners and occlusion by a neighbour take the rest.
constexpr double kMinRaised = 0.6;
// The step over its deviation; a patch of noise on the foil reaches 3.
constexpr double kMinSignificance = 6.0;
// Pixels that share one value of noise: it is correlated over some 1.5 px.
constexpr double kCommonPixels = 7.0;
// A median is noisier than a mean by this factor.
constexpr double kMedianNoise = 1.25;
// Faces of one kind differ in area by a third; patches beside the nozzle reach a third of a face.
constexpr double kAlikeArea = 2.0;
// The smallest rectangle is searched by rotation in these steps.
constexpr int kTurns = 45;

double ellipse_area_px(const RingModel& ring, const DepthCamera& camera) {
  const double per_m = camera.intrinsics.fx_px / ring.centre_m.z();
  return kPi * ring.radius_m[0] * ring.radius_m[0] * per_m * per_m * -ring.normal.z();
}

// The rectangle around the ring's image, grown to `reach` times its radius.
PixelRect search_rect(const DepthCamera& camera, const RingModel& ring, double reach) {
  const PlaneAxes axes = axes_of(ring.normal);
  double left = camera.intrinsics.width_px;
  double right = 0.0;
  double top = camera.intrinsics.height_px;
  double bottom = 0.0;
  constexpr int kDirections = 16;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = kTwoPi * k / kDirections;
    const Vector3 point =
        ring.centre_m + reach * ring.radius_m[0] * (std::cos(angle) * axes.first + std::sin(angle) * axes.second);
    const auto pixel = project(camera.intrinsics, point);
    if (!pixel) return {0, 0, camera.intrinsics.width_px, camera.intrinsics.height_px};
    left = std::min(left, pixel->x());
    right = std::max(right, pixel->x());
    top = std::min(top, pixel->y());
    bottom = std::max(bottom, pixel->y());
  }
  PixelRect rect;
  rect.u = static_cast<std::int32_t>(std::clamp(left, 0.0, camera.intrinsics.width_px - 1.0));
  rect.v = static_cast<std::int32_t>(std::clamp(top, 0.0, camera.intrinsics.height_px - 1.0));
  rect.width_px = static_cast<std::int32_t>(std::clamp(right, 0.0, camera.intrinsics.width_px - 1.0)) - rect.u + 1;
  rect.height_px = static_cast<std::int32_t>(std::clamp(bottom, 0.0, camera.intrinsics.height_px - 1.0)) - rect.v + 1;
  return rect;
}

// Limits of the filters for one region.
class RegionClassifier {
 public:
  RegionClassifier(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& fit,
                   const ConnectorSettings& settings, const ConnectorWorkspace& workspace)
      : frame_(frame),
        rays_(rays),
        fit_(fit),
        ring_(fit.model),
        axes_(axes_of(fit.model.normal)),
        settings_(settings),
        rect_(workspace.rect),
        heights_(workspace.heights.data(), workspace.rect.width_px, workspace.rect.height_px),
        min_area_px_(std::max(settings.min_area_px, settings.min_area_fraction * ellipse_area_px(fit.model, camera))),
        max_area_px_(settings.max_area_fraction * ellipse_area_px(fit.model, camera)) {}

  bool has_size(std::int32_t area_px) const { return area_px >= min_area_px_ && area_px <= max_area_px_; }

  RegionReport report(const Region& region) const {
    RegionReport report;
    report.area_px = region.area_px;
    report.left = rect_.u + region.left;
    report.right = rect_.u + region.right;
    report.top = rect_.v + region.top;
    report.bottom = rect_.v + region.bottom;
    if (!has_size(region.area_px)) return report;
    report.height_m = mean_height(region);
    measure_shape(region, report);
    report.verdict = verdict(region, report);
    return report;
  }

 private:
  RegionVerdict verdict(const Region& region, RegionReport& report) const {
    const double radius = ring_.radius_m[0];
    if (!(report.distance_m > kMinConnectorDistance * radius && report.distance_m < settings_.reach * radius)) {
      return RegionVerdict::kPlace;
    }
    const double clear = kClearOfRing * std::sqrt(report.area_m2);
    if (report.distance_m > ring_.radius_m[1] - clear && report.distance_m < radius + clear) {
      return RegionVerdict::kPlace;
    }
    if (!(report.aspect >= settings_.min_aspect && report.aspect <= settings_.max_aspect)) {
      return RegionVerdict::kAspect;
    }
    if (!(report.fill >= settings_.min_fill)) return RegionVerdict::kFill;
    if (std::fabs(report.height_m) > 0.9 * kMaxHeight_m || !stands_out(region, report)) {
      return RegionVerdict::kNotRaised;
    }
    return raised_fraction(region, report.height_m) >= kMinRaised ? RegionVerdict::kConnector
                                                                  : RegionVerdict::kNotRaised;
  }

  // Depth noise of a pixel of the region: that of the ring's, as their amplitudes are.
  double pixel_sigma_m(const Region& region) const {
    double sum = 0.0;
    double count = 0.0;
    for (std::int32_t v = region.top; v <= region.bottom; ++v) {
      const Region::Extent& row = region.row[static_cast<std::size_t>(v - region.top)];
      for (std::int32_t u = row.first; u <= row.last; ++u) {
        sum += frame_.intensity.at(rect_.u + u, rect_.v + v);
        count += 1.0;
      }
    }
    return fit_.plane_rms_m * fit_.amplitude * count / std::max(1.0, sum);
  }

  // Whether the face stands over the median of a frame around it, as wide as itself, by more than noise.
  bool stands_out(const Region& region, RegionReport& report) const {
    const Surroundings around = surroundings_of(heights_, region);
    if (around.samples < kMinSurroundings) return true;  // nothing around it but space
    report.step_m = report.height_m - around.base_m;
    const double face_sigma = pixel_sigma_m(region);
    const double base_sigma = kMedianNoise * around.sigma_m;
    const double squares =
        face_sigma * face_sigma * kCommonPixels / region.area_px +
        base_sigma * base_sigma * kCommonPixels /
            (static_cast<double>(around.samples) * std::min<std::int32_t>(around.stride_px * around.stride_px, 7));
    return report.step_m >= settings_.min_height_m &&
           report.step_m * report.step_m >= kMinSignificance * kMinSignificance * squares;
  }

  // From the region's interior: its rim is mixed with the level below.
  double mean_height(const Region& region) const {
    std::int64_t sum = 0;
    std::int32_t count = 0;
    std::int64_t sum_all = 0;
    std::int32_t count_all = 0;
    for (std::int32_t v = region.top; v <= region.bottom; ++v) {
      const Region::Extent& row = region.row[static_cast<std::size_t>(v - region.top)];
      for (std::int32_t u = row.first; u <= row.last; ++u) {
        const std::uint16_t counts = heights_.at(u, v);
        if (counts == kNoHeight) continue;
        sum_all += counts;
        ++count_all;
        const Region::Extent& column = region.column[static_cast<std::size_t>(u - region.left)];
        if (u < row.first + 2 || u > row.last - 2 || v < column.first + 2 || v > column.last - 2) continue;
        sum += counts;
        ++count;
      }
    }
    if (count > 0) return (static_cast<double>(sum) / count - kHeightZero) * kHeightUnit_m;
    if (count_all > 0) return (static_cast<double>(sum_all) / count_all - kHeightZero) * kHeightUnit_m;
    return 0.0;
  }

  // Fraction of the outline's points with depth where the surroundings lie lower.
  double raised_fraction(const Region& region, double height_m) const {
    const double below_m = height_m - settings_.min_height_m;
    int places = 0;
    int raised = 0;
    const auto look = [&](std::int32_t u, std::int32_t v) {
      if (!heights_.contains(u, v) || heights_.at(u, v) == kNoHeight) return;
      ++places;
      raised += height_of(heights_.at(u, v)) < below_m ? 1 : 0;
    };
    for (std::int32_t v = region.top; v <= region.bottom; ++v) {
      const Region::Extent& row = region.row[static_cast<std::size_t>(v - region.top)];
      look(row.first - kBeyond_px, v);
      look(row.last + kBeyond_px, v);
    }
    for (std::int32_t u = region.left; u <= region.right; ++u) {
      const Region::Extent& column = region.column[static_cast<std::size_t>(u - region.left)];
      look(u, column.first - kBeyond_px);
      look(u, column.last + kBeyond_px);
    }
    return places > 0 ? static_cast<double>(raised) / places : 1.0;
  }

  Vector2 planar(double u, double v, double height_m) const {
    const Vector2 ray = rays_.at(rect_.u + u, rect_.v + v);
    const DepthPlane plane = ring_.plane();
    const double z = (1.0 - height_m * plane.q.norm()) * plane.z_m(ray);
    const Vector3 arm = z * Vector3(ray.x(), ray.y(), 1.0) - ring_.centre_m;
    return {axes_.first.dot(arm), axes_.second.dot(arm)};
  }

  // Smallest rectangle around the region's outline, in the plane of its face; the map from pixels is linear over its
  // size.
  void measure_shape(const Region& region, RegionReport& report) const {
    const Vector2 middle = planar(region.u_px, region.v_px, report.height_m);
    Matrix2 map;
    map.col(0) = planar(region.u_px + 1.0, region.v_px, report.height_m) - middle;
    map.col(1) = planar(region.u_px, region.v_px + 1.0, report.height_m) - middle;
    report.distance_m = middle.norm();
    report.centroid_m = middle;
    report.area_m2 = region.area_px * std::fabs(map.determinant());
    double minimum = -1.0;
    for (int k = 0; k < kTurns; ++k) {
      const double angle = 0.5 * kPi * k / kTurns;
      const PlanarRectangle rectangle = around(region, map, middle, angle);
      const double area = rectangle.half_sides_m.x() * rectangle.half_sides_m.y();
      if (minimum >= 0.0 && area >= minimum) continue;
      minimum = area;
      report.rectangle = rectangle;
    }
    const Vector2 half = report.rectangle.half_sides_m;
    report.aspect = half.y() > 0.0 ? half.x() / half.y() : 0.0;
    report.fill = minimum > 0.0 ? region.area_px * std::fabs(map.determinant()) / (4.0 * minimum) : 0.0;
  }

  PlanarRectangle around(const Region& region, const Matrix2& map, const Vector2& middle, double angle) const {
    const Vector2 along(std::cos(angle), std::sin(angle));
    const Vector2 across(-along.y(), along.x());
    const Vector2 by_pixel_1 = map.transpose() * along;
    const Vector2 by_pixel_2 = map.transpose() * across;
    // Half a pixel's own width each way, as the mask's pixels are squares.
    const double half_1 = 0.5 * std::max(std::fabs(by_pixel_1.x()), std::fabs(by_pixel_1.y()));
    const double half_2 = 0.5 * std::max(std::fabs(by_pixel_2.x()), std::fabs(by_pixel_2.y()));
    double low_1 = 0.0, high_1 = 0.0, low_2 = 0.0, high_2 = 0.0;
    for (std::int32_t v = region.top; v <= region.bottom; ++v) {
      const Region::Extent& row = region.row[static_cast<std::size_t>(v - region.top)];
      for (const std::int16_t u : {row.first, row.last}) {
        const Vector2 off(u - region.u_px, v - region.v_px);
        low_1 = std::min(low_1, by_pixel_1.dot(off));
        high_1 = std::max(high_1, by_pixel_1.dot(off));
        low_2 = std::min(low_2, by_pixel_2.dot(off));
        high_2 = std::max(high_2, by_pixel_2.dot(off));
      }
    }
    return {middle + 0.5 * (low_1 + high_1) * along + 0.5 * (low_2 + high_2) * across, angle,
            Vector2(0.5 * (high_1 - low_1) + half_1, 0.5 * (high_2 - low_2) + half_2)};
  }

  const TofFrame& frame_;
  const RayGrid& rays_;
  const RingFit& fit_;
  const RingModel& ring_;
  PlaneAxes axes_;
  const ConnectorSettings& settings_;
  PixelRect rect_;
  ImageView<const std::uint16_t> heights_;
  double min_area_px_;
  double max_area_px_;
};

// Depth noise goes with the inverse of amplitude: dark pixels beside the ring are not part of a connector.
void drop_dark_pixels(const TofFrame& frame, const PixelRect& rect, double min_amplitude, BitImage& mask) {
  for (std::int32_t v = 0; v < rect.height_px; ++v) {
    const std::uint16_t* row = frame.intensity.row(rect.v + v) + rect.u;
    for (std::int32_t u = mask.next_set(0, v); u < rect.width_px; u = mask.next_set(u + 1, v)) {
      if (row[u] < min_amplitude) mask.clear(u, v);
    }
  }
}

void keep_nearest_first(StaticVector<RegionReport, kMaxConnectors>& list, const RegionReport& report) {
  if (list.full()) {
    if (list.back().distance_m <= report.distance_m) return;
    list.pop_back();
  }
  list.push_back(report);
  for (std::size_t i = list.size() - 1; i > 0 && list[i].distance_m < list[i - 1].distance_m; --i) {
    std::swap(list[i], list[i - 1]);
  }
}

// Equal in height, and in area within the factor: they may be two connectors of one satellite.
bool are_alike(const RegionReport& a, const RegionReport& b, double area_factor) {
  return a.step_m > 0.5 * b.step_m && a.step_m < 2.0 * b.step_m && area_factor * a.area_m2 > b.area_m2 &&
         a.area_m2 < area_factor * b.area_m2;
}

// A satellite's connectors are of one kind: regions much smaller or lower than the most prominent are dropped.
void keep_alike(StaticVector<RegionReport, kMaxConnectors>& list) {
  const auto prominence = [](const RegionReport& report) { return report.step_m * report.area_m2; };
  const RegionReport* first = nullptr;
  for (const RegionReport& report : list) {
    if (first == nullptr || prominence(report) > prominence(*first)) first = &report;
  }
  if (first == nullptr) return;
  const RegionReport reference = *first;
  std::size_t kept = 0;
  for (const RegionReport& report : list) {
    if (are_alike(report, reference, kAlikeArea)) list[kept++] = report;
  }
  list.resize(kept);
}

template <class Visit>
void for_each_region(ConnectorWorkspace& workspace, BitImage& mask, Visit visit) {
  for (std::int32_t v = 0; v < mask.height_px(); ++v) {
    // Region growing removes the region from the mask.
    for (std::int32_t u = mask.next_set(0, v); u < mask.width_px(); u = mask.next_set(u + 1, v)) {
      if (grow_region(mask, u, v, workspace.growing, workspace.region)) visit(workspace.region);
    }
  }
}

}  // namespace

void find_connectors(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& fit,
                     const ConnectorSettings& settings, ConnectorWorkspace& workspace) {
  workspace.regions.clear();
  workspace.connectors.clear();
  const RingModel& ring = fit.model;
  workspace.rect = search_rect(camera, ring, settings.reach);
  const PixelRect& rect = workspace.rect;
  const ImageView<std::uint16_t> heights(workspace.heights.data(), rect.width_px, rect.height_px);
  make_connector_heights(frame, camera, rays, ring, rect, heights);
  const double radius_px = ring.radius_m[0] * camera.intrinsics.fx_px / ring.centre_m.z();
  const auto half_window = std::max(settings.min_half_window_px,
                                    static_cast<std::int32_t>(std::lround(settings.window_fraction * radius_px)));
  local_threshold(heights, half_window, settings.form, workspace.threshold, workspace.mask);
  drop_dark_pixels(frame, rect, settings.min_amplitude * fit.amplitude, workspace.mask);
  open_and_close(workspace.mask, workspace.scratch);
  // The regions' own faces, at half their steps; region growing removes regions from the mask.
  workspace.faces.reset(rect.width_px, rect.height_px);
  for_each_region(workspace, workspace.mask, [&](const Region& region) {
    if (region.area_px >= settings.min_area_px) {
      mark_face(heights, region, settings.min_height_m, workspace.faces);
    }
  });
  drop_dark_pixels(frame, rect, settings.min_amplitude * fit.amplitude, workspace.faces);
  open_and_close(workspace.faces, workspace.scratch);
  const RegionClassifier classifier(frame, camera, rays, fit, settings, workspace);
  for_each_region(workspace, workspace.faces, [&](const Region& region) {
    const RegionReport report = classifier.report(region);
    if (report.verdict != RegionVerdict::kArea) workspace.regions.push_back(report);
    if (report.verdict == RegionVerdict::kConnector) keep_nearest_first(workspace.connectors, report);
  });
  keep_alike(workspace.connectors);
}

}  // namespace pharos::tof
