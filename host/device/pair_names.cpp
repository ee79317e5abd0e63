// SPDX-License-Identifier: Apache-2.0
#include "host/device/pair_names.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string_view>

#include "host/images/image_names.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> images_in(const std::string& folder) {
  std::error_code error;
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (has_image_ending(entry.path())) images.push_back(entry.path());
  }
  if (error) throw InputError(folder + ": " + error.message() + "; name a folder of images");
  if (images.empty()) throw InputError(folder + ": holds no " + kImageEndings + " image");
  std::sort(images.begin(), images.end());
  return images;
}

// The name without a final _left or _right.
std::string name_of_pair(const fs::path& path) {
  const std::string stem = path.stem().string();
  for (const std::string_view side : {"_left", "_right"}) {
    if (stem.ends_with(side)) return stem.substr(0, stem.size() - side.size());
  }
  return stem;
}

// If both sides have names in common, images are paired by name, and an image without a partner is an error.
void refuse_lone(const std::vector<fs::path>& lefts, const std::vector<fs::path>& rights) {
  const auto [a, b] = std::mismatch(lefts.begin(), lefts.end(), rights.begin(), rights.end(),
                                    [](const auto& l, const auto& r) { return name_of_pair(l) == name_of_pair(r); });
  if (a == lefts.end() && b == rights.end()) return;
  const bool left_alone = b == rights.end() || (a != lefts.end() && name_of_pair(*a) < name_of_pair(*b));
  throw InputError((left_alone ? *a : *b).string() + ": has no partner; left and right belong together");
}

bool share_a_name(const std::vector<fs::path>& lefts, const std::vector<fs::path>& rights) {
  std::set<std::string> names;
  for (const fs::path& path : lefts) names.insert(name_of_pair(path));
  return std::any_of(rights.begin(), rights.end(),
                     [&](const auto& path) { return names.contains(name_of_pair(path)); });
}

std::optional<std::int64_t> stamp_ns(const fs::path& path) {
  const std::string stem = name_of_pair(path);
  const bool digits = std::all_of(stem.begin(), stem.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits || stem.size() < 16 || stem.size() > 19) return std::nullopt;
  try {
    return std::stoll(stem);
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

// Half the median step between stamps.
double half_step_ns(const std::vector<fs::path>& images) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < images.size(); ++k) {
    const auto a = stamp_ns(images[k - 1]), b = stamp_ns(images[k]);
    if (a && b) steps.push_back(static_cast<double>(*b - *a));
  }
  if (steps.empty()) return 1e18;
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
  return 0.5 * steps[steps.size() / 2];
}

// Paired images of both sides, in order, and each pair's position among all images of both sides.
struct Matched {
  std::vector<fs::path> lefts, rights;
  std::vector<std::size_t> places;
};

// Leaves out images without a partner and appends their names to `alone`. `order` is below 0 if the left image is
// before the right one, 0 if they are a pair.
template <class Order>
Matched match(const std::vector<fs::path>& lefts, const std::vector<fs::path>& rights, Order&& order,
              std::vector<std::string>& alone) {
  Matched matched;
  std::size_t a = 0, b = 0, place = 0;
  while (a < lefts.size() || b < rights.size()) {
    const int which = a == lefts.size() ? 1 : b == rights.size() ? -1 : order(lefts[a], rights[b]);
    if (which == 0) {
      matched.lefts.push_back(lefts[a++]);
      matched.rights.push_back(rights[b++]);
      matched.places.push_back(place);
    } else {
      alone.push_back((which < 0 ? lefts[a++] : rights[b++]).string());
    }
    ++place;
  }
  return matched;
}

Matched matched_by_stamps(const std::vector<fs::path>& lefts, const std::vector<fs::path>& rights,
                          std::vector<std::string>& alone) {
  const double tolerance_ns = half_step_ns(lefts);
  return match(
      lefts, rights,
      [tolerance_ns](const fs::path& l, const fs::path& r) {
        const double off_ns = static_cast<double>(*stamp_ns(l) - *stamp_ns(r));
        return std::abs(off_ns) <= tolerance_ns ? 0 : off_ns < 0.0 ? -1 : 1;
      },
      alone);
}

