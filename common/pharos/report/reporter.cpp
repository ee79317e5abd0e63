// SPDX-License-Identifier: Apache-2.0
#include "pharos/report/reporter.hpp"

#include "pharos/report/convert.hpp"

namespace pharos::report {

Reporter::Bytes Reporter::refuse() {
  ++refused_;
  return {};
}

Reporter::Bytes Reporter::frame(wire::MessageType type, Bytes payload) {
  const std::size_t size = encoder_.encode(type, payload, line_);
  if (size == 0) return refuse();
  ++frames_;
  return std::span(line_).first(size);
}

Reporter::Bytes Reporter::report(const lighthouse::Sweep& sweep) { return send(SweepInPlace{sweep}); }
Reporter::Bytes Reporter::report(const lighthouse::OotxPayload& payload) { return send(to_wire(payload)); }
Reporter::Bytes Reporter::report(const lighthouse::Lh2Sweep& sweep) { return send(to_wire(sweep)); }
Reporter::Bytes Reporter::report(const Lh2OotxReport& payload) { return send(to_wire(payload)); }
Reporter::Bytes Reporter::report(const PoseReport& pose) { return send(to_wire(pose)); }
Reporter::Bytes Reporter::report(const DecoderReport& counters) { return send(to_wire(counters)); }
Reporter::Bytes Reporter::report(const DeviceReport& counters) { return send(to_wire(counters)); }

Reporter::Bytes Reporter::report(const lighthouse::Edge& edge, std::uint32_t edges_lost) {
  if (hold(edge, edges_lost)) return {};
  const Bytes full = flush_edges();
  hold(edge, edges_lost);
  return full;
}

bool Reporter::hold(const lighthouse::Edge& edge, std::uint32_t edges_lost) {
  const wire::RawEdge raw = to_wire(edge);
  if (raw.sensor >= kMaxSensors || !wire::is_plausible_time(raw.stamp_ticks)) {
    ++refused_;
    return true;
  }
  if (!edges_.push(raw)) return false;
  edges_lost_ = edges_lost;
  return true;
}

Reporter::Bytes Reporter::flush_edges() {
  if (edges_.empty()) return {};
  const Bytes bytes = frame(wire::MessageType::kRawEdges, edges_.payload(edges_lost_));
  edges_.clear();
  return bytes;
}

}  // namespace pharos::report
