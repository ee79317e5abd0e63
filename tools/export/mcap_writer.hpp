// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace pharos::tools {

/// Writes an MCAP file (https://mcap.dev/spec, version 0): messages in uncompressed chunks with their indices, and the
/// summary with statistics, so that a reader can seek. All three checksums are written.
class McapWriter {
 public:
  /// A chunk is closed when it has so many bytes.
  static constexpr std::size_t kChunkBytes = std::size_t{1} << 20U;

  /// Does not own `stream`. `library`: the name of the writing program.
  McapWriter(std::FILE* stream, std::string_view library);
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// A JSON schema; its id, from 1.
  std::uint16_t add_schema(std::string_view name, std::string_view json_schema);
  /// A topic of JSON messages; its id, from 1. Throws InputError beyond 65535 of them.
  std::uint16_t add_channel(std::uint16_t schema, std::string_view topic);
  /// Times in ns since 1970.
  void add_message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_time_ns,
                   std::uint64_t publish_time_ns, std::string_view json);
  /// The rest of the file. Throws InputError when the stream cannot be written.
  void finish();

  std::uint64_t messages() const { return messages_; }
  const std::map<std::uint16_t, std::uint64_t>& messages_of_channels() const { return counts_; }

 private:
  struct Span {
    std::uint64_t first_ns = 0, last_ns = 0;
    bool any = false;
    void add(std::uint64_t time_ns);
  };
  void write(std::string_view bytes);
  void close_chunk();
  std::string summary();
  std::string statistics() const;

  std::FILE* stream_;
  std::uint64_t offset_ = 0;
  std::uint32_t crc_ = 0;  // of all bytes so far
  std::string chunk_;      // records of the open chunk
  Span chunk_span_, file_span_;
  std::map<std::uint16_t, std::string> chunk_index_;             // channel -> pairs of time and offset
  std::vector<std::string> schemas_, channels_, chunk_records_;  // records for the summary
  std::map<std::uint16_t, std::uint64_t> counts_;
  std::uint64_t messages_ = 0;
};

}  // namespace pharos::tools
