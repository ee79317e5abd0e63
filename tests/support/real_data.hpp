// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

namespace pharos::test {

/// Folder `name` of the real recordings: in $PHAROS_DATA, by default in ../shared/data beside the project.
inline std::filesystem::path real_data(const std::string& name) {
  const char* data = std::getenv("PHAROS_DATA");
  const auto source = std::filesystem::path(__FILE__).parent_path() / "../..";
  return (data != nullptr ? std::filesystem::path(data) : source / "../shared/data") / name;
}

/// Whether a test without its data fails: $PHAROS_REQUIRE_DATA is set, and not to 0. Otherwise it is skipped.
inline bool real_data_required() {
  const char* value = std::getenv("PHAROS_REQUIRE_DATA");
  return value != nullptr && !std::string_view(value).empty() && std::string_view(value) != "0";
}

inline std::string real_data_missing(const std::string& name) {
  return "no real data at " + real_data(name).string() + ": set PHAROS_DATA to the folder that holds " + name + "/";
}

}  // namespace pharos::test

/// Returns from the test where the real data `name` are missing: skipped with a message, or failed where they are
/// required.
#define PHAROS_NEEDS_DATA(name)                                                              \
  if (!std::filesystem::exists(pharos::test::real_data(name))) {                             \
    if (pharos::test::real_data_required()) FAIL() << pharos::test::real_data_missing(name); \
    GTEST_SKIP() << pharos::test::real_data_missing(name);                                   \
  }                                                                                          \
  static_assert(true, "")
