// SPDX-License-Identifier: Apache-2.0
// SPI master, mode 0, 8 bits, a quarter of the clock. 0 receive, 4 transmit, 8 status (bit 5 idle, bit 7 a byte was received),
// 12 control (bit 10 selects the chip).
`default_nettype none

module soc_spi (
    input  wire        clock,
    input  wire        reset,
    input  wire [ 1:0] address,
    input  wire        read,
    input  wire        write,
    input  wire [31:0] write_data,
    output reg  [31:0] read_data,
    output reg         spi_clock,
    output reg         spi_select_n,
    output wire        spi_out,
    input  wire        spi_in
);

  reg [7:0] bits;
  reg [5:0] left;  // quarters: clock rises in the third, falls after the fourth
  reg received;
  reg input_bit;
  wire busy = left != 6'd0;
  assign spi_out = bits[7];

  always @(posedge clock)
    if (reset) begin
      bits         <= 8'd0;
      left         <= 6'd0;
      received     <= 1'b0;
      input_bit    <= 1'b0;
      spi_clock    <= 1'b0;
      spi_select_n <= 1'b1;
    end else begin
      if (write && address == 2'd3) spi_select_n <= !write_data[10];
      if (write && address == 2'd1 && !busy) begin
        bits     <= write_data[7:0];
        left     <= 6'd32;
        received <= 1'b0;
      end else if (busy) begin
        left <= left - 6'd1;
        if (left[1:0] == 2'd3) spi_clock <= 1'b1;
        if (left[1:0] == 2'd2) input_bit <= spi_in;
        if (left[1:0] == 2'd1) begin
          spi_clock <= 1'b0;
          bits      <= {bits[6:0], input_bit};
        end
        if (left == 6'd1) received <= 1'b1;
      end else if (read && address == 2'd0) received <= 1'b0;
    end

  always @(posedge clock)
    case (address)
      2'd0: read_data <= {24'd0, bits};
      2'd2: read_data <= {24'd0, received, 1'b0, !busy, 5'd0};
      2'd3: read_data <= {21'd0, !spi_select_n, 10'd0};
      default: read_data <= 32'd0;
    endcase

  wire unused = &{1'b0, write_data[31:11], write_data[9:8]};

endmodule
`default_nettype wire
