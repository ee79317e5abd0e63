# SPDX-License-Identifier: Apache-2.0
"""Reads an MCAP file as https://mcap.dev/spec describes it, and shares nothing with the writer.

Checks the magic, the records' order, all checksums, indices, summary, offsets and statistics, and every message against
its JSON schema. Prints one JSON object a message: topic, schema, sequence, log_time, publish_time, data.
"""
import json
import struct
import sys
import zlib

MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX = range(1, 9)
STATISTICS, SUMMARY_OFFSET, DATA_END = 0x0B, 0x0E, 0x0F


class Fields:
    def __init__(self, content):
        self.content, self.at = content, 0

    def take(self, count):
        assert self.at + count <= len(self.content), "a record ends before its fields"
        self.at += count
        return self.content[self.at - count:self.at]

    def number(self, form):
        return struct.unpack("<" + form, self.take(struct.calcsize("<" + form)))[0]

    def bytes(self, form="I"):
        return self.take(self.number(form))

    def text(self):
        return self.bytes().decode("utf-8")

    def pairs(self, forms):
        part = Fields(self.bytes())
        out = []
        while part.at < len(part.content):
            out.append(tuple(part.number(form) for form in forms))
        return out

    def rest(self):
        return self.take(len(self.content) - self.at)


def records(data, begin, end):
    """(opcode, content, place) of the records in a part of the file."""
    while begin < end:
        assert begin + 9 <= end, "a record is cut off"
        opcode, length = struct.unpack_from("<BQ", data, begin)
        assert begin + 9 + length <= end, "a record is longer than its part of the file"
        yield opcode, data[begin + 9:begin + 9 + length], begin
        begin += 9 + length


def fits(value, schema, where="message"):
    kinds = {"object": dict, "array": list, "string": str, "number": (int, float), "integer": int, "boolean": bool}
    kind = schema["type"]
    assert isinstance(value, kinds[kind]), f"{where} is no {kind}"
    assert kind == "boolean" or not isinstance(value, bool), f"{where} is a boolean"
    if kind == "object":
        properties = schema.get("properties", {})
        for name in schema.get("required", []):
            assert name in value, f"{where}.{name} is missing"
        for name, inner in value.items():
            further = schema.get("additionalProperties", True)
            assert name in properties or further is not False, f"{where}.{name} is not in the schema"
            form = properties.get(name, further)
            if form is not True:
                fits(inner, form, f"{where}.{name}")
    if kind == "array":
        assert schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)), f"{where}: its length"
        for inner in value:
            fits(inner, schema["items"], where + "[]")


