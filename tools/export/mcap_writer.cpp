// SPDX-License-Identifier: Apache-2.0
#include "tools/export/mcap_writer.hpp"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>

#include "host/support/input_error.hpp"

namespace pharos::tools {
namespace {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

template <class T>
void append(std::string& out, T value) {
  for (std::size_t k = 0; k < sizeof(T); ++k) {
    out += static_cast<char>(static_cast<std::uint64_t>(value) >> 8U * k & 0xFFU);
  }
}
// A string, an array or a map: its length in bytes before it.
void append_text(std::string& out, std::string_view text) {
  append(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}
std::string record(Opcode opcode, std::string_view content) {
  std::string out;
  append(out, static_cast<std::uint8_t>(opcode));
  append(out, static_cast<std::uint64_t>(content.size()));
  return out.append(content);
}
std::uint32_t crc_of(std::string_view bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

void McapWriter::Span::add(std::uint64_t time_ns) {
  first_ns = any ? std::min(first_ns, time_ns) : time_ns;
  last_ns = any ? std::max(last_ns, time_ns) : time_ns;
  any = true;
}

McapWriter::McapWriter(std::FILE* stream, std::string_view library) : stream_(stream) {
  std::string header;
  append_text(header, "");  // no profile
  append_text(header, library);
  write(kMagic);
  write(record(kHeader, header));
}

void McapWriter::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_) != bytes.size()) {
    throw host::InputError(std::string("the output takes no more: ") + std::strerror(errno));
  }
  crc_ = crc_of(bytes, crc_);
  offset_ += bytes.size();
}

std::uint16_t McapWriter::add_schema(std::string_view name, std::string_view json_schema) {
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  std::string content;
  append(content, id);
  append_text(content, name);
  append_text(content, "jsonschema");
  append_text(content, json_schema);
  schemas_.push_back(record(kSchema, content));
  chunk_ += schemas_.back();
  return id;
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema, std::string_view topic) {
  if (channels_.size() >= std::numeric_limits<std::uint16_t>::max()) {
    throw host::InputError("more than 65535 topics: MCAP has no number for them; split the log");
  }
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  std::string content;
  append(content, id);
  append(content, schema);
  append_text(content, topic);
  append_text(content, "json");
  append_text(content, "");  // no metadata
  channels_.push_back(record(kChannel, content));
  chunk_ += channels_.back();
  return id;
}

void McapWriter::add_message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_time_ns,
                             std::uint64_t publish_time_ns, std::string_view json) {
  std::string& index = chunk_index_[channel];
  append(index, log_time_ns);
  append(index, static_cast<std::uint64_t>(chunk_.size()));
  std::string content;
  append(content, channel);
  append(content, sequence);
  append(content, log_time_ns);
  append(content, publish_time_ns);
  chunk_ += record(kMessage, content.append(json));
  chunk_span_.add(log_time_ns);
  file_span_.add(log_time_ns);
  ++counts_[channel];
  ++messages_;
  if (chunk_.size() >= kChunkBytes) close_chunk();
}

// The chunk, an index of each of its channels, and the record that finds both.
void McapWriter::close_chunk() {
  if (chunk_.empty()) return;
  std::string times;
  append(times, chunk_span_.first_ns);
  append(times, chunk_span_.last_ns);
  std::string content = times;
  append(content, static_cast<std::uint64_t>(chunk_.size()));
  append(content, crc_of(chunk_));
  append_text(content, "");  // not compressed
  append(content, static_cast<std::uint64_t>(chunk_.size()));
  content += chunk_;
  const std::uint64_t chunk_start = offset_;
  write(record(kChunk, content));
  const std::uint64_t chunk_length = offset_ - chunk_start;
  std::string places;
  const std::uint64_t indices_start = offset_;
  for (const auto& [channel, entries] : chunk_index_) {
    append(places, channel);
    append(places, offset_);
    std::string index;
    append(index, channel);
    append_text(index, entries);
    write(record(kMessageIndex, index));
  }
  std::string found = times;
  append(found, chunk_start);
  append(found, chunk_length);
  append_text(found, places);
  append(found, offset_ - indices_start);
  append_text(found, "");
  append(found, static_cast<std::uint64_t>(chunk_.size()));
  append(found, static_cast<std::uint64_t>(chunk_.size()));
  chunk_records_.push_back(record(kChunkIndex, found));
  chunk_.clear();
  chunk_index_.clear();
  chunk_span_ = {};
}

std::string McapWriter::statistics() const {
  std::string content;
  append(content, messages_);
  append(content, static_cast<std::uint16_t>(schemas_.size()));
  append(content, static_cast<std::uint32_t>(channels_.size()));
  append(content, std::uint32_t{0});  // attachments
  append(content, std::uint32_t{0});  // metadata
  append(content, static_cast<std::uint32_t>(chunk_records_.size()));
  append(content, file_span_.first_ns);
  append(content, file_span_.last_ns);
  std::string counts;
  for (const auto& [channel, count] : counts_) {
    append(counts, channel);
    append(counts, count);
  }
  append_text(content, counts);
  return record(kStatistics, content);
}

// Summary, summary offsets, and the footer up to its checksum.
std::string McapWriter::summary() {
  const std::uint64_t start = offset_;
  std::string out, offsets;
  const auto add_group = [&](Opcode opcode, const std::vector<std::string>& records) {
    if (records.empty()) return;
    std::string place;
    append(place, static_cast<std::uint8_t>(opcode));
    append(place, start + out.size());
    const std::size_t before = out.size();
    for (const std::string& one : records) out += one;
    append(place, static_cast<std::uint64_t>(out.size() - before));
    offsets += record(kSummaryOffset, place);
  };
  add_group(kSchema, schemas_);
  add_group(kChannel, channels_);
  add_group(kChunkIndex, chunk_records_);
  add_group(kStatistics, {statistics()});
  const std::uint64_t offsets_start = start + out.size();
  out += offsets;
  constexpr std::uint64_t kFooterBytes = 8 + 8 + 4;
  append(out, static_cast<std::uint8_t>(kFooter));
  append(out, kFooterBytes);
  append(out, start);
  append(out, offsets_start);
  return out;
}

void McapWriter::finish() {
  close_chunk();
  std::string data_end;
  append(data_end, crc_);
  write(record(kDataEnd, data_end));
  std::string end = summary();
  append(end, crc_of(end));
  write(end);
  write(kMagic);
  if (std::fflush(stream_) != 0) {
    throw host::InputError(std::string("the output takes no more: ") + std::strerror(errno));
  }
}

}  // namespace pharos::tools
