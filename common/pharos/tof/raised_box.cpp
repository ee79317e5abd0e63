// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/raised_box.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/tof/box_fit.hpp"
#include "pharos/tof/constants.hpp"

namespace pharos::tof {
namespace {

// Side of the square whose mean height is looked at: within connectors of 65 mm whatever their turn.
constexpr double kSeedSide_m = 0.045;
// A seed's height over its deviation: of the squares of a face one is that high by noise, and its box is not.
constexpr double kMinSignificance = 4.0;
// Noiseless pictures: the depths' own steps.
constexpr double kMinNoise_m = 0.0005;
// Larger than any connector or cover: boom, wing, the rim of a wide nozzle.
constexpr double kMaxBox_m = 0.45;
// Odds of 10^11 to 1: some 10^4 places are compared in a frame.
constexpr double kMinLogLikelihood = 25.0;
// Odds of 400 to 1 that the sides of a box lead down to the plate; two of them may be hidden by ring and dark foil.
constexpr double kMinPlateLogOdds = 6.0;
constexpr int kMaxUnknownSides = 2;
// Cells' votes for the top, 1 each without noise; at a noise of half the step 0.6 is left.
constexpr double kMinAgreement = 0.35;
// A face is flat foil or a panel: heights of squares that differ more than this from the plate's belong to something
// that stands on it, and are no measure of noise. Metres.
constexpr double kPlateWithin_m = 0.03;

// Of the plate's median height.
constexpr int kMedianPasses = 4;
constexpr double kMedianSettled_m = 0.0002;
// Seeds looked at, some 0.2 ms each: specks take one each, the walls of a thruster dozens.
constexpr int kMaxSeeds = 24;
// Of connected raised cells so many are looked at before the rest is known to be scraps of what was found there.
constexpr int kEnoughTries = 4;
// Cells beside something before the satellite whose pixels are mixed with it.
constexpr int kMixedCells = 2;

// A raised cell becomes a seed once the cells connected to it are known: its state is then kSeed or more, the same for
// all of them.
enum State : std::uint8_t { kFlat, kRaised, kTaken, kSeed };

class BoxFinder {
 public:
  BoxFinder(const RingModel& ring, const ConnectorSettings& settings, RaisedWorkspace& workspace)
      : ring_(ring), settings_(settings), workspace_(workspace), grid_(workspace.grid) {}

  void find() {
    half_ = std::max(1, static_cast<int>(0.5 * (kSeedSide_m / grid_.cell_m() - 1.0) + 0.5));
    measure_plate();
    measure_noise();
    mark_raised();
    take_structures();
    list_seeds();
    for (int k = 0; k < kMaxSeeds && !workspace_.boxes.full(); ++k) {
      const int seed = best_seed();
      if (seed < 0) break;
      ++tries_[workspace_.state[static_cast<std::size_t>(seed)]];
      add_box(seed % kMaxGridSide, seed / kMaxGridSide);
    }
    workspace_.complete = !is_any_left();
  }

 private:
  double radius_of(int column, int row) const { return grid_.place_of(column, row).norm(); }
  double base_at(int column, int row) const {
    const double radius = ring_.radius_m[0];
    return grid_.place_of(column, row).squaredNorm() < radius * radius ? workspace_.base_m : workspace_.outer_base_m;
  }
  template <class Visit>
  void for_some_cells(int stride, Visit visit) const {
    for (int row = 0; row < grid_.side(); row += stride) {
      for (int column = 0; column < grid_.side(); column += stride) visit(column, row);
    }
  }

  // Median height of the cells between two radii; again of those near it, so that what stands there does not shift it.
  double median_height(double min_m, double max_m, double otherwise) {
    double median = otherwise;
    for (int pass = 0; pass < kMedianPasses; ++pass) {
      std::size_t count = 0;
      for_some_cells(3, [&](int column, int row) {
        if (!(grid_.weight(column, row) > 0.0F)) return;
        const double radius2 = grid_.place_of(column, row).squaredNorm();
        if (!(radius2 > min_m * min_m && radius2 < max_m * max_m)) return;
        const auto height = static_cast<double>(grid_.height_m(column, row));
        if (pass > 0 && std::fabs(height - median) > kPlateWithin_m) return;
        samples_[count++] = static_cast<float>(height);
      });
      if (count < 30) return pass > 0 ? median : otherwise;
      const auto middle = samples_.begin() + static_cast<std::ptrdiff_t>(count / 2);
      std::nth_element(samples_.begin(), middle, samples_.begin() + static_cast<std::ptrdiff_t>(count));
      const double before = median;
      median = static_cast<double>(*middle);
      if (pass > 0 && std::fabs(median - before) < kMedianSettled_m) break;
    }
    return median;
  }