class File:
    def __init__(self, data):
        self.data = data
        self.schemas, self.channels, self.messages = {}, {}, []
        self.chunks, self.parsed = {}, {}

    def schema(self, content):
        f = Fields(content)
        number, name, encoding, text = f.number("H"), f.text(), f.text(), f.bytes()
        assert number != 0 and encoding == "jsonschema" and json.loads(text)["type"] == "object"
        assert self.schemas.setdefault(number, (name, text)) == (name, text), "two schemas of one number"
        return number

    def channel(self, content):
        f = Fields(content)
        number, schema, topic, encoding = f.number("H"), f.number("H"), f.text(), f.text()
        assert schema in self.schemas, "a channel before its schema"
        assert encoding == "json"
        f.pairs("II")
        assert self.channels.setdefault(number, (schema, topic)) == (schema, topic), "two channels of one number"
        return number

    def message(self, content):
        f = Fields(content)
        channel, sequence, log_time, publish_time = f.number("H"), f.number("I"), f.number("Q"), f.number("Q")
        assert channel in self.channels, "a message before its channel"
        value = json.loads(f.rest(), parse_constant=lambda word: sys.exit("not a number of JSON: " + word))
        schema, topic = self.channels[channel]
        name, text = self.schemas[schema]
        if schema not in self.parsed:
            self.parsed[schema] = json.loads(text)
        fits(value, self.parsed[schema])
        self.messages.append({"topic": topic, "schema": name, "sequence": sequence, "log_time": log_time,
                              "publish_time": publish_time, "channel": channel, "data": value})
        return channel, log_time

    def chunk(self, content, place):
        f = Fields(content)
        first, last, size, crc, compression = f.number("Q"), f.number("Q"), f.number("Q"), f.number("I"), f.text()
        inner = f.bytes("Q")
        assert compression == "" and size == len(inner) and crc == zlib.crc32(inner), "the chunk's checksum"
        index = {}
        for opcode, part, at in records(inner, 0, len(inner)):
            if opcode == MESSAGE:
                channel, time = self.message(part)
                index.setdefault(channel, []).append((time, at))
            else:
                {SCHEMA: self.schema, CHANNEL: self.channel}[opcode](part)
        times = [time for entries in index.values() for time, _ in entries]
        assert (first, last) == ((min(times), max(times)) if times else (0, 0)), "the chunk's times"
        self.chunks[place] = (first, last, 9 + len(content), size, index, {})
        self.open_chunk = place

    def message_index(self, content, place):
        f = Fields(content)
        channel = f.number("H")
        first, last, length, size, index, places = self.chunks[self.open_chunk]
        assert f.pairs("QQ") == index[channel], "the message index"
        places[channel] = (place, 9 + len(content))

    def data_section(self):
        assert self.data.startswith(MAGIC) and self.data.endswith(MAGIC), "the magic"
        end = len(self.data) - len(MAGIC)
        for opcode, content, place in records(self.data, len(MAGIC), end):
            assert (opcode == HEADER) == (place == len(MAGIC)), "the header is first"
            if opcode == HEADER:
                f = Fields(content)
                assert f.text() == "" and f.text().startswith("pharos ")
            elif opcode == CHUNK:
                self.chunk(content, place)
            elif opcode == MESSAGE_INDEX:
                self.message_index(content, place)
            else:
                assert opcode == DATA_END, "what may stand between chunks"
                assert Fields(content).number("I") == zlib.crc32(self.data[:place]), "the data's checksum"
                return place + 9 + len(content)

    def chunk_index(self, content):
        f = Fields(content)
        first, last, place, length = (f.number("Q") for _ in range(4))
        offsets, indices_length = dict(f.pairs("HQ")), f.number("Q")
        assert f.text() == ""
        compressed, size = f.number("Q"), f.number("Q")
        known = self.chunks[place]
        assert (first, last, length, size) == known[:4] and compressed == size, "the chunk index"
        assert offsets == {channel: at for channel, (at, _) in known[5].items()}
        assert set(offsets) == set(known[4]) and indices_length == sum(n for _, n in known[5].values())

    def statistics(self, content):
        f = Fields(content)
        assert f.number("Q") == len(self.messages)
        assert (f.number("H"), f.number("I"), f.number("I"), f.number("I"), f.number("I")) == (
            len(self.schemas), len(self.channels), 0, 0, len(self.chunks)), "the statistics"
        times = [message["log_time"] for message in self.messages] or [0]
        assert (f.number("Q"), f.number("Q")) == (min(times), max(times))
        counts = {}
        for message in self.messages:
            counts[message["channel"]] = counts.get(message["channel"], 0) + 1
        assert dict(f.pairs("HQ")) == counts

    def summary(self, begin):
        footer = len(self.data) - len(MAGIC) - 29
        opcode, length = struct.unpack_from("<BQ", self.data, footer)
        assert opcode == FOOTER and length == 20
        start, offsets, crc = struct.unpack_from("<QQI", self.data, footer + 9)
        assert start == begin and crc == zlib.crc32(self.data[start:footer + 25]), "the summary's checksum"
        last_opcode = None
        groups, seen = {}, {SCHEMA: set(), CHANNEL: set(), CHUNK_INDEX: 0, STATISTICS: 0}
        for opcode, content, place in records(self.data, start, offsets):
            assert opcode == last_opcode or opcode not in groups, "grouped by opcode"
            last_opcode = opcode
            begin_of_group, _ = groups.get(opcode, (place, place))
            groups[opcode] = (begin_of_group, place + 9 + len(content))
            if opcode == SCHEMA:
                seen[SCHEMA].add(self.schema(content))
            elif opcode == CHANNEL:
                seen[CHANNEL].add(self.channel(content))
            elif opcode == CHUNK_INDEX:
                self.chunk_index(content)
                seen[CHUNK_INDEX] += 1
            else:
                assert opcode == STATISTICS
                self.statistics(content)
                seen[STATISTICS] += 1
        assert seen == {SCHEMA: set(self.schemas), CHANNEL: set(self.channels), CHUNK_INDEX: len(self.chunks),
                        STATISTICS: 1}, "what the summary repeats"
        found = {}
        for opcode, content, _ in records(self.data, offsets, footer):
            assert opcode == SUMMARY_OFFSET
            f = Fields(content)
            group, at = f.number("B"), f.number("Q")
            found[group] = (at, at + f.number("Q"))
        assert found == groups, "the summary offsets"


def main():
    with open(sys.argv[1], "rb") as file:
        mcap = File(file.read())
    mcap.summary(mcap.data_section())
    for message in mcap.messages:
        del message["channel"]
        print(json.dumps(message))


main()
