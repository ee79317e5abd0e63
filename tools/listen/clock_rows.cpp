// SPDX-License-Identifier: Apache-2.0
#include "tools/listen/clock_rows.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/support/printable.hpp"
#include "pharos/clock_exchange_t.hpp"
#include "tools/listen/pose_rows.hpp"

namespace pharos::tools {

std::string clock_line(const clock_exchange_t& exchange) {
  if (exchange.is_answer == 0) {
    return host::printable(
        fmt::format("{} asks {} for its clock, question {}", exchange.sender, exchange.recipient, exchange.sequence));
  }
  constexpr std::int64_t kNsPerUs = 1000;
  return host::printable(fmt::format("{} {} answers {}, question {}", clock_text(exchange.answered_ns / kNsPerUs),
                                     exchange.sender, exchange.recipient, exchange.sequence));
}

std::string clock_json(const clock_exchange_t& exchange) {
  nlohmann::ordered_json out = {{"sender", exchange.sender},
                                {"recipient", exchange.recipient},
                                {"session", exchange.session},
                                {"sequence", exchange.sequence},
                                {"is_answer", exchange.is_answer != 0}};
  const bool answer = exchange.is_answer != 0;
  const auto add = [&](const char* name, std::int64_t value) {
    out[name] = answer ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  };
  add("asked_session", exchange.asked_session);
  add("received_ns", exchange.received_ns);
  add("answered_ns", exchange.answered_ns);
  return out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace pharos::tools
