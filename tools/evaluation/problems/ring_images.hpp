// SPDX-License-Identifier: Apache-2.0
#pragma once

// Rendered docking rings with known ellipses, and the measures for a detector on them. Independent of the detector:
// pharos bench, its sweep of thresholds and the tests use the same set.
#include "tools/evaluation/problems/painted_scene.hpp"

namespace pharos::test {

struct RingSet {
  double min_tilt_deg = 0.0, max_tilt_deg = 60.0;
  double min_range_m = 2.0, max_range_m = 6.0;
  double max_hidden = 0.0;    ///< fraction of the ring that is covered
  bool foil = true;           ///< wrinkled foil on the body around the ring
  bool dots = true;           ///< small discs: some true ellipses under 15 px
  bool leaves_image = false;  ///< the ring's centre anywhere in the image
  double noise = 1.0;         ///< times that of 8000 electrons full well, 20 electrons read
  PaintedCamera camera;
};

struct RingImage {
  struct Truth {
    TrueEllipse ellipse;
    double visible = 1.0;  ///< fraction of the outline inside the image and not hidden
  };
  std::vector<std::uint16_t> pixels;
  std::vector<Truth> truth;
};

class RingGenerator {
 public:
  RingGenerator(const RingSet& set, std::uint64_t seed) : set_(set), random_(seed) {}

  RingImage next() {
    PaintedScene scene(set_.camera, uniform(0.02, 0.15));
    RingImage image;
    outlines_.clear();
    const Vec3 centre = centre_of_ring();
    const Vec3 normal = tilted();
    const double body = uniform(0.2, 0.45);
    add_body(scene, centre, body);
    add_ring(scene, centre, normal, body);
    if (set_.dots) add_dots(scene, centre, normal);
    if (set_.max_hidden > 0.0) hide(scene, outlines_.front().ellipse);
    for (Outline& o : outlines_) image.truth.push_back({o.ellipse, visible_fraction(scene, o)});
    Imaging imaging;
    imaging.blur_px = uniform(0.5, 1.0);
    imaging.full_well_e /= set_.noise * set_.noise;
    imaging.read_noise_e /= set_.noise;
    image.pixels = scene.image(imaging, random_);
    return image;
  }

 private:
  struct Outline {
    TrueEllipse ellipse;
    int layer;
  };

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  Vec3 centre_of_ring() {
    const double z = uniform(set_.min_range_m, set_.max_range_m);
    const PaintedCamera& c = set_.camera;
    // Whole rings keep away from the border by their radius; 0.6 is a little more than the largest ring's.
    const double margin_px = set_.leaves_image ? 0.0 : c.focal_px * 0.6 / z;
    const double half_u = std::max(0.0, 0.5 * c.width_px - margin_px),
                 half_v = std::max(0.0, 0.5 * c.height_px - margin_px);
    return {z * uniform(-half_u, half_u) / c.focal_px, z * uniform(-half_v, half_v) / c.focal_px, z};
  }
  Vec3 tilted() {
    const double tilt = uniform(set_.min_tilt_deg, set_.max_tilt_deg) * std::numbers::pi / 180.0;
    const double direction = uniform(0.0, 2.0 * std::numbers::pi);
    return {std::sin(tilt) * std::cos(direction), std::sin(tilt) * std::sin(direction), -std::cos(tilt)};
  }
  std::array<double, 2> project(const Vec3& p) const {
    return {set_.camera.cx_px() + set_.camera.focal_px * p[0] / p[2],
            set_.camera.cy_px() + set_.camera.focal_px * p[1] / p[2]};
  }
  Polygon square(std::array<double, 2> centre, double half_px, double turn, int corners) {
    Polygon polygon;
    for (int k = 0; k < corners; ++k) {
      const double angle = turn + 2.0 * std::numbers::pi * (k + 0.5) / corners;
      polygon.corners_px.push_back({centre[0] + half_px * std::cos(angle), centre[1] + half_px * std::sin(angle)});
    }
    return polygon;
  }

