// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/report/content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace pharos::tools::report {

bool all_parts_there(const Exhibit& exhibit, const std::map<std::string, FinishedPart>& parts) {
  return std::all_of(exhibit.parts.begin(), exhibit.parts.end(),
                     [&](std::string_view id) { return parts.contains(std::string(id)); });
}

PartResult result_of(const Exhibit& exhibit, const std::map<std::string, FinishedPart>& parts) {
  PartResult all;
  for (const std::string_view id : exhibit.parts) {
    const auto part = parts.find(std::string(id));
    if (part == parts.end()) continue;
    const PartResult& one = part->second.result;
    all.rows.insert(all.rows.end(), one.rows.begin(), one.rows.end());
    all.pictures.insert(all.pictures.end(), one.pictures.begin(), one.pictures.end());
  }
  return all;
}

std::vector<ComparisonRow> rows_of(const Exhibit& exhibit, const ReportContent& content) {
  const PartResult result = result_of(exhibit, content.parts);
  std::vector<ComparisonRow> rows;
  std::copy_if(result.rows.begin(), result.rows.end(), std::back_inserter(rows),
               [&](const ComparisonRow& row) { return is_of(exhibit, row.item); });
  return rows;
}

std::vector<ComparisonRow> further_rows_of(const Paper& paper, const ReportContent& content) {
  std::vector<ComparisonRow> rows;
  for (const auto& [id, part] : content.parts) {
    const bool of_paper = std::any_of(exhibits().begin(), exhibits().end(), [&id = id, &paper](const Exhibit& exhibit) {
      return exhibit.paper == paper.number &&
             std::find(exhibit.parts.begin(), exhibit.parts.end(), id) != exhibit.parts.end();
    });
    if (!of_paper) continue;
    for (const ComparisonRow& row : part.result.rows) {
      const bool numbered = std::any_of(exhibits().begin(), exhibits().end(), [&](const Exhibit& exhibit) {
        return exhibit.paper == paper.number && is_of(exhibit, row.item);
      });
      if (!numbered) rows.push_back(row);
    }
  }
  return rows;
}

std::string heading_of(const Exhibit& exhibit) {
  std::string label(exhibit.label);
  label[0] = static_cast<char>(label[0] - 'a' + 'A');
  return label + ": " + std::string(exhibit.caption);
}

std::string made_by(std::string_view id, const FinishedPart& part) {
  return fmt::format("part {}{}: {:.0f} s", id, part.quick ? ", quick" : "", part.seconds);
}

std::string origin_of(const ReportContent& content) {
  return fmt::format("Commit {}, seed {}.", content.commit, content.seed);
}

std::string shown(const std::optional<double>& value, const std::string& published) {
  return value ? rounded_as(*value, published) : "";
}

}  // namespace pharos::tools::report