  // The plate inside and outside of the ring: two faces on some bodies. Beside a small plate lie the body's sides; the
  // plate is then the same.
  void measure_plate() {
    const double outer = ring_.radius_m[0];
    workspace_.base_m = median_height(kMinConnectorDistance * outer, ring_.radius_m[1], 0.0);
    if (workspace_.base_m == 0.0) workspace_.base_m = median_height(outer, 2.0 * outer, 0.0);
    const double outside = median_height(outer, 1.35 * outer, workspace_.base_m);
    workspace_.outer_base_m = outside < workspace_.base_m - kPlateWithin_m ? workspace_.base_m : outside;
  }

  void measure_noise() {
    std::size_t count = 0;
    for_some_cells(3, [&](int column, int row) {
      const ReliefGrid::Sum sum = grid_.square(column, row, half_);
      if (!(sum.weight > 0.0) || radius_of(column, row) < kMinConnectorDistance * ring_.radius_m[0]) return;
      const double over = std::fabs(sum.height_m() - base_at(column, row));
      if (over < kPlateWithin_m) samples_[count++] = static_cast<float>(over * std::sqrt(sum.weight));
    });
    workspace_.noise_m = kMinNoise_m;
    if (count < 30) return;
    const auto middle = samples_.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(samples_.begin(), middle, samples_.begin() + static_cast<std::ptrdiff_t>(count));
    workspace_.noise_m = std::max(kMinNoise_m, kMedianToSigma * static_cast<double>(*middle));
  }

  // Height of the square about a cell over its deviation; 0 where it does not stand out.
  double significance(const ReliefGrid::Sum& sum, double base_m) const {
    if (!(sum.moment > (base_m + settings_.min_height_m) * sum.weight) || !(sum.weight > 0.0)) return 0.0;
    const double sigmas = (sum.height_m() - base_m) * std::sqrt(sum.weight) / workspace_.noise_m;
    return sigmas > kMinSignificance ? sigmas : 0.0;
  }
  void mark_raised() {
    const double nearest = kMinConnectorDistance * ring_.radius_m[0];
    for_some_cells(1, [&](int column, int row) {
      const std::size_t cell = ReliefGrid::index(column, row);
      workspace_.state[cell] = kFlat;
      if (grid_.place_of(column, row).squaredNorm() < nearest * nearest) return;  // the nozzle's
      const ReliefGrid::Sum sum = grid_.square(column, row, half_);
      const double sigmas = significance(sum, base_at(column, row));
      workspace_.state[cell] = sigmas > 0.0 ? kRaised : kFlat;
      workspace_.significance[cell] = static_cast<float>(sigmas);
    });
  }

  // Takes connected raised cells that are too large for a box.
  void take_structures() {
    component_ = kSeed;
    tries_.fill(0);
    for_some_cells(1, [&](int column, int row) {
      const std::size_t cell = ReliefGrid::index(column, row);
      if (workspace_.state[cell] == kRaised) take_if_structure(column, row);
    });
  }
  void take_if_structure(int column, int row) {
    auto& front = workspace_.front;
    std::size_t count = 0;
    int left = column, right = column, top = row, bottom = row;
    const auto visit = [&](int u, int v) {
      if (u < 0 || v < 0 || u >= grid_.side() || v >= grid_.side()) return;
      const std::size_t cell = ReliefGrid::index(u, v);
      if (workspace_.state[cell] != kRaised) return;
      workspace_.state[cell] = component_;
      front[count++] = static_cast<std::uint16_t>(cell);
    };
    visit(column, row);
    for (std::size_t next = 0; next < count; ++next) {
      const int u = front[next] % kMaxGridSide, v = front[next] / kMaxGridSide;
      left = std::min(left, u);
      right = std::max(right, u);
      top = std::min(top, v);
      bottom = std::max(bottom, v);
      visit(u - 1, v);
      visit(u + 1, v);
      visit(u, v - 1);
      visit(u, v + 1);
    }
    if (grid_.cell_m() * std::max(right - left, bottom - top) < kMaxBox_m) {
      if (component_ < kLastComponent) ++component_;
      return;
    }
    for (std::size_t k = 0; k < count; ++k) workspace_.state[front[k]] = kTaken;
  }

