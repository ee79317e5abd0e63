// SPDX-License-Identifier: Apache-2.0
// The bus of the chip, for every request of the core and every state of the devices: a request reaches the device of its address and no
// other, what no device has is refused, writes to the ROM too; what is read is of the device that was asked. The core is any that
// keeps bus_properties.v. The properties are in soc_bus_properties.vh, which is read inside pharos_soc (prove_bus.sh).
`default_nettype none

module pharos_core #(
    parameter ADDRESS_TICK = 0
) (
    input  wire        clock,
    input  wire        reset,
    output wire        ibus_read,
    output wire [31:2] ibus_address,
    output wire [31:2] ibus_next,
    output wire        ibus_jumps,
    input  wire        ibus_wait,
    input  wire [31:0] ibus_readdata,
    input  wire        ibus_fault,
    output wire        dbus_read,
    output wire        dbus_write,
    output wire [31:2] dbus_address,
    output wire [ 3:0] dbus_bytes,
    output wire [31:0] dbus_writedata,
    input  wire        dbus_wait,
    input  wire [31:0] dbus_readdata,
    input  wire        dbus_fault,
    input  wire        timer_interrupt,
    output wire [63:0] cycle,
    output wire        trace_ends,
    output wire [31:0] trace_address,
    output wire        trace_trapped,
    output wire        trace_interrupted
);
  (* anyseq *) reg [195:0] any;
  assign {ibus_read, ibus_address, ibus_next, ibus_jumps, dbus_read, dbus_write, dbus_address, dbus_bytes, dbus_writedata, cycle} = any;
  assign {trace_ends, trace_address, trace_trapped, trace_interrupted} = 35'd0;
  always @* assume (!(dbus_read && dbus_write));
endmodule
`default_nettype wire
