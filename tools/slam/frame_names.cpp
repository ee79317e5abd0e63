// SPDX-License-Identifier: Apache-2.0
#include "tools/slam/frame_names.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "host/support/input_error.hpp"

namespace pharos::tools {
namespace {

std::vector<std::filesystem::path> images_in(const std::string& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> images;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".png" || extension == ".pgm") images.push_back(entry.path());
  }
  if (error) throw host::InputError(folder + ": " + error.message() + "; name a folder of images");
  if (images.empty()) throw host::InputError(folder + ": holds no .png or .pgm image");
  std::sort(images.begin(), images.end());
  return images;
}

std::optional<std::int64_t> stamp_ns(const std::filesystem::path& path) {
  const std::string stem = path.stem().string();
  const bool digits = std::all_of(stem.begin(), stem.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits || stem.size() < 16 || stem.size() > 19) return std::nullopt;
  try {
    return std::stoll(stem);
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

// Half the median step between stamps.
double half_step_ns(const std::vector<std::filesystem::path>& images) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < images.size(); ++k) {
    const auto a = stamp_ns(images[k - 1]), b = stamp_ns(images[k]);
    if (a && b) steps.push_back(static_cast<double>(*b - *a));
  }
  if (steps.empty()) return 1e18;
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
  return 0.5 * steps[steps.size() / 2];
}

}  // namespace

std::vector<PairName> pair_names(const std::string& left, const std::string& right, double rate_hz) {
  const auto lefts = images_in(left), rights = images_in(right);
  if (lefts.size() != rights.size()) {
    throw host::InputError(left + " holds " + std::to_string(lefts.size()) + " images and " + right + " " +
                           std::to_string(rights.size()) + "; remove those that have no partner");
  }
  const double tolerance_ns = half_step_ns(lefts);
  const bool stamped =
      std::all_of(lefts.begin(), lefts.end(), [](const auto& path) { return stamp_ns(path).has_value(); });
  std::vector<PairName> pairs;
  for (std::size_t k = 0; k < lefts.size(); ++k) {
    const auto a = stamp_ns(lefts[k]), b = stamp_ns(rights[k]);
    if (a && b && std::abs(static_cast<double>(*a - *b)) > tolerance_ns) {
      throw host::InputError(lefts[k].string() + " and " + rights[k].string() +
                             " are no pair: left and right are out of step; remove those that have no partner");
    }
    const double time_s = stamped ? static_cast<double>(*a) * 1e-9 : static_cast<double>(k) / rate_hz;
    if (!pairs.empty() && time_s <= pairs.back().time_s) {
      throw host::InputError(lefts[k].string() + ": its time is not after the image before it");
    }
    pairs.push_back({lefts[k].string(), rights[k].string(), time_s, lefts[k].stem().string()});
  }
  return pairs;
}

}  // namespace pharos::tools
