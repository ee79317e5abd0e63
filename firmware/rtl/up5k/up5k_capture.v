// SPDX-License-Identifier: Apache-2.0
// The capture block on two clocks: inputs and stamps at 48 MHz, registers and FIFO on the core's. Registers as those of
// pharos_capture, without the filter; TIME_LOW waits until every edge before it can be read.
`default_nettype none

module up5k_capture #(
    parameter INPUTS = 4,
    parameter DEPTH = 512
) (
    input  wire              capture_clock,
    input  wire              clock,
    input  wire              reset,
    input  wire [INPUTS-1:0] pins,
    input  wire [       3:0] bus_address,
    input  wire              bus_read,
    input  wire              bus_write,
    input  wire [      31:0] bus_writedata,
    output wire              bus_wait,
    output wire [      31:0] bus_readdata
);

  localparam CROSSING_BITS = 4;

  reg reset_sampled, capture_reset;
  always @(posedge capture_clock) begin
    reset_sampled <= reset;
    capture_reset <= reset_sampled;
  end

  wire write, full, empty, valid;
  wire [32+2*INPUTS-1:0] record, crossed;
  wire [INPUTS-1:0] capture_levels;
  reg time_wanted;
  wire time_shown;
  wire [63:0] time_ticks;
  capture_front #(
      .INPUTS(INPUTS)
  ) front (
      .clock(capture_clock),
      .reset(capture_reset),
      .pins(pins),
      .write(write),
      .record(record),
      .full(full),
      .levels(capture_levels),
      .time_wanted(time_wanted),
      .time_shown(time_shown),
      .time_ticks(time_ticks)
  );
  crossing_fifo #(
      .WIDTH(32 + 2 * INPUTS),
      .ADDRESS_WIDTH(CROSSING_BITS)
  ) crossing (
      .write_clock(capture_clock),
      .write_reset(capture_reset),
      .write(write),
      .write_data(record),
      .full(full),
      .read_clock(clock),
      .read_reset(reset),
      .empty(empty),
      .valid(valid),
      .read_data(crossed)
  );

  // TIME_LOW: asks for the time, then waits until the FIFO was empty or all that it can hold has been taken.
  wire at_time;
  wire wants_time = bus_read && at_time;
  reg time_pending, time_ready;
  reg shown_sampled, shown_settled;
  reg [CROSSING_BITS:0] time_left;
  assign bus_wait = wants_time && !time_ready;
  wire arrived = time_pending && shown_settled == time_wanted;
  always @(posedge clock)
    if (reset) begin
      time_wanted   <= 1'b0;
      time_pending  <= 1'b0;
      time_ready    <= 1'b0;
      shown_sampled <= 1'b0;
      shown_settled <= 1'b0;
      time_left     <= 0;
    end else begin
      shown_sampled <= time_shown;
      shown_settled <= shown_sampled;
      if (bus_wait && !time_pending) begin
        time_wanted  <= !time_wanted;
        time_pending <= 1'b1;
        time_left    <= {1'b1, {CROSSING_BITS{1'b0}}};
      end else if (arrived) begin
        time_left <= time_left - 1'b1;
        if (empty || time_left == 0) begin
          time_pending <= 1'b0;
          time_ready   <= 1'b1;
        end
      end else if (wants_time) time_ready <= 1'b0;
    end

  reg [INPUTS-1:0] levels_sampled, levels_settled;
  always @(posedge clock) begin
    levels_sampled <= capture_levels;
    levels_settled <= levels_sampled;
  end

  wire [31:0] stamp = crossed[2*INPUTS+:32];
  wire [INPUTS-1:0] changed = crossed[INPUTS+:INPUTS];
  wire [INPUTS-1:0] watched;
  wire filter, interrupt;
  wire tells_losses = valid && changed == 0 && watched != 0;
  capture_queue #(
      .INPUTS(INPUTS),
      .DEPTH(DEPTH),
      .FILTER_WIDTH(0),
      .LOST_WIDTH(32)
  ) queue (
      .clock(clock),
      .reset(reset),
      .stamp(stamp),
      .changed(changed & watched & {INPUTS{valid}}),
      .levels(crossed[0+:INPUTS]),
      .lost_before(stamp & {32{tells_losses}}),
      .levels_now(levels_settled),
      .glitch(1'b0),
      .now(time_ticks),
      .watched(watched),
      .filter(filter),
      .at_time(at_time),
      .bus_address(bus_address),
      .bus_read(bus_read && !bus_wait),
      .bus_write(bus_write),
      .bus_writedata(bus_writedata),
      .bus_readdata(bus_readdata),
      .bus_irq(interrupt)
  );

  wire unused = &{1'b0, filter, interrupt};

endmodule
`default_nettype wire
