// SPDX-License-Identifier: Apache-2.0
#include "tools/slam/pair_files.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>

#include "host/cameras/pair_order.hpp"
#include "host/files/same_file.hpp"
#include "host/support/input_error.hpp"
#include "tools/support/output.hpp"

namespace pharos::tools {
namespace {

// The first so many pairs; if there are fewer, all of them forwards and backwards repeatedly, at even times.
std::vector<host::PairName> prolonged(const std::vector<host::PairName>& pairs, std::size_t wanted) {
  if (wanted <= pairs.size()) return {pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(wanted)};
  if (pairs.size() < 2) throw host::InputError(pairs.front().left + ": one pair cannot be gone through there and back");
  const std::size_t last = pairs.size() - 1;
  const double step_s = (pairs.back().time_s - pairs.front().time_s) / static_cast<double>(last);
  std::vector<host::PairName> out;
  for (std::size_t k = 0; k < wanted; ++k) {
    const std::size_t place = k % (2 * last);
    out.push_back(pairs[place <= last ? place : 2 * last - place]);
    out.back().time_s = pairs.front().time_s + step_s * static_cast<double>(k);
  }
  return out;
}

std::optional<std::int64_t> number_of(const std::string& name) {
  std::int64_t value = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, value);
  return error == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

// File names that are numbers with gaps: without time stamps, time would be counted as if no image were missing.
void note_gap(const std::vector<host::PairName>& pairs) {
  double usual = 0.0;  // numbers a second
  for (std::size_t k = 1; k < pairs.size(); ++k) {
    const auto before = number_of(pairs[k - 1].stem), now = number_of(pairs[k].stem);
    if (!before || !now || pairs[k].stamp_ns) return;
    const double rate = static_cast<double>(*now - *before) / (pairs[k].time_s - pairs[k - 1].time_s);
    if (k == 1) usual = rate;
    if (rate < 1.5 * usual) continue;
    note(pairs[k].left + ": numbers are missing before it, and times count images: later ones are early; name images " +
         "by their ns to tell their times");
    return;
  }
}

}  // namespace

std::vector<host::PairName> wanted_pairs(const PairChoice& choice, RunFigures& figures) {
  if (host::same_file(choice.left, choice.right)) {
    throw host::NoPairError(choice.left + " and " + choice.right + ": " + host::text_of(host::PairFault::kEqual));
  }
  std::vector<std::string> alone;
  std::vector<host::PairName> pairs = host::pair_names(choice.left, choice.right, choice.rate_hz, &alone);
  for (const std::string& image : alone) note(image + ": has no partner; left out");
  figures.without_partner = static_cast<int>(alone.size());
  note_gap(pairs);
  return choice.pairs > 0 ? prolonged(pairs, choice.pairs) : pairs;
}

PairImages read_pair(const host::PairName& pair) {
  return {host::read_grey_image(pair.left), host::read_grey_image(pair.right)};
}

void require_size(const host::PairName& pair, const PairImages& images, const host::RigFile& rig) {
  const PinholeCamera& intrinsics = rig.left.intrinsics;
  for (const auto& [image, path] : {std::pair{&images.left, &pair.left}, {&images.right, &pair.right}}) {
    if (image->width_px == intrinsics.width_px && image->height_px == intrinsics.height_px) continue;
    throw host::InputError(*path + ": has " + std::to_string(image->width_px) + " x " +
                           std::to_string(image->height_px) + " pixels; the rig's cameras have " +
                           std::to_string(intrinsics.width_px) + " x " + std::to_string(intrinsics.height_px));
  }
}

void require_two_views(const host::PairName& pair, const PairImages& images) {
  const auto [least, most] = std::minmax_element(images.left.pixels.begin(), images.left.pixels.end());
  if (least == most || *least == *most) return;  // of one value: a dark room, not a picture
  const host::PairFault fault = host::pair_fault({images.left.view(), images.right.view()});
  if (fault != host::PairFault::kNone) {
    throw host::NoPairError(pair.left + " and " + pair.right + ": " + host::text_of(fault));
  }
}

}  // namespace pharos::tools
