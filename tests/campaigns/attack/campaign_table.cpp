// SPDX-License-Identifier: Apache-2.0
#include "campaigns/attack/campaign_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "integration/camera/network_namespace.hpp"

namespace pharos::host {
namespace {

std::vector<CampaignRow>& rows() {
  static std::vector<CampaignRow> all;
  return all;
}

void print(const CampaignRow& row) {
  const std::string lost = row.lost ? std::to_string(*row.lost) : "-";
  std::printf("| %s | %s | %lld | %s | %s |\n", row.test.c_str(), row.load.c_str(),
              static_cast<long long>(row.false_answers), lost.c_str(), row.memory.c_str());
}

class CampaignTable : public ::testing::Environment {
 public:
  void TearDown() override {
    std::printf("\n| test | load | false | lost | memory |\n|---|---|---|---|---|\n");
    for (const CampaignRow& row : rows()) print(row);
  }
};

const ::testing::Environment* const kNetwork = ::testing::AddGlobalTestEnvironment(new NetworkNamespace);
const ::testing::Environment* const kTable = ::testing::AddGlobalTestEnvironment(new CampaignTable);

}  // namespace

void add_row(const CampaignRow& row) {
  rows().push_back(row);
  print(row);
  std::fflush(stdout);
}

std::string memory_text(const std::string& name, double mib) {
  return name + ' ' + std::to_string(static_cast<int>(mib + 0.5)) + " MiB";
}

std::string seconds_text(double seconds) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f s", seconds);
  return text.data();
}

std::string peak_memory(const std::string& name, pid_t process) {
  std::ifstream about("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(about, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return memory_text(name, std::atof(line.c_str() + 6) / 1024.0);
  }
  return name + " ended";
}

std::int64_t campaign_size(const char* variable, std::int64_t usual) {
  const char* asked = std::getenv(variable);
  return asked == nullptr ? usual : std::atoll(asked);
}

}  // namespace pharos::host