  void add(PaintedScene& scene, Layer layer) {
    scene.add(std::move(layer));
    ++layers_;
  }
  void add_body(PaintedScene& scene, const Vec3& centre, double value) {
    layers_ = 0;
    const std::array<double, 2> middle = project(centre);
    const double half_px = set_.camera.focal_px * 1.1 / centre[2], turn = uniform(0.0, std::numbers::pi);
    add(scene, {square(middle, half_px, turn, 4), value});
    if (!set_.foil) return;
    const int facets = static_cast<int>(uniform(20.0, 60.0));
    for (int k = 0; k < facets; ++k) {
      const std::array<double, 2> place = {middle[0] + uniform(-0.7, 0.7) * half_px,
                                           middle[1] + uniform(-0.7, 0.7) * half_px};
      const int corners = 3 + static_cast<int>(uniform(0.0, 3.0));
      add(scene,
          {square(place, uniform(0.03, 0.25) * half_px, uniform(0.0, 6.0), corners), value * uniform(0.75, 1.25)});
    }
  }
  void add_disc(PaintedScene& scene, const Disc& disc, double value) {
    outlines_.push_back({disc.outline(set_.camera), layers_});
    add(scene, {disc, value});
  }
  // Bright ring over a darker inside, and a nozzle in it.
  void add_ring(PaintedScene& scene, const Vec3& centre, const Vec3& normal, double body) {
    const double radius = uniform(0.3, 0.55), width = uniform(0.06, 0.12) * radius, inside = uniform(0.5, 1.1) * body;
    add_disc(scene, {centre, normal, radius}, uniform(0.6, 0.95));
    add_disc(scene, {centre, normal, radius - width}, inside);
    const double deep = uniform(0.0, 0.2);
    const Vec3 behind = {centre[0] - deep * normal[0], centre[1] - deep * normal[1], centre[2] - deep * normal[2]};
    const double nozzle = uniform(0.35, 0.5) * radius;
    add_disc(scene, {behind, normal, nozzle}, std::min(1.0, inside + uniform(0.15, 0.35)));
    add_disc(scene, {behind, normal, uniform(0.4, 0.7) * nozzle}, uniform(0.02, 0.1));
  }
  void add_dots(PaintedScene& scene, const Vec3& centre, const Vec3& normal) {
    for (int k = 0; k < 6; ++k) {
      const double angle = (k + uniform(-0.2, 0.2)) * std::numbers::pi / 3.0, away = uniform(0.64, 0.7);
      // Two directions across the normal.
      const Vec3 across = {normal[2], 0.0, -normal[0]};
      const Vec3 up = {normal[1] * across[2], normal[2] * across[0] - normal[0] * across[2], -normal[1] * across[0]};
      Vec3 place = centre;
      for (std::size_t i = 0; i < 3; ++i) place[i] += away * (std::cos(angle) * across[i] + std::sin(angle) * up[i]);
      add_disc(scene, {place, normal, uniform(0.02, 0.06)}, uniform(0.7, 1.0));
    }
  }
  // A bar across a sector of the ring, from outside to its middle.
  void hide(PaintedScene& scene, const TrueEllipse& ring) {
    const double half_angle = std::numbers::pi * uniform(0.5, 1.0) * set_.max_hidden,
                 at = uniform(0.0, 2.0 * std::numbers::pi);
    Polygon sector;
    sector.corners_px.push_back({ring.cx_px, ring.cy_px});
    for (int k = 0; k <= 6; ++k) {
      const double t = at + half_angle * (k - 3) / 3.0;
      const double x = 1.6 * ring.a_px * std::cos(t), y = 1.6 * ring.b_px * std::sin(t);
      const double c = std::cos(ring.theta_rad), s = std::sin(ring.theta_rad);
      sector.corners_px.push_back({ring.cx_px + c * x - s * y, ring.cy_px + s * x + c * y});
    }
    add(scene, {sector, uniform(0.02, 0.5)});
  }

  // Positions just inside and outside of the outline belong to the disc and to its background.
  double visible_fraction(const PaintedScene& scene, const Outline& o) const {
    constexpr int kPlaces = 180;
    int seen = 0;
    for (int k = 0; k < kPlaces; ++k) {
      const double t = 2.0 * std::numbers::pi * k / kPlaces;
      const TrueEllipse& e = o.ellipse;
      const auto place = [&](double grow) {
        const double x = (e.a_px + grow) * std::cos(t), y = (e.b_px + grow) * std::sin(t);
        const double c = std::cos(e.theta_rad), s = std::sin(e.theta_rad);
        return std::array<double, 2>{e.cx_px + c * x - s * y, e.cy_px + s * x + c * y};
      };
      const auto in = place(-0.3), out = place(0.3);
      const bool in_image =
          out[0] > 2.0 && out[1] > 2.0 && out[0] < set_.camera.width_px - 3.0 && out[1] < set_.camera.height_px - 3.0;
      if (in_image && scene.layer_at(in[0], in[1]) == o.layer && scene.layer_at(out[0], out[1]) < o.layer) ++seen;
    }
    return static_cast<double>(seen) / kPlaces;
  }

