// SPDX-License-Identifier: Apache-2.0
// The image before noise must show the satellite's dimensions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/sim/tof/tof_simulator.hpp"

namespace pharos::sim {
namespace {

const PixelRays& rays() {
  static const PixelRays kRays(kPaperLens);
  return kRays;
}

const FoilTexture& foil() {
  static const FoilTexture kFoil(0.004, RandomStream(1, "foil"));
  return kFoil;
}

// For pictures whose foil is a plane.
const FoilTexture& flat() {
  static const FoilTexture kFlat(0.0, RandomStream(1, "foil"));
  return kFlat;
}

CameraFromTarget tilted() { return {attitude_of({12.0, -20.0, 35.0}), {0.15, -0.1, 3.4}}; }

IdealFrame picture(const Satellite& satellite, const CameraFromTarget& pose, const ImagingModel& imaging = {}) {
  const FoilTexture& texture = satellite.foil.height_m > 0.0 ? foil() : flat();
  return render_ideal(Scene(satellite, texture, pose), rays(), imaging);
}

std::size_t at(int u, int v) { return static_cast<std::size_t>(v) * 640 + static_cast<std::size_t>(u); }

Vector3 on_circle(double radius_m, double angle_rad, double z_m = 0.0) {
  return {radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), z_m};
}

// Between four pixels.
double amplitude_at(const IdealFrame& frame, const Vector2& pixel) {
  const int u = static_cast<int>(std::floor(pixel.x()));
  const int v = static_cast<int>(std::floor(pixel.y()));
  const double fu = pixel.x() - u;
  const double fv = pixel.y() - v;
  const auto value = [&](int du, int dv) { return static_cast<double>(frame.amplitude_counts[at(u + du, v + dv)]); };
  return (1 - fv) * ((1 - fu) * value(0, 0) + fu * value(1, 0)) + fv * ((1 - fu) * value(0, 1) + fu * value(1, 1));
}

TEST(IdealFrame, TheRingsFrontLiesInThePlaneOfThePose) {
  const Satellite satellite = satellite_of_ring(1.1);
  const IdealFrame frame = picture(satellite, tilted());
  const Vector3 normal = tilted().R.col(2);
  const double middle = 0.5 * (satellite.ring->outer_radius_m + satellite.ring->inner_radius_m);
  for (int i = 0; i < 60; ++i) {
    const Vector2 pixel = rays().project(tilted() * on_circle(middle, i * std::numbers::pi / 30.0));
    const int u = static_cast<int>(std::lround(pixel.x()));
    const int v = static_cast<int>(std::lround(pixel.y()));
    const Vector3 ray(rays().ray(u, v).x(), rays().ray(u, v).y(), 1.0);
    const double depth = static_cast<double>(frame.range_m[at(u, v)]) / ray.norm();
    EXPECT_NEAR(normal.dot(depth * ray - tilted().t), 0.0, 2e-5) << i;
  }
}

TEST(IdealFrame, TheRingsEdgesAreWhereItsCirclesProject) {
  // A flat white ring on a black body: along its radius the brightness falls to half where the circle projects.
  Satellite satellite = satellite_of_ring(1.1);
  satellite.face_z_m = -0.001;  // no wall to be seen
  satellite.foil = Foil{.height_m = 0.0, .albedo = 1e-9, .gloss = 0.0, .glint = 0.0};
  satellite.nozzle.reset();
  satellite.connectors.clear();
  const CameraFromTarget facing{attitude_of({0.0, 0.0, 0.0}), {0.02, 0.03, 4.0}};
  const IdealFrame frame = picture(satellite, facing);
  for (const double radius : {satellite.ring->outer_radius_m, satellite.ring->inner_radius_m}) {
    const double inward = radius == satellite.ring->outer_radius_m ? -1.0 : 1.0;
    double sum = 0.0;
    constexpr int kPlaces = 180;
    for (int i = 0; i < kPlaces; ++i) {
      const double angle = i * 2.0 * std::numbers::pi / kPlaces;
      const Vector2 edge = rays().project(facing * on_circle(radius, angle));
      const Vector2 ringwards = (rays().project(facing * on_circle(radius + 0.01 * inward, angle)) - edge).normalized();
      const double full = amplitude_at(frame, edge + 4.0 * ringwards);
      double place = -2.0;
      while (place < 2.0 && amplitude_at(frame, edge + place * ringwards) < 0.5 * full) place += 0.01;
      sum += place;
    }
    EXPECT_NEAR(sum / kPlaces, 0.0, 0.03) << radius;
  }
}

TEST(IdealFrame, AmplitudeFallsWithTheSquareOfRangeAndIsNominalForTheRing) {
  const Satellite satellite = satellite_of_ring(1.1);
  for (const double range : {3.16, 5.0}) {
    const CameraFromTarget pose{attitude_of({0.0, 0.0, 0.0}), {0.0, 0.0, range}};
    const IdealFrame frame = picture(satellite, pose);
    const Vector3 point = pose * on_circle(0.5 * (0.55 + 0.4895), 0.8);
    const Vector2 pixel = rays().project(point);
    const double near = kNominalRange_m / point.norm();
    EXPECT_NEAR(amplitude_at(frame, pixel), 8000.0 * near * near * point.z() / point.norm(), 20.0);
  }
}

TEST(IdealFrame, ConnectorsStandAboveTheFaceWhereTheyWerePut) {
  const Satellite satellite = satellite_of_ring(1.1);
  const IdealFrame frame = picture(satellite, tilted());
  for (const Connector& connector : satellite.connectors) {
    const Vector3 top = tilted() * on_circle(connector.distance_m, connector.direction_deg * std::numbers::pi / 180.0,
                                             satellite.face_z_m + connector.height_m);
    const Vector2 pixel = rays().project(top);
    const int u = static_cast<int>(std::lround(pixel.x()));
    const int v = static_cast<int>(std::lround(pixel.y()));
    EXPECT_NEAR(static_cast<double>(frame.range_m[at(u, v)]), top.norm(), 0.004);
  }
}

TEST(IdealFrame, NozzleIsDeepInTheMiddleAndItsRimStandsBeforeTheRing) {
  const Satellite satellite = satellite_of_ring(1.1);
  const CameraFromTarget facing{attitude_of({0.0, 0.0, 0.0}), {0.0, 0.0, 3.0}};
  const IdealFrame frame = picture(satellite, facing);
  const auto range = [&](const Vector3& p) {
    const Vector2 pixel = rays().project(facing * p);
    return static_cast<double>(
        frame.range_m[at(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())))]);
  };
  EXPECT_GT(range({0.0, 0.0, 0.0}), 3.0 - satellite.nozzle->throat_z_m);
  const double just_inside = satellite.nozzle->exit_radius_m - 0.012;
  EXPECT_LT(range(on_circle(just_inside, 1.0, satellite.nozzle->exit_z_m)), 3.0);
}

