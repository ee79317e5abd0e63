// SPDX-License-Identifier: Apache-2.0
// Prints the messages of an MCAP file, found through its index, as read_mcap.py does.
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { readFileSync } from "node:fs";

const data = readFileSync(process.argv[2]);
const readable = {
  size: async () => BigInt(data.length),
  read: async (offset, size) => new Uint8Array(data.subarray(Number(offset), Number(offset + size))),
};
const reader = await McapIndexedReader.Initialize({ readable });
const lines = [];
for await (const message of reader.readMessages()) {
  const channel = reader.channelsById.get(message.channelId);
  const head = JSON.stringify({
    topic: channel.topic,
    schema: reader.schemasById.get(channel.schemaId).name,
    sequence: message.sequence,
  });
  // Nanoseconds are beyond a double's integers.
  lines.push(
    head.slice(0, -1) +
      `,"log_time":${message.logTime},"publish_time":${message.publishTime},"data":` +
      new TextDecoder().decode(message.data) +
      "}",
  );
}
// The stream reader checks what the index does not need: the checksums of chunks and of the data section.
const stream = new McapStreamReader({ validateCrcs: true });
stream.append(new Uint8Array(data));
let messages = 0;
for (let record = stream.nextRecord(); record != undefined; record = stream.nextRecord()) {
  if (record.type === "Message") ++messages;
}
if (!stream.done() || messages !== lines.length) throw new Error("the stream has other messages than the index");
console.log(lines.join("\n"));
