// SPDX-License-Identifier: Apache-2.0
// UART, 8N1, with the registers of a 16550 that the firmware uses, and FIFOs of 128 bytes. The divisor is the length of a
// bit in 1/16 ticks of the clock:
// 115,200 and 460,800 baud are met to 0.1 % by any clock from 16 MHz on.
//
//   0 data (with DLAB: divisor, low)   1 interrupt enable: ignored (with DLAB: divisor, high)   2 FIFO control: ignored
//   3 line control: DLAB in bit 7      5 line status, reading clears the errors
`default_nettype none

module soc_uart (
    input  wire        clock,
    input  wire        reset,
    input  wire [ 2:0] address,
    input  wire        read,
    input  wire        write,
    input  wire [ 7:0] write_data,
    output reg  [ 7:0] read_data,
    input  wire        receive,   // pin
    output wire        transmit   // pin
);

  reg divisor_access;
  reg [15:0] divisor;
  wire write_byte = write && address == 3'd0 && !divisor_access;
  wire read_byte = read && address == 3'd0 && !divisor_access;
  wire read_status = read && address == 3'd5;
  always @(posedge clock)
    if (reset) begin
      divisor_access <= 1'b0;
      divisor        <= 16'hFFFF;
    end else if (write) begin
      if (address == 3'd3) divisor_access <= write_data[7];
      if (address == 3'd0 && divisor_access) divisor[7:0] <= write_data;
      if (address == 3'd1 && divisor_access) divisor[15:8] <= write_data;
    end

  // Transmission: a bit ends when what is left of it is less than a tick.
  wire [7:0] send_byte;
  wire [7:0] send_count;
  wire send_full;
  wire send_next;
  reg [9:0] send_bits;  // stop bit, byte, start bit, from bit 0 on
  reg [3:0] send_left;
  reg [16:0] send_time;
  reg sending;
  reg queued;  // a byte that the FIFO does not count yet
  wire send_bit_ends = send_time < 17'd32;
  assign send_next = !sending && send_count != 8'd0;
  assign transmit = !sending || send_bits[0];
  capture_fifo #(
      .WIDTH(8),
      .DEPTH(128)
  ) send_fifo (
      .clock(clock),
      .clear(reset),
      .write(write_byte),
      .write_data(write_data),
      .full(send_full),
      .pop(send_next),
      .head(send_byte),
      .count(send_count)
  );
  always @(posedge clock)
    if (reset) begin
      sending   <= 1'b0;
      send_bits <= 10'h3FF;
      send_left <= 4'd0;
      send_time <= 17'd0;
      queued    <= 1'b0;
    end else begin
      queued <= write_byte;
      if (send_next) begin
        sending   <= 1'b1;
        send_bits <= {1'b1, send_byte, 1'b0};
        send_left <= 4'd9;
        send_time <= {1'b0, divisor};
      end else if (sending) begin
        if (!send_bit_ends) send_time <= send_time - 17'd16;
        else if (send_left == 4'd0) sending <= 1'b0;
        else begin
          send_time <= send_time - 17'd16 + {1'b0, divisor};
          send_bits <= {1'b1, send_bits[9:1]};
          send_left <= send_left - 4'd1;
        end
      end
    end

  // Reception: each bit is sampled in its middle.
  reg [2:0] line;  // synchroniser
  reg receiving;
  reg [3:0] receive_left;
  reg [16:0] receive_time;
  reg [7:0] received;
  reg overrun;
  reg framing;
  wire sample = receiving && receive_time < 17'd32;
  wire stop = sample && receive_left == 4'd0;
  wire [7:0] receive_byte;
  wire [7:0] receive_count;
  wire receive_full;
  always @(posedge clock) line <= {line[1:0], receive};
  capture_fifo #(
      .WIDTH(8),
      .DEPTH(128)
  ) receive_fifo (
      .clock(clock),
      .clear(reset),
      .write(stop && line[1]),
      .write_data(received),
      .full(receive_full),
      .pop(read_byte),
      .head(receive_byte),
      .count(receive_count)
  );
  always @(posedge clock)
    if (reset) begin
      receiving    <= 1'b0;
      receive_left <= 4'd0;
      receive_time <= 17'd0;
      received     <= 8'd0;
      overrun      <= 1'b0;
      framing      <= 1'b0;
    end else begin
      if (!receiving) begin
        receiving    <= line[2] && !line[1];
        receive_left <= 4'd9;
        receive_time <= {2'd0, divisor[15:1]};
      end else if (!sample) receive_time <= receive_time - 17'd16;
      else begin
        receive_time <= receive_time - 17'd16 + {1'b0, divisor};
        receive_left <= receive_left - 4'd1;
        if (receive_left == 4'd0 || (receive_left == 4'd9 && line[1])) receiving <= 1'b0;  // its end, or no start bit
        received <= {line[1], received[7:1]};
      end
      if (stop && line[1] && receive_full) overrun <= 1'b1;
      else if (read_status) overrun <= 1'b0;
      if (stop && !line[1]) framing <= 1'b1;
      else if (read_status) framing <= 1'b0;
    end

  wire send_empty = send_count == 8'd0 && !queued && !write_byte;
  wire [7:0] status = {1'b0, send_empty && !sending, send_empty, 1'b0, framing, 1'b0, overrun, receive_count != 8'd0};
  always @(posedge clock)
    case (address)
      3'd0: read_data <= divisor_access ? divisor[7:0] : receive_byte;
      3'd1: read_data <= divisor_access ? divisor[15:8] : 8'd0;
      3'd3: read_data <= {divisor_access, 7'd3};
      3'd5: read_data <= status;
      default: read_data <= 8'd0;
    endcase

  wire unused = &{1'b0, send_full};

endmodule
`default_nettype wire