  RingSet set_;
  std::mt19937_64 random_;
  std::vector<Outline> outlines_;
  int layers_ = 0;
};

/// Intersection over union of two ellipses, by counting points of a grid over both.
inline double overlap_of(const TrueEllipse& one, const TrueEllipse& other) {
  const double low_u = std::min(one.cx_px - one.a_px, other.cx_px - other.a_px),
               high_u = std::max(one.cx_px + one.a_px, other.cx_px + other.a_px);
  const double low_v = std::min(one.cy_px - one.a_px, other.cy_px - other.a_px),
               high_v = std::max(one.cy_px + one.a_px, other.cy_px + other.a_px);
  const auto covering = [](const TrueEllipse& e) {
    return [e, c = std::cos(e.theta_rad), s = std::sin(e.theta_rad)](double u, double v) {
      const double du = u - e.cx_px, dv = v - e.cy_px;
      const double x = (c * du + s * dv) / e.a_px, y = (c * dv - s * du) / e.b_px;
      return x * x + y * y < 1.0;
    };
  };
  const auto one_covers = covering(one), other_covers = covering(other);
  if (std::hypot(one.cx_px - other.cx_px, one.cy_px - other.cy_px) > one.a_px + other.a_px) return 0.0;
  constexpr int kSide = 200;
  int both = 0, either = 0;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const double u = low_u + (high_u - low_u) * (i + 0.5) / kSide, v = low_v + (high_v - low_v) * (j + 0.5) / kSide;
      const bool a = one_covers(u, v), b = other_covers(u, v);
      both += a && b ? 1 : 0;
      either += a || b ? 1 : 0;
    }
  }
  return either == 0 ? 0.0 : static_cast<double>(both) / either;
}

/// Score of a detector over many images, on ellipses of at least `min_minor_px`.
struct RingScore {
  double min_minor_px = 15.0;
  double min_visible = 0.6;  ///< less visible outlines count neither as missed nor as false
  int wanted = 0, matched = 0, wrong = 0;
  std::vector<double> axis_errors_px;  ///< |a - true a| and |b - true b| of every match
  std::vector<double> centre_errors_px;

  /// Best overlaps first; a match is an overlap above 0.8.
  void add(const RingImage& image, const std::vector<TrueEllipse>& found) {
    struct Pair {
      double overlap;
      std::size_t truth, found;
    };
    std::vector<Pair> pairs;
    for (std::size_t t = 0; t < image.truth.size(); ++t) {
      for (std::size_t f = 0; f < found.size(); ++f) {
        const double overlap = overlap_of(image.truth[t].ellipse, found[f]);
        if (overlap > 0.8) pairs.push_back({overlap, t, f});
      }
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.overlap > b.overlap; });
    std::vector<bool> truth_used(image.truth.size()), found_used(found.size());
    for (const Pair& p : pairs) {
      if (truth_used[p.truth] || found_used[p.found]) continue;
      truth_used[p.truth] = found_used[p.found] = true;
      const auto& truth = image.truth[p.truth];
      if (!asked(truth)) continue;
      ++matched;
      axis_errors_px.push_back(std::abs(truth.ellipse.a_px - found[p.found].a_px));
      axis_errors_px.push_back(std::abs(truth.ellipse.b_px - found[p.found].b_px));
      centre_errors_px.push_back(
          std::hypot(truth.ellipse.cx_px - found[p.found].cx_px, truth.ellipse.cy_px - found[p.found].cy_px));
    }
    for (const auto& truth : image.truth) wanted += asked(truth) ? 1 : 0;
    for (std::size_t f = 0; f < found.size(); ++f) wrong += !found_used[f] && found[f].b_px >= min_minor_px ? 1 : 0;
  }
  bool asked(const RingImage::Truth& truth) const {
    return truth.ellipse.b_px >= min_minor_px && truth.visible >= min_visible;
  }
  double recall() const { return wanted == 0 ? 0.0 : static_cast<double>(matched) / wanted; }
  double precision() const { return matched + wrong == 0 ? 0.0 : static_cast<double>(matched) / (matched + wrong); }
  double f() const {
    const double sum = recall() + precision();
    return sum == 0.0 ? 0.0 : 2.0 * recall() * precision() / sum;
  }
};

}  // namespace pharos::test
