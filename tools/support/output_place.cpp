// SPDX-License-Identifier: Apache-2.0
#include "tools/support/output_place.hpp"

#include "host/files/same_file.hpp"
#include "host/support/input_error.hpp"

namespace pharos::tools {
namespace {

bool is_output(const CLI::Option& option) {
  try {
    static_cast<void>(const_cast<CLI::Option&>(option).get_validator(kOutputPlace));
    return true;
  } catch (const CLI::OptionNotFound&) {
    return false;
  }
}

// A number or one of several words is no file, even if there is one of that name.
bool may_be_a_path(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.rfind("TEXT", 0) == 0 && type.find(":{") == std::string::npos;
}

}  // namespace

void refuse_output_onto_input(const CLI::App& command) {
  for (const CLI::Option* output : command.get_options()) {
    if (!is_output(*output)) continue;
    for (const CLI::Option* other : command.get_options()) {
      if (other == output || !may_be_a_path(*other)) continue;
      for (const std::string& place : output->results()) {
        for (const std::string& path : other->results()) {
          if (!host::same_file(place, path)) continue;
          throw host::InputError(output->get_name() + " " + place + ": is the same file or folder as " +
                                 other->get_name() + " " + path + ", which would be lost; give another");
        }
      }
    }
  }
}

}  // namespace pharos::tools