  void list_seeds() {
    seeds_ = 0;
    for_some_cells(1, [&](int column, int row) {
      const std::size_t cell = ReliefGrid::index(column, row);
      if (workspace_.state[cell] < kSeed) return;
      if (beside_hidden(column, row)) {
        workspace_.state[cell] = kTaken;
      } else {
        workspace_.front[seeds_++] = static_cast<std::uint16_t>(cell);
      }
    });
  }
  // Connected cells take turns, so that a thruster's walls do not keep a connector from being looked at.
  int best_seed() const {
    int best = -1, fewest = kMaxSeeds;
    float most = 0.0F;
    for (std::size_t k = 0; k < seeds_; ++k) {
      const std::uint16_t cell = workspace_.front[k];
      const std::uint8_t state = workspace_.state[cell];
      if (state < kSeed || tries_[state] > fewest) continue;
      if (tries_[state] == fewest && workspace_.significance[cell] <= most) continue;
      fewest = tries_[state];
      most = workspace_.significance[cell];
      best = cell;
    }
    return best;
  }
  bool is_any_left() const {
    return std::any_of(workspace_.front.begin(), workspace_.front.begin() + static_cast<std::ptrdiff_t>(seeds_),
                       [&](std::uint16_t cell) {
                         const std::uint8_t state = workspace_.state[cell];
                         return state >= kSeed && tries_[state] < kEnoughTries;
                       });
  }

  void add_box(int column, int row) {
    const double base = base_at(column, row);
    const BoxFit fit = fit_box(grid_, {column, row, grid_.square(column, row, half_).height_m(), base,
                                       workspace_.noise_m, wall_slope(grid_.place_of(column, row))});
    take(fit.rectangle, column, row);
    RaisedBox box;
    box.height_m = fit.height_m;
    box.base_m = base;
    const double per_noise = fit.step_m() / workspace_.noise_m;
    box.log_likelihood = 0.5 * per_noise * per_noise * fit.votes;
    if (fit.height_m < base + settings_.min_height_m || box.log_likelihood < kMinLogLikelihood ||
        !on_place(fit.rectangle))
      return;
    box.verdict = verdict_of(fit);
    if (box.verdict == BoxVerdict::kStructure) return;
    if (box.verdict == BoxVerdict::kUnclear && touches_ring(fit.rectangle)) return;
    box.rectangle = fit.rectangle;
    box.rectangle.centre_m = at_height(fit.rectangle.centre_m, fit.height_m);
    if (RaisedBox* same = overlapped_by(box)) {
      if (box.log_likelihood > same->log_likelihood) *same = box;
    } else {
      workspace_.boxes.push_back(box);
    }
  }
  // A box found before that holds this one's centre, or whose centre lies in this one: the same, fitted twice.
  RaisedBox* overlapped_by(const RaisedBox& box) {
    for (RaisedBox& other : workspace_.boxes) {
      if (box.rectangle.holds(other.rectangle.centre_m) || other.rectangle.holds(box.rectangle.centre_m)) return &other;
    }
    return nullptr;
  }

  // At the rim of something before the satellite pixels are mixed.
  bool beside_hidden(int column, int row) const {
    const int reach = half_ + kMixedCells;
    for (int v = std::max(0, row - reach); v <= std::min(grid_.side() - 1, row + reach); ++v) {
      for (int u = std::max(0, column - reach); u <= std::min(grid_.side() - 1, column + reach); ++u) {
        if (grid_.hidden(u, v)) return true;
      }
    }
    return false;
  }

  // Cells whose squares touch the rectangle seed no other.
  void take(const PlanarRectangle& rectangle, int column, int row) {
    const Vector2 first = rectangle.outward(0), second = rectangle.outward(1);
    const double beyond = (half_ + 1) * grid_.cell_m();
    for (std::size_t k = 0; k < seeds_; ++k) {
      const std::uint16_t cell = workspace_.front[k];
      std::uint8_t& state = workspace_.state[cell];
      const int cell_row = cell / kMaxGridSide;
      const Vector2 off = grid_.place_of(cell % kMaxGridSide, cell_row) - rectangle.centre_m;
      if (std::fabs(first.dot(off)) < rectangle.half_sides_m.x() + beyond &&
          std::fabs(second.dot(off)) < rectangle.half_sides_m.y() + beyond) {
        state = kTaken;
      }
    }
    workspace_.state[ReliefGrid::index(column, row)] = kTaken;
  }

