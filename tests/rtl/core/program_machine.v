// SPDX-License-Identifier: Apache-2.0
// What QEMU's machine `virt` has of use to a test program, around the core: 64 MiB of RAM without waits, UART, timer, the
// register that ends it. It is in Verilog so that one evaluation simulates a tick: with memory outside, Verilator
// evaluates the core's combinational paths for each answer of the memory again.
`default_nettype none

module program_machine (
    input  wire        clock,
    input  wire        reset,
    // For one tick: a byte was sent, or the program ended.
    output reg         told,
    output reg         ended,
    output reg  [31:0] told_word,  // the byte, or what was written to end it
    output reg  [63:0] cycles,  // since reset
    output reg  [63:0] instructions
);

  localparam [31:26] RAM = 6'h20;  // 0x80000000
  localparam [31:3] UART = 29'h02000000;  // 0x10000000
  localparam [31:2] END = 30'h00040000;  // 0x00100000
  localparam [31:3] TIMER_COMPARE = 29'h00400800;  // 0x02004000
  localparam [31:3] TIMER = 29'h004017FF;  // 0x0200BFF8
  localparam [31:0] TRANSMITTER_IDLE = 32'h00006000;  // line status, the second byte of the second word
  localparam [2:0] LAST_OF_STEP = 3'd4;  // 50 MHz, and 10 MHz of the timer

  wire ibus_read, dbus_read, dbus_write;
  wire [31:2] ibus_address, dbus_address;
  wire [3:0] dbus_bytes;
  wire [31:0] dbus_writedata;
  wire trace_ends;

  reg [31:0] ram[0:16777215];
  reg [31:0] fetched, loaded;
  reg fetch_fault;
  reg [63:0] timer, compare;
  reg [2:0] step;

  wire d_ram = dbus_address[31:26] == RAM;
  wire d_uart = dbus_address[31:3] == UART;
  wire d_end = dbus_address == END;
  wire d_compare = dbus_address[31:3] == TIMER_COMPARE;
  wire d_timer = dbus_address[31:3] == TIMER;
  wire upper = dbus_address[2];
  wire [31:0] lanes = {{8{dbus_bytes[3]}}, {8{dbus_bytes[2]}}, {8{dbus_bytes[1]}}, {8{dbus_bytes[0]}}};

  always @(posedge clock) begin
    if (ibus_read) begin
      fetch_fault <= ibus_address[31:26] != RAM;
      fetched <= ibus_address[31:26] == RAM ? ram[ibus_address[25:2]] : 32'd0;
    end
    if (dbus_read)
      loaded <= d_ram ? ram[dbus_address[25:2]] :
          d_uart && upper ? TRANSMITTER_IDLE :
          d_timer ? (upper ? timer[63:32] : timer[31:0]) :
          d_compare ? (upper ? compare[63:32] : compare[31:0]) : 32'd0;
    if (dbus_write && d_ram) ram[dbus_address[25:2]] <= dbus_writedata & lanes | ram[dbus_address[25:2]] & ~lanes;
  end

  always @(posedge clock) begin
    told <= !reset && dbus_write && (d_end || d_uart && !upper && dbus_bytes[0]);
    ended <= !reset && dbus_write && d_end;
    told_word <= dbus_writedata;
    if (reset) begin
      cycles <= 64'd0;
      instructions <= 64'd0;
      timer <= 64'd0;
      step <= 3'd0;
      compare <= ~64'd0;
    end else begin
      cycles <= cycles + 64'd1;
      if (trace_ends) instructions <= instructions + 64'd1;
      step <= step == LAST_OF_STEP ? 3'd0 : step + 3'd1;
      if (step == LAST_OF_STEP) timer <= timer + 64'd1;
      if (dbus_write && d_compare && upper) compare[63:32] <= dbus_writedata;
      if (dbus_write && d_compare && !upper) compare[31:0] <= dbus_writedata;
    end
  end

  /* verilator lint_off PINCONNECTEMPTY */
  pharos_core core (
      .clock(clock),
      .reset(reset),
      .ibus_read(ibus_read),
      .ibus_address(ibus_address),
      .ibus_next(),
      .ibus_jumps(),
      .ibus_wait(1'b0),
      .ibus_readdata(fetched),
      .ibus_fault(fetch_fault),
      .dbus_read(dbus_read),
      .dbus_write(dbus_write),
      .dbus_address(dbus_address),
      .dbus_bytes(dbus_bytes),
      .dbus_writedata(dbus_writedata),
      .dbus_wait(1'b0),
      .dbus_readdata(loaded),
      .dbus_fault(!(d_ram || d_uart || d_end || d_compare || d_timer)),
      .timer_interrupt(timer >= compare),
      .cycle(),
      .trace_ends(trace_ends),
      .trace_address(),
      .trace_trapped(),
      .trace_interrupted()
  );
  /* verilator lint_on PINCONNECTEMPTY */

endmodule

`default_nettype wire
