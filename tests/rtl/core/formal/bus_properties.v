// SPDX-License-Identifier: Apache-2.0
// The core's buses, whatever words, waits, faults and interrupts it is given: a request to the data bus that waits is held unchanged; never a
// read and a write at once; a fetch that waits keeps its address unless there is a jump, and ibus_next tells the next tick's address.
`default_nettype none

module bus_properties (
    input wire        clock,
    input wire        reset,
    input wire        ibus_wait,
    input wire [31:0] ibus_readdata,
    input wire        ibus_fault,
    input wire        dbus_wait,
    input wire [31:0] dbus_readdata,
    input wire        dbus_fault,
    input wire        timer_interrupt
);

  wire ibus_read, ibus_jumps, dbus_read, dbus_write;
  wire [31:2] ibus_address, ibus_next, dbus_address;
  wire [3:0] dbus_bytes;
  wire [31:0] dbus_writedata;
  pharos_core core (
      .clock(clock), .reset(reset), .ibus_read(ibus_read), .ibus_address(ibus_address), .ibus_next(ibus_next), .ibus_jumps(ibus_jumps),
      .ibus_wait(ibus_wait), .ibus_readdata(ibus_readdata), .ibus_fault(ibus_fault), .dbus_read(dbus_read), .dbus_write(dbus_write),
      .dbus_address(dbus_address), .dbus_bytes(dbus_bytes), .dbus_writedata(dbus_writedata), .dbus_wait(dbus_wait),
      .dbus_readdata(dbus_readdata), .dbus_fault(dbus_fault), .timer_interrupt(timer_interrupt));

  reg running = 0;
  always @(posedge clock) running <= 1;
  always @* assume (reset == !running);

  reg waited = 0;
  reg was_read, was_write;
  reg [31:2] was_address;
  reg [3:0] were_bytes;
  reg [31:0] was_data;
  reg fetch_told = 0;
  reg fetch_waited, jumped;
  reg [31:2] told_address, was_fetch;
  always @(posedge clock) begin
    waited       <= running && (dbus_read || dbus_write) && dbus_wait;
    was_read     <= dbus_read;
    was_write    <= dbus_write;
    was_address  <= dbus_address;
    were_bytes   <= dbus_bytes;
    was_data     <= dbus_writedata;
    fetch_told   <= running;
    told_address <= ibus_next;
    fetch_waited <= !ibus_read || ibus_wait;
    jumped       <= ibus_jumps;
    was_fetch    <= ibus_address;
  end

  always @*
    if (running) begin
      assert (!(dbus_read && dbus_write));
      if (waited) begin
        assert (dbus_read == was_read && dbus_write == was_write && dbus_address == was_address);
        assert (dbus_bytes == were_bytes);
        if (dbus_write) assert (dbus_writedata == was_data);
      end
      if (fetch_told) begin
        assert (ibus_address == told_address);
        if (!jumped) assert (ibus_address == was_fetch + {29'd0, !fetch_waited});
      end
    end
endmodule
`default_nettype wire