  bool on_place(const PlanarRectangle& rectangle) const {
    const double distance = rectangle.centre_m.norm(), radius = ring_.radius_m[0];
    if (distance < kMinConnectorDistance * radius) return false;
    const double clear = kClearOfRing * 2.0 * rectangle.half_sides_m.minCoeff();
    return distance < ring_.radius_m[1] - clear || distance > radius + clear;
  }

  // Slivers along the ring are rests of its walls.
  bool touches_ring(const PlanarRectangle& r) const {
    const double margin = 2.0 * grid_.cell_m();
    for (int k = 0; k < 8; ++k) {
      // The middle of a side, or the corner after it.
      const int side = k / 2;
      Vector2 place = r.centre_m + r.half_side(side) * r.outward(side);
      if (k % 2 == 1) place += r.half_side(side + 1) * r.outward(side + 1);
      const double distance = place.norm();
      if (distance > ring_.radius_m[1] - margin && distance < ring_.radius_m[0] + margin) return true;
    }
    return false;
  }

  BoxVerdict verdict_of(const BoxFit& fit) const {
    const Vector2 sides = 2.0 * fit.rectangle.half_sides_m;
    const double cell = grid_.cell_m();
    const BoxSides around = sides_of(grid_, fit, workspace_.noise_m, wall_slope(fit.rectangle.centre_m));
    if (around.hidden > 0) return BoxVerdict::kStructure;
    const bool small = sides.minCoeff() + cell < settings_.min_side_m;
    if (small && around.level == 0) return BoxVerdict::kOther;
    if (fit.agreement < kMinAgreement || around.level > 0 || around.unknown > kMaxUnknownSides ||
        around.plate_log_odds < kMinPlateLogOdds)
      return BoxVerdict::kUnclear;
    if (sides.maxCoeff() - cell > settings_.max_aspect * (sides.minCoeff() + cell)) return BoxVerdict::kOther;
    const double ring_area = kPi * ring_.radius_m[0] * ring_.radius_m[0];
    if (fit.rectangle.area_m2() > settings_.max_area_fraction * ring_area) return BoxVerdict::kOther;
    return BoxVerdict::kConnector;
  }

  // Where the ray through a place of the ring's plane is at another height.
  Vector2 at_height(const Vector2& place, double height_m) const { return place - height_m * wall_slope(place); }
  // Displacement in the ring's plane of what stands a metre over it.
  Vector2 wall_slope(const Vector2& place) const {
    const PlaneAxes axes = axes_of(ring_.normal);
    const Vector3 point = ring_.centre_m + place.x() * axes.first + place.y() * axes.second;
    return Vector2(axes.first.dot(point), axes.second.dot(point)) / -ring_.normal.dot(point);
  }

  const RingModel& ring_;
  const ConnectorSettings& settings_;
  RaisedWorkspace& workspace_;
  const ReliefGrid& grid_;
  int half_ = 1;
  std::size_t seeds_ = 0;  // cells listed in workspace_.front
  static constexpr std::uint8_t kLastComponent = 255;
  std::uint8_t component_ = kSeed;
  std::array<std::uint8_t, kLastComponent + 1> tries_{};  // by the state of connected cells
  std::array<float, ReliefGrid::kMaxCells / 9 + static_cast<std::size_t>(kMaxGridSide)> samples_;
};

}  // namespace

void find_raised_boxes(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& ring,
                       const ConnectorSettings& settings, RaisedWorkspace& workspace) {
  workspace.boxes.clear();
  workspace.grid.make(frame, camera, rays, ring, settings.reach * ring.model.radius_m[0]);
  BoxFinder(ring.model, settings, workspace).find();
}

double log_likelihood_of_box(const RaisedWorkspace& workspace, const RingModel& ring, int column, int row,
                             double half_m, double step_m) {
  const ReliefGrid& grid = workspace.grid;
  const double radius = grid.place_of(column, row).norm();
  const double base = radius < ring.radius_m[0] ? workspace.base_m : workspace.outer_base_m;
  // The square within one of any turn.
  const int half = std::max(1, static_cast<int>(half_m / std::sqrt(2.0) / grid.cell_m()));
  const ReliefGrid::Sum sum = grid.square(column, row, half);
  const double per_noise = step_m / workspace.noise_m;
  return 0.5 * per_noise * per_noise * sum.weight * (2.0 * (sum.height_m() - base) / step_m - 1.0);
}

}  // namespace pharos::tof
