// SPDX-License-Identifier: Apache-2.0
// The four single-port RAM blocks as 128 KiB in two banks of 64: instructions (A) and data (B) go on at once in different
// banks; in the same one data go first. What was read is there in the tick after the request.
`default_nettype none

module up5k_ram (
    input  wire        clock,
    input  wire        read_a,
    input  wire [14:0] address_a,
    output wire        wait_a,
    output wire [31:0] data_a,
    input  wire        read_b,
    input  wire [ 3:0] write_b,
    input  wire [14:0] address_b,
    input  wire [31:0] write_data_b,
    output wire [31:0] data_b
);

  wire accesses_b = read_b || write_b != 4'd0;
  assign wait_a = read_a && accesses_b && address_a[14] == address_b[14];

  wire [31:0] data_0, data_1;
  wire [63:0] banks;
  assign {data_1, data_0} = banks;
  genvar k, h;
  generate
    for (k = 0; k < 2; k = k + 1) begin : bank
      wire for_b = accesses_b && address_b[14] != (k == 0);
      for (h = 0; h < 2; h = h + 1) begin : half
        SB_SPRAM256KA block (
            .ADDRESS(for_b ? address_b[13:0] : address_a[13:0]),
            .DATAIN(write_data_b[16*h+:16]),
            .MASKWREN({{2{write_b[2*h+1]}}, {2{write_b[2*h]}}}),
            .WREN(for_b && !read_b),
            .CHIPSELECT(for_b || read_a),
            .CLOCK(clock),
            .STANDBY(1'b0),
            .SLEEP(1'b0),
            .POWEROFF(1'b1),
            .DATAOUT(banks[32*k+16*h+:16])
        );
      end
    end
  endgenerate

  reg bank_a, bank_b;
  always @(posedge clock) begin
    bank_a <= address_a[14];
    bank_b <= address_b[14];
  end
  assign data_a = bank_a ? data_1 : data_0;
  assign data_b = bank_b ? data_1 : data_0;

endmodule
`default_nettype wire
