// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/support/output.hpp"

namespace pharos::tools {

/// Results of other methods than the paper's, in the same unit: with a calibration, motion-aware, with both.
struct FurtherColumns {
  double calibrated = 0.0;
  double motion = 0.0;
  double both = 0.0;
};

/// One line of a comparison: a published or required figure, and ours.
struct ComparisonRow {
  std::string item;                  // "table 2", "hmd_static"
  std::string what;                  // "run 1, rotation RMS"
  std::string unit;                  // "deg", "arcsec", "" for counts and ratios
  std::string expected;              // as published or required, in the same unit: a number, a bound ("<= 9.2") or text
  std::optional<double> ours = 0.0;  // empty: no answer, and the remark says why
  std::string remark;
  std::optional<FurtherColumns> further = std::nullopt;
  std::optional<double> theirs = std::nullopt;  // the published method, rerun on the same inputs as ours
  bool comparable = true;                       // false: published and ours are of other things, so no ratio
};

/// ours / published where `expected` is a number and the row is comparable; else empty.
std::optional<double> ratio_of(const ComparisonRow& row);
/// ours / theirs, of rows that have both and are comparable.
std::optional<double> ratio_to_theirs(const ComparisonRow& row);

/// A figure with three digits, as in a README.
std::string rounded(double value);

/// The same, but with as many decimals as the published number beside it, where that has more.
std::string rounded_as(double value, const std::string& published);

/// Writes `item,what,unit,published,ours,ratio,remark`; after it, where any row has them, `calibrated,motion,both` and
/// `theirs`.
void write_rows(const std::vector<ComparisonRow>& rows, const OutputOptions& options);
/// The same as a Markdown table for a README, rounded to three digits.
void write_markdown(const std::vector<ComparisonRow>& rows, const std::string& path);
/// One of the two, selected by --markdown.
void write_comparison(const std::vector<ComparisonRow>& rows, bool markdown, const OutputOptions& options);

}  // namespace pharos::tools
