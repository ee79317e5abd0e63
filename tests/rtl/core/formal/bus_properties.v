// SPDX-License-Identifier: Apache-2.0
// The core on any bus, with any program: rules of its requests. The result of a multiplication does not matter here.
module core_multiplier #(
    parameter WIDTH = 16
) (
    input clock,
    input [WIDTH-1:0] a,
    input [WIDTH-1:0] b,
    output [2*WIDTH-1:0] product
);
  assign product = 0;
endmodule

module bus_properties (
    input clock,
    input ibus_wait,
    input [31:0] ibus_readdata,
    input ibus_fault,
    input dbus_wait,
    input [31:0] dbus_readdata,
    input dbus_fault,
    input timer_interrupt
);
  reg reset = 1;
  always @(posedge clock) reset <= 0;

  wire ibus_read, dbus_read, dbus_write, ends, trapped, interrupted;
  wire [31:2] ibus_address, dbus_address;
  wire [3:0] dbus_bytes;
  wire [31:0] dbus_writedata, address;
  pharos_core core (
      .clock(clock),
      .reset(reset),
      .ibus_read(ibus_read),
      .ibus_address(ibus_address),
      .ibus_wait(ibus_wait),
      .ibus_readdata(ibus_readdata),
      .ibus_fault(ibus_fault),
      .dbus_read(dbus_read),
      .dbus_write(dbus_write),
      .dbus_address(dbus_address),
      .dbus_bytes(dbus_bytes),
      .dbus_writedata(dbus_writedata),
      .dbus_wait(dbus_wait),
      .dbus_readdata(dbus_readdata),
      .dbus_fault(dbus_fault),
      .timer_interrupt(timer_interrupt),
      .trace_ends(ends),
      .trace_address(address),
      .trace_trapped(trapped),
      .trace_interrupted(interrupted)
  );

  reg before = 0;  // there was a tick without reset
  reg waited, read, write, loading;
  reg [31:2] held_address;
  reg [3:0] held_bytes;
  reg [31:0] held_data;
  always @(posedge clock) begin
    before <= !reset;
    waited <= !reset && (dbus_read || dbus_write) && dbus_wait;
    read <= dbus_read;
    write <= dbus_write;
    held_address <= dbus_address;
    held_bytes <= dbus_bytes;
    held_data <= dbus_writedata;
    loading <= !reset && dbus_read && !dbus_wait && !dbus_fault;
  end

  always @*
    if (!reset) begin
      assert (!(dbus_read && dbus_write));
      if (dbus_read || dbus_write)
        assert (dbus_bytes == 4'b1111 || dbus_bytes == 4'b1100 || dbus_bytes == 4'b0011 || (dbus_bytes != 0 && (dbus_bytes & (dbus_bytes - 1)) == 0));
      if (before && waited) begin
        // Held as it was: no access is taken twice or lost.
        assert (dbus_read == read && dbus_write == write && dbus_address == held_address && dbus_bytes == held_bytes);
        if (write) assert (dbus_writedata == held_data);
        assert (!interrupted);
      end
      // One access an instruction: a store ends with it, a load in the tick after.
      if (dbus_write && !dbus_wait) assert (ends);
      if (before && loading) assert (ends && !trapped && !interrupted && !dbus_read && !dbus_write);
      if (interrupted) assert (ends && !dbus_read && !dbus_write);
      if (trapped) assert (ends);
      assert (!(trapped && interrupted));
    end
endmodule
