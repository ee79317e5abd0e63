// SPDX-License-Identifier: Apache-2.0
#include "tools/calibrate/board_pictures.hpp"

#include <cmath>
#include <filesystem>

#include "host/calibrate/camera/board_image.hpp"
#include "host/images/canvas.hpp"
#include "host/support/input_error.hpp"
#include "tools/calibrate/printf_text.hpp"

namespace pharos::tools {
namespace {

namespace colours = host::colours;
using calibrate::ImageOutcome;
using calibrate::ImageStatus;
using host::Canvas;
using host::Place;

constexpr double kDotsTimes = 1000.0;
constexpr double kCornersTimes = 100.0;

Place place(const Vector2& pixel) { return {pixel.x(), pixel.y()}; }

void draw_points(Canvas& canvas, const calibrate::FoundBoard& found) {
  for (std::size_t i = 0; i + 1 < found.points.size(); ++i) {
    canvas.line(place(found.points[i].pixel), place(found.points[i + 1].pixel), colours::kSky, 1.0);
  }
  for (const calibrate::FoundPoint& point : found.points) canvas.cross(place(point.pixel), colours::kOrange, 4.0);
  canvas.text(place(found.points.front().pixel), "1", colours::kYellow);
}

void draw_residuals(Canvas& canvas, const ImageOutcome& image, const calibrate::Board& board,
                    const PinholeCamera& camera, const calibrate::CameraFromBoard& T) {
  const double times = board.kind == calibrate::BoardKind::kDots ? kDotsTimes : kCornersTimes;
  for (std::size_t i = 0; i < board.size(); ++i) {
    const Vector2 found = image.search.board.points[i].pixel;
    const Vector2 residual = found - calibrate::project_board_point(camera, T, board, i).pixel;
    canvas.line(place(found), place(found + times * residual), colours::kGreen, 2.0);
  }
  canvas.text({4.0, 4.0}, printf_text("rms %.4f px; residuals x %.0f", image.rms_px, times), colours::kWhite);
}

}  // namespace

BoardPictures::BoardPictures(const std::vector<std::string>& paths, ImageInput& input) {
  images_.resize(paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::string error;
    try {
      images_[i] = input.read(paths[i]);
    } catch (const host::InputError& unreadable) {
      input.leave_out(unreadable);
      error = unreadable.what();
    }
    pictures_.push_back({paths[i], std::as_const(images_[i]).view(), error});
  }
}

void write_board_overlays(const std::string& folder, const std::string& prefix, const BoardPictures& pictures,
                          const std::vector<ImageOutcome>& images, const calibrate::Board& board,
                          const PinholeCamera* camera, const std::vector<calibrate::CameraFromBoard>& poses) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw host::InputError(folder + ": cannot be made: " + error.message() + "; choose another folder");
  for (std::size_t i = 0; i < images.size(); ++i) {
    const ImageOutcome& image = images[i];
    if (image.search.status == ImageStatus::kUnreadable) continue;
    const calibrate::GreyView view = pictures.pictures()[i].image;
    Canvas canvas(view, Canvas::zoom_for(view.width_px));
    if (!image.search.board.points.empty()) draw_points(canvas, image.search.board);
    if (image.search.status == ImageStatus::kUsed && camera != nullptr) {
      draw_residuals(canvas, image, board, *camera, poses[image.view]);
    } else if (image.search.status != ImageStatus::kUsed) {
      canvas.text({4.0, 4.0}, std::string(name_of(image.search.status)) + ": " + image.search.detail, colours::kOrange);
    }
    const std::string name = std::filesystem::path(image.name).stem().string();
    canvas.write_png((std::filesystem::path(folder) / (prefix + name + ".png")).string());
  }
}

}  // namespace pharos::tools