TEST(IdealFrame, FlyingPixelsLieBetweenTheTwoSidesOfAnEdge) {
  Satellite satellite = satellite_of_ring(1.1);
  satellite.foil = Foil{.height_m = 0.0, .albedo = 0.3, .gloss = 0.0, .glint = 0.0};
  satellite.nozzle.reset();
  satellite.connectors.clear();
  ImagingModel imaging;
  imaging.multipath = 0.0;
  const CameraFromTarget facing{attitude_of({0.0, 0.0, 0.0}), {0.0, 0.0, 4.0}};
  const IdealFrame frame = picture(satellite, facing, imaging);
  int between = 0;
  for (int v = 150; v < 330; ++v) {
    for (int u = 230; u < 410; ++u) {
      const double z = static_cast<double>(frame.range_m[at(u, v)]) / rays().range_per_depth(u, v);
      EXPECT_GT(z, 4.0 - 1e-4);
      EXPECT_LT(z, 4.0 - satellite.face_z_m + 1e-4);
      if (z > 4.02 && z < 4.08) ++between;
    }
  }
  EXPECT_GT(between, 200);
  EXPECT_LT(between, 3000);
}

TEST(IdealFrame, MultipathMakesTheRingsInsideSeemFartherAndLeavesItsFront) {
  const Satellite satellite = satellite_of_ring(1.1);
  const CameraFromTarget facing{attitude_of({0.0, 0.0, 0.0}), {0.0, 0.0, 3.0}};
  ImagingModel without;
  without.multipath = 0.0;
  const IdealFrame with = picture(satellite, facing);
  const IdealFrame clean = picture(satellite, facing, without);
  const auto added = [&](double radius, double z) {
    const Vector2 pixel = rays().project(facing * on_circle(radius, 0.5, z));
    const std::size_t i = at(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
    return static_cast<double>(with.range_m[i] - clean.range_m[i]);
  };
  EXPECT_GT(added(0.42, satellite.face_z_m), 0.003);
  EXPECT_NEAR(added(0.52, 0.0), 0.0, 1e-5);
}

TEST(IdealFrame, TheBoomHidesItsShareOfTheRing) {
  Satellite satellite = satellite_of_ring(1.1);
  satellite.occluder = Occluder{};
  const IdealFrame frame = picture(satellite, tilted());
  int hidden = 0;
  constexpr int kPlaces = 720;
  for (int i = 0; i < kPlaces; ++i) {
    const Vector3 point =
        tilted() * on_circle(satellite.ring->outer_radius_m - 0.01, i * 2 * std::numbers::pi / kPlaces);
    const Vector2 pixel = rays().project(point);
    const std::size_t j = at(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
    if (static_cast<double>(frame.range_m[j]) < point.norm() - 0.2) ++hidden;
  }
  EXPECT_NEAR(hidden / static_cast<double>(kPlaces), 1.0 / 3.0, 0.015);
}

TEST(IdealFrame, PaintedCirclesShowInLightAndNotInDepth) {
  Satellite satellite = satellite_of_ring(1.1);
  satellite.ring.reset();
  satellite.nozzle.reset();
  satellite.foil = Foil{.height_m = 0.0, .albedo = 0.1, .gloss = 0.0, .glint = 0.0};
  satellite.circles = {PaintedCircle{}};
  const CameraFromTarget facing{attitude_of({0.0, 0.0, 0.0}), {0.0, 0.0, 3.0}};
  const IdealFrame frame = picture(satellite, facing);
  const auto pixel = [&](double radius) { return rays().project(facing * on_circle(radius, 0.3, satellite.face_z_m)); };
  EXPECT_GT(amplitude_at(frame, pixel(0.1)), 3.0 * amplitude_at(frame, pixel(0.05)));
  const Vector2 line = pixel(0.1);
  const std::size_t i = at(static_cast<int>(std::lround(line.x())), static_cast<int>(std::lround(line.y())));
  EXPECT_NEAR(static_cast<double>(frame.range_m[i]), (facing * on_circle(0.1, 0.3, satellite.face_z_m)).norm(), 1e-3);
}

TEST(FoilTexture, HasTheHeightThatWasAskedForAndSlopesThatBelongToIt) {
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kSide = 200;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double x = (i % kSide) * FoilTexture::kSide_m / kSide;
    const double y = (i / kSide) * FoilTexture::kSide_m / kSide;
    const double height = foil().at(x, y).height_m;
    sum += height;
    squares += height * height;
  }
  const double mean = sum / (kSide * kSide);
  EXPECT_NEAR(std::sqrt(squares / (kSide * kSide) - mean * mean), 0.004, 2e-4);
  const double rise = foil().at(0.52, 0.3).height_m - foil().at(0.5, 0.3).height_m;
  double slopes = 0.0;
  for (int i = 0; i < 20; ++i) slopes += foil().at(0.5 + (i + 0.5) * 0.001, 0.3).slope_x * 0.001;
  EXPECT_NEAR(slopes, rise, 2e-4);
}

}  // namespace
}  // namespace pharos::sim
