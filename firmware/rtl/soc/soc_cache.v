// SPDX-License-Identifier: Apache-2.0
// Memory outside the chip for the core: a cache of lines of 16 bytes, direct-mapped, before the SDRAM's controller.
//
// Instructions: a hit waits for nothing, because the line's tag is looked up with the address of the next tick. In a miss, words are given
// as they arrive, the one asked for first. Data: every read fetches its line, which then serves instructions too; a write goes to the SDRAM and
// takes its line out of the cache, so that FENCE.I has nothing to do here.
`default_nettype none

module soc_cache #(
    parameter INDEX_BITS = 7  // lines, as a power of two
) (
    input  wire        clock,
    input  wire        power_on_reset,  // of the SDRAM's controller, whose start takes 0.4 ms
    input  wire        reset,           // of the core: 16 ticks or more, in which what is on its way ends
    // Instructions, as on the core's bus; code_next and code_jumps are the core's.
    input  wire        code_read,
    input  wire [22:2] code_address,
    input  wire [22:2] code_next,
    input  wire        code_jumps,
    output wire        code_wait,
    output wire [31:0] code_data,
    // Data, as on the core's bus.
    input  wire        read,
    input  wire [ 3:0] write,
    input  wire [22:2] address,
    input  wire [31:0] write_data,
    output wire        wait_data,
    output wire [31:0] read_data,
    // The SDRAM's pins.
    output wire        sdram_ras_n,
    output wire        sdram_cas_n,
    output wire        sdram_we_n,
    output wire [ 1:0] sdram_bank,
    output wire [12:0] sdram_address,
    output wire [ 1:0] sdram_mask,
    output wire        sdram_drive,
    output wire [15:0] sdram_data_out,
    input  wire [15:0] sdram_data_in
);

  localparam TOP_OF_INDEX = 3 + INDEX_BITS;

  // Data go first: the instruction that waits for them is older than the one that is fetched.
  wire taken  /* verilator public_flat_rd */;
  wire written, reading, accessing, half_valid;
  wire [3:0] step;
  wire [22:2] line;
  wire [3:1] half_number;
  wire [15:0] half;
  wire code_misses, data_needed;
  wire for_data  /* verilator public_flat_rd */ = data_needed || write != 4'd0;
  soc_sdram sdram (
      .clock(clock),
      .reset(power_on_reset),
      .read_line(data_needed || code_misses),
      .write_word(write != 4'd0),
      .address(for_data ? address : code_address),
      .write_data(write_data),
      .write_bytes(write),
      .taken(taken),
      .written(written),
      .reading(reading),
      .accessing(accessing),
      .step(step),
      .line(line),
      .half_valid(half_valid),
      .half_number(half_number),
      .half(half),
      .ras_n(sdram_ras_n),
      .cas_n(sdram_cas_n),
      .we_n(sdram_we_n),
      .bank(sdram_bank),
      .row_column(sdram_address),
      .mask(sdram_mask),
      .drive(sdram_drive),
      .data_out(sdram_data_out),
      .data_in(sdram_data_in)
  );

  // Tags: a line's is taken away as the access begins, and set while its last half words arrive; nothing is looked up before they are there.
  wire tag_sets = reading && step == 4'd2;
  wire [22:TOP_OF_INDEX] tag;  // valid, address
  soc_cache_tags #(
      .INDEX_BITS(INDEX_BITS),
      .WIDTH(23 - TOP_OF_INDEX)
  ) tags (
      .clock(clock),
      .read_address(code_next[TOP_OF_INDEX:4]),
      .read_data(tag),
      .write(accessing && (step == 4'd12 || tag_sets)),
      .write_address(line[TOP_OF_INDEX:4]),
      .write_data({tag_sets, line[22:TOP_OF_INDEX+1]})
  );
  wire hit = !accessing && tag == {1'b1, code_address[22:TOP_OF_INDEX+1]};

  // Words as they arrive, while the fetches follow one another in the line that is read for them.
  reg following;
  reg [1:0] passed;
  wire [3:0] until_next = step + 4'd1;  // a word can be read in the tick after its upper half
  wire arrived = reading && following && {1'b0, until_next[3:1]} + {2'b0, passed} <= 4'd3;
  assign code_wait = !hit && !arrived;
  assign code_misses = code_read && !hit && !accessing;
  always @(posedge clock)
    if (taken) begin
      following <= !for_data && !code_jumps;
      passed    <= 2'd0;
    end else begin
      if (code_jumps || (code_read && arrived && &code_address[3:2])) following <= 1'b0;
      if (code_read && arrived) passed <= passed + 2'd1;
    end

  // What was read for data is there in the tick after the last step.
  reg data_asked, data_ready;
  always @(posedge clock) begin
    if (taken) data_asked <= for_data;
    data_ready <= !reset && reading && data_asked && step == 4'd1;
  end
  assign data_needed = read && !data_ready;
  assign wait_data = read ? !data_ready : !written;

  // Lower and upper half words.
  wire [TOP_OF_INDEX:2] inner_address = half_valid ? {line[TOP_OF_INDEX:4], half_number[3:2]} : address[TOP_OF_INDEX:2];
  genvar i;
  generate
    for (i = 0; i < 2; i = i + 1) begin : halves
      soc_cache_half #(
          .ADDRESS_BITS(INDEX_BITS + 2)
      ) block (
          .clock(clock),
          .read_a(code_read),
          .address_a(code_address[TOP_OF_INDEX:2]),
          .data_a(code_data[16*i+:16]),
          .read_b(read),
          .write_b(half_valid && half_number[1] == i[0]),
          .address_b(inner_address),
          .write_data_b(half),
          .data_b(read_data[16*i+:16])
      );
    end
  endgenerate

  wire unused = &{1'b0, code_next[3:2], code_next[22:TOP_OF_INDEX+1], line[3:2], until_next[0]};

endmodule
`default_nettype wire
