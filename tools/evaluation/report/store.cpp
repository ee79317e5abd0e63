// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/report/store.hpp"

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/files/atomic_file.hpp"

namespace pharos::tools::report {
namespace {

using Json = nlohmann::json;

constexpr const char* kFile = "part.json";
constexpr int kFormat = 1;

// FNV-1a, 64 bits: tells one build of the program from another.
std::uint64_t hash_of_program() {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  std::uint64_t hash = 14695981039346656037ULL;
  std::array<char, 65536> block{};
  while (file.read(block.data(), block.size()) || file.gcount() > 0) {
    for (std::streamsize i = 0; i < file.gcount(); ++i) {
      hash = (hash ^ static_cast<unsigned char>(block[static_cast<std::size_t>(i)])) * 1099511628211ULL;
    }
  }
  return hash;
}

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }
std::optional<double> number_of(const Json& value) {
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

Json json_of(const ComparisonRow& row) {
  Json json = {{"item", row.item},          {"what", row.what},
               {"unit", row.unit},          {"published", row.expected},
               {"ours", json_of(row.ours)}, {"theirs", json_of(row.theirs)},
               {"remark", row.remark},      {"comparable", row.comparable}};
  if (row.further) json["further"] = {row.further->calibrated, row.further->motion, row.further->both};
  return json;
}

ComparisonRow row_of(const Json& json) {
  ComparisonRow row;
  row.item = json.at("item").get<std::string>();
  row.what = json.at("what").get<std::string>();
  row.unit = json.at("unit").get<std::string>();
  row.expected = json.at("published").get<std::string>();
  row.ours = number_of(json.at("ours"));
  row.theirs = number_of(json.at("theirs"));
  row.remark = json.at("remark").get<std::string>();
  row.comparable = json.at("comparable").get<bool>();
  if (json.contains("further")) {
    const Json& further = json.at("further");
    row.further = FurtherColumns{further.at(0).get<double>(), further.at(1).get<double>(), further.at(2).get<double>()};
  }
  return row;
}

FinishedPart part_of(const Json& json) {
  FinishedPart part;
  part.key = json.at("key").get<std::string>();
  part.command = json.at("command").get<std::string>();
  part.quick = json.at("quick").get<bool>();
  part.seconds = json.at("seconds").get<double>();
  for (const Json& row : json.at("rows")) part.result.rows.push_back(row_of(row));
  for (const Json& picture : json.at("pictures")) {
    part.result.pictures.push_back({picture.at("label").get<std::string>(), picture.at("caption").get<std::string>(),
                                    picture.at("file").get<std::string>()});
  }
  return part;
}

}  // namespace

std::string key_of(const std::string& part, const PartSettings& settings) {
  static const std::uint64_t program = hash_of_program();
  return part + (settings.quick ? " quick" : " whole") + (settings.rays ? " rays" : "") + " seed " +
         std::to_string(settings.seed) + " program " + std::to_string(program);
}

void keep(const FinishedPart& part, const std::filesystem::path& folder) {
  Json rows = Json::array(), pictures = Json::array();
  for (const ComparisonRow& row : part.result.rows) rows.push_back(json_of(row));
  for (const Picture& picture : part.result.pictures) {
    pictures.push_back({{"label", picture.label}, {"caption", picture.caption}, {"file", picture.file}});
  }
  const Json json = {{"format", kFormat},       {"key", part.key}, {"command", part.command}, {"quick", part.quick},
                     {"seconds", part.seconds}, {"rows", rows},    {"pictures", pictures}};
  host::write_file((folder / kFile).string(), json.dump(1) + "\n");
}

std::optional<FinishedPart> kept_part(const std::filesystem::path& folder, const std::string& key) {
  std::ifstream file(folder / kFile);
  if (!file) return std::nullopt;
  const Json json = Json::parse(file, nullptr, false);
  if (json.is_discarded() || !json.is_object() || json.value("format", 0) != kFormat) return std::nullopt;
  try {
    FinishedPart part = part_of(json);
    if (part.key != key) return std::nullopt;
    for (const Picture& picture : part.result.pictures) {
      const std::filesystem::path name(picture.file);
      if (name.filename() != name || !std::filesystem::is_regular_file(folder / name)) return std::nullopt;
    }
    return part;
  } catch (const Json::exception&) {
    return std::nullopt;  // not of this program: computed again
  }
}

}  // namespace pharos::tools::report
