// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/report/exhibits.hpp"

#include <algorithm>
#include <cctype>

namespace pharos::tools::report {
namespace {

bool shows_something(const ComparisonRow& row) {
  return row.ours.has_value() || row.theirs.has_value() || !row.remark.empty();
}

}  // namespace

bool is_of(const Exhibit& exhibit, std::string_view item) {
  if (!item.starts_with(exhibit.label)) return false;
  return item.size() == exhibit.label.size() ||
         std::isdigit(static_cast<unsigned char>(item[exhibit.label.size()])) == 0;
}

std::vector<std::string> missing_of(const Exhibit& exhibit, const PartResult& result) {
  std::vector<std::string> missing;
  if (exhibit.parts.empty()) {
    if (exhibit.remark.empty()) missing.emplace_back("neither computed nor a sentence why not");
    return missing;
  }
  if (!exhibit.picture && exhibit.rows.empty() && exhibit.pictures.empty())
    missing.emplace_back("neither a picture nor a row is asked of its parts");
  const bool shown = std::any_of(result.pictures.begin(), result.pictures.end(),
                                 [&](const Picture& picture) { return is_of(exhibit, picture.label); });
  if (exhibit.picture && !shown) missing.emplace_back("no picture");
  for (const std::string& words : exhibit.pictures) {
    const bool there = std::any_of(result.pictures.begin(), result.pictures.end(), [&](const Picture& picture) {
      return is_of(exhibit, picture.label) && (picture.label + ": " + picture.caption).find(words) != std::string::npos;
    });
    if (!there) missing.push_back("no picture '" + words + "'");
  }
  for (const std::string& words : exhibit.rows) {
    const bool there = std::any_of(result.rows.begin(), result.rows.end(), [&](const ComparisonRow& row) {
      return is_of(exhibit, row.item) && shows_something(row) &&
             (row.item + ": " + row.what).find(words) != std::string::npos;
    });
    if (!there) missing.push_back("no row '" + words + "'");
  }
  return missing;
}

}  // namespace pharos::tools::report
