// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/bench_ellipses.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include "host/table/row_writer.hpp"
#include "pharos/ellipse/detect.hpp"
#include "tools/evaluation/problems/drawn_ellipses.hpp"
#include "tools/support/stopwatch.hpp"

namespace pharos::tools {
namespace {

using test::PaintedCamera;
using test::RingImage;
using test::RingScore;
using test::RingSet;
using test::TrueEllipse;

constexpr int kEllipseRepeats = 3;
constexpr std::uint64_t kEllipseSeed = 1;
constexpr double kEllipse_ms = 1e3;
// Dots and holes of a sheet count from here on.
constexpr double kSmallestOnSheet_px = 4.0;

struct NamedSet {
  const char* name;
  RingSet set;
};

std::array<NamedSet, 4> sets() {
  RingSet tilted, facing, hidden, noisy;
  facing.max_tilt_deg = 35.0;
  hidden.max_hidden = 1.0 / 3.0;
  noisy.noise = 3.0;
  return {{{"to 60 deg", tilted}, {"to 35 deg", facing}, {"a third hidden", hidden}, {"noise x 3", noisy}}};
}

struct EllipseRecord {
  RingScore score;
  std::vector<double> seconds;
};

class OurDetector {
 public:
  explicit OurDetector(const PaintedCamera& camera)
      : camera_(camera), planes_(ellipse::kPlanes * static_cast<std::size_t>(camera.width_px * camera.height_px)) {
    workspace_->planes = planes_;
  }
  std::vector<TrueEllipse> detect(const RingImage& image, const ellipse::EllipseSettings& settings, double& seconds) {
    const ImageView<const std::uint16_t> view(image.pixels.data(), camera_.width_px, camera_.height_px);
    seconds = processor_seconds_of([&] { ellipse::detect_ellipses(view, settings, *workspace_); });
    std::vector<TrueEllipse> found;
    for (const ellipse::DetectedEllipse& one : workspace_->found) {
      const ellipse::Ellipse& e = one.ellipse;
      found.push_back({e.cx_px, e.cy_px, e.a_px, e.b_px, e.theta_rad});
    }
    return found;
  }

 private:
  PaintedCamera camera_;
  std::vector<std::uint16_t> planes_;
  std::unique_ptr<ellipse::EllipseWorkspace> workspace_ =
      std::make_unique<ellipse::EllipseWorkspace>(std::span<std::uint16_t>());
};

template <class Detect>
void run_one(const RingImage& image, EllipseRecord& record, Detect&& detect) {
  double minimum = 1e9;
  std::vector<TrueEllipse> found;
  for (int k = 0; k < kEllipseRepeats; ++k) {
    double seconds = 0.0;
    found = detect(seconds);
    minimum = std::min(minimum, seconds);
  }
  record.seconds.push_back(minimum);
  record.score.add(image, found);
}

std::vector<TrueEllipse> peer_ellipses(EdgeDrawingFunction peer, const RingImage& image, const PaintedCamera& camera,
                                       double& seconds) {
  std::vector<std::uint8_t> bytes;
  for (const std::uint16_t value : image.pixels) bytes.push_back(static_cast<std::uint8_t>(value >> 8));
  constexpr int kMax = 512;
  std::array<double, 5 * kMax> rows{};
  const int count = peer(bytes.data(), camera.width_px, camera.height_px, rows.data(), kMax, &seconds);
  std::vector<TrueEllipse> found;
  for (std::size_t k = 0; count > 0 && k < static_cast<std::size_t>(count); ++k) {
    found.push_back({rows[5 * k], rows[5 * k + 1], rows[5 * k + 2], rows[5 * k + 3], rows[5 * k + 4]});
  }
  return found;
}

// Both detectors on the images of one generator, and their rows.
template <class Generator>
void compare(const std::string& name, const PaintedCamera& camera, double min_minor_px, Generator generator, int images,
             EdgeDrawingFunction peer, std::vector<BenchRow>& rows) {
  EllipseRecord ours, theirs;
  ours.score.min_minor_px = theirs.score.min_minor_px = min_minor_px;
  OurDetector detector(camera);
  for (int k = 0; k < images; ++k) {
    const RingImage image = generator.next();
    run_one(image, ours, [&](double& seconds) { return detector.detect(image, {}, seconds); });
    if (peer == nullptr) continue;
    run_one(image, theirs, [&](double& seconds) { return peer_ellipses(peer, image, camera, seconds); });
  }
  const auto add = [&](const char* what, double our_value, double their_value, const char* unit, bool less) {
    const std::optional<double> value = peer == nullptr ? std::nullopt : std::optional<double>(their_value);
    rows.push_back({name + ": " + what, our_value, value, unit, less});
  };
  add("recall", ours.score.recall(), theirs.score.recall(), "", false);
  add("F", ours.score.f(), theirs.score.f(), "", false);
  add("median error of an axis", middle_of(ours.score.axis_errors_px), middle_of(theirs.score.axis_errors_px), "px",
      true);
  add("time", kEllipse_ms * middle_of(ours.seconds), kEllipse_ms * middle_of(theirs.seconds), "ms", true);
}

}  // namespace

std::vector<BenchRow> bench_ellipses(int images, EdgeDrawingFunction peer) {
  std::vector<BenchRow> rows;
  for (const NamedSet& named : sets()) {
    compare(std::string("rings ") + named.name, named.set.camera, RingScore{}.min_minor_px,
            test::RingGenerator(named.set, kEllipseSeed), images, peer, rows);
  }
  for (const bool rings : {false, true}) {
    test::SheetSet set;
    set.rings = rings;
    compare(rings ? "sheets of rings" : "sheets of dots", set.camera, kSmallestOnSheet_px,
            test::SheetGenerator(set, kEllipseSeed), images, peer, rows);
  }
  return rows;
}

void write_threshold_sweep(int images, BenchForm form) {
  constexpr std::array<double, 11> kThresholds = {0.40, 0.50, 0.55, 0.60, 0.64, 0.68, 0.72, 0.76, 0.80, 0.85, 0.90};
  std::array<RingScore, kThresholds.size()> scores;
  for (const NamedSet& named : sets()) {
    const RingSet& set = named.set;
    OurDetector detector(set.camera);
    test::RingGenerator generator(set, kEllipseSeed + 1);
    for (int k = 0; k < images; ++k) {
      const RingImage image = generator.next();
      for (std::size_t t = 0; t < kThresholds.size(); ++t) {
        ellipse::EllipseSettings settings;
        settings.min_score = kThresholds[t];
        double seconds = 0.0;
        scores[t].add(image, detector.detect(image, settings, seconds));
      }
    }
  }
  host::RowWriter writer(stdout, form == BenchForm::kJson ? host::RowFormat::kJson : host::RowFormat::kCsv,
                         {"t_val", "wanted", "matched", "wrong", "recall", "precision", "f"});
  for (std::size_t t = 0; t < kThresholds.size(); ++t) {
    const RingScore& s = scores[t];
    writer.number(kThresholds[t]).integer(s.wanted).integer(s.matched).integer(s.wrong);
    writer.number(s.recall()).number(s.precision()).number(s.f()).end_row();
  }
  writer.flush();
}

}  // namespace pharos::tools