Matched matched_by_names(std::vector<fs::path> lefts, std::vector<fs::path> rights, std::vector<std::string>& alone) {
  for (std::vector<fs::path>* side : {&lefts, &rights}) {
    std::stable_sort(side->begin(), side->end(),
                     [](const auto& a, const auto& b) { return name_of_pair(a) < name_of_pair(b); });
  }
  return match(
      lefts, rights, [](const fs::path& l, const fs::path& r) { return name_of_pair(l).compare(name_of_pair(r)); },
      alone);
}

bool all_stamped(const std::vector<fs::path>& images) {
  return std::all_of(images.begin(), images.end(), [](const auto& path) { return stamp_ns(path).has_value(); });
}

std::vector<PairName> paired(const std::vector<fs::path>& lefts, const std::vector<fs::path>& rights, double rate_hz,
                             const std::vector<std::size_t>& places = {}) {
  const double tolerance_ns = half_step_ns(lefts);
  const bool stamped = all_stamped(lefts);
  std::vector<PairName> pairs;
  for (std::size_t k = 0; k < lefts.size(); ++k) {
    const auto a = stamp_ns(lefts[k]), b = stamp_ns(rights[k]);
    if (a && b && std::abs(static_cast<double>(*a - *b)) > tolerance_ns) {
      throw InputError(lefts[k].string() + " and " + rights[k].string() +
                       " are no pair: left and right are out of step; remove those that have no partner");
    }
    const std::size_t index = places.empty() ? k : places[k];
    const double time_s = stamped ? static_cast<double>(*a) * 1e-9 : static_cast<double>(index) / rate_hz;
    if (!pairs.empty() && time_s <= pairs.back().time_s) {
      throw InputError(lefts[k].string() + ": its time is not after the image before it");
    }
    pairs.push_back({lefts[k].string(), rights[k].string(), time_s, stamped ? a : std::nullopt, lefts[k].stem()});
  }
  return pairs;
}

}  // namespace

std::vector<PairName> pair_names(const std::string& left, const std::string& right, double rate_hz,
                                 std::vector<std::string>* alone) {
  const auto lefts = images_in(left), rights = images_in(right);
  const bool stamped = all_stamped(lefts) && all_stamped(rights);
  if (alone != nullptr && (stamped || share_a_name(lefts, rights))) {
    std::vector<std::string> left_out;
    const Matched matched =
        stamped ? matched_by_stamps(lefts, rights, left_out) : matched_by_names(lefts, rights, left_out);
    if (matched.lefts.size() >= left_out.size() && !matched.lefts.empty()) {
      alone->insert(alone->end(), left_out.begin(), left_out.end());
      return paired(matched.lefts, matched.rights, rate_hz, matched.places);
    }
  }
  // Time stamps of two cameras may differ slightly: paired() below allows half a frame.
  if (!stamp_ns(lefts.front()) && share_a_name(lefts, rights)) refuse_lone(lefts, rights);
  if (lefts.size() != rights.size()) {
    throw InputError(left + " holds " + std::to_string(lefts.size()) + " images and " + right + " " +
                     std::to_string(rights.size()) + "; remove those that have no partner");
  }
  return paired(lefts, rights, rate_hz);
}

std::vector<PairName> pair_names_in(const std::string& directory, double rate_hz) {
  const fs::path folder(directory);
  std::error_code ignored;
  if (fs::is_directory(folder / "left", ignored)) {
    return pair_names((folder / "left").string(), (folder / "right").string(), rate_hz);
  }
  std::array<std::vector<fs::path>, 2> sides;
  for (const fs::path& image : images_in(directory)) {
    const std::string stem = image.stem().string();
    if (stem.ends_with("_left")) sides[0].push_back(image);
    if (stem.ends_with("_right")) sides[1].push_back(image);
  }
  const auto& [lefts, rights] = sides;
  if (lefts.empty() && rights.empty()) {
    throw InputError(directory + ": holds no pairs: NAME_left.png and NAME_right.png, or folders left and right");
  }
  refuse_lone(lefts, rights);
  return paired(lefts, rights, rate_hz);
}

}  // namespace pharos::host
