// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <string>

namespace pharos::tools {

/// --seed: a whole number of 64 bits. Checked here, because CLI11 takes -1 for the largest one.
inline void add_seed_option(CLI::App& command, std::uint64_t& seed, const std::string& description) {
  const auto whole = [](const std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc{} && end == text.data() + text.size()) return std::string();
    return text + " is not a whole number from 0 to " + std::to_string(UINT64_MAX);
  };
  command.add_option("--seed", seed, description)->check(CLI::Validator(whole, "", "seed"))->capture_default_str();
}

}  // namespace pharos::tools
