// SPDX-License-Identifier: Apache-2.0
// The registers in block RAM: two copies, one a read port. A read that coincides with a write of the same register
// returns anything: pharos_core.v bypasses it.
`default_nettype none

module core_registers (
    input  wire        clock,
    input  wire        read,
    input  wire [ 4:0] number_1,
    input  wire [ 4:0] number_2,
    output reg  [31:0] value_1,
    output reg  [31:0] value_2,
    input  wire        write,
    input  wire [ 4:0] write_number,
    input  wire [31:0] write_value
);

  (* ramstyle = "M9K, no_rw_check" *)
  reg [31:0] copy_1[0:31]  /* verilator public_flat_rw */;
  (* ramstyle = "M9K, no_rw_check" *)
  reg [31:0] copy_2[0:31]  /* verilator public_flat_rw */;

  always @(posedge clock) begin
    if (write) copy_1[write_number] <= write_value;
    if (read) value_1 <= copy_1[number_1];
  end
  always @(posedge clock) begin
    if (write) copy_2[write_number] <= write_value;
    if (read) value_2 <= copy_2[number_2];
  end

endmodule
`default_nettype wire
