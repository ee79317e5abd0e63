// SPDX-License-Identifier: Apache-2.0
// UART, 8N1, with the registers of a 16550 that the firmware uses, and FIFOs of 128 bytes, both in one block of RAM. The divisor is the
// length of a bit in 1/16 ticks of the clock:
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
    output wire [ 7:0] read_data,
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

  // The FIFOs: one port writes, the program's bytes first; one reads, the program's first. Indices have a bit more than an address.
  reg [7:0] bytes[0:255];
  reg [7:0] byte_read;
  reg [7:0] send_in, send_out, receive_in, receive_out;
  reg [7:0] received;
  reg arrived;  // what was received is not stored yet
  wire send_full = send_in == (send_out ^ 8'h80);
  wire receive_full = receive_in == (receive_out ^ 8'h80);
  wire send_some = send_in != send_out;
  wire receive_some = receive_in != receive_out;
  wire store_sent = write_byte && !send_full;
  wire store_received = arrived && !write_byte;
  always @(posedge clock) begin
    byte_read <= bytes[read_byte ? {1'b1, receive_out[6:0]} : {1'b0, send_out[6:0]}];
    if (store_sent || (store_received && !receive_full))
      bytes[write_byte ? {1'b0, send_in[6:0]} : {1'b1, receive_in[6:0]}] <= write_byte ? write_data : received;
  end

  // Transmission: a bit ends when what is left of it is less than a tick.
  wire send_next;
  reg [9:0] send_bits;  // stop bit, byte, start bit, from bit 0 on
  reg [3:0] send_left;
  reg [16:0] send_time;
  reg sending;
  reg send_ready;  // the oldest byte is on byte_read
  wire send_bit_ends = send_time < 17'd32;
  assign send_next = !sending && send_ready;
  assign transmit = !sending || send_bits[0];
  always @(posedge clock)
    if (reset) begin
      sending    <= 1'b0;
      send_bits  <= 10'h3FF;
      send_left  <= 4'd0;
      send_time  <= 17'd0;
      send_in    <= 8'd0;
      send_out   <= 8'd0;
      send_ready <= 1'b0;
    end else begin
      if (store_sent) send_in <= send_in + 8'd1;
      if (send_next) send_out <= send_out + 8'd1;
      send_ready <= send_some && !send_next && !read_byte;
      if (send_next) begin
        sending   <= 1'b1;
        send_bits <= {1'b1, byte_read, 1'b0};
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
  reg overrun;
  reg framing;
  wire sample = receiving && receive_time < 17'd32;
  wire stop = sample && receive_left == 4'd0;
  always @(posedge clock) line <= {line[1:0], receive};
  always @(posedge clock)
    if (reset) begin
      receiving    <= 1'b0;
      receive_left <= 4'd0;
      receive_time <= 17'd0;
      received     <= 8'd0;
      arrived      <= 1'b0;
      receive_in   <= 8'd0;
      receive_out  <= 8'd0;
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
        if (!stop) received <= {line[1], received[7:1]};
      end
      if (stop && line[1]) arrived <= 1'b1;
      else if (store_received) arrived <= 1'b0;
      if (store_received && !receive_full) receive_in <= receive_in + 8'd1;
      if (read_byte && receive_some) receive_out <= receive_out + 8'd1;
      if (store_received && receive_full) overrun <= 1'b1;
      else if (read_status) overrun <= 1'b0;
      if (stop && !line[1]) framing <= 1'b1;
      else if (read_status) framing <= 1'b0;
    end

  wire send_empty = !send_some && !write_byte;
  wire [7:0] status = {1'b0, send_empty && !sending, send_empty, 1'b0, framing, 1'b0, overrun, receive_some};
  reg from_fifo;
  reg [7:0] from_register;
  assign read_data = from_fifo ? byte_read : from_register;
  always @(posedge clock) begin
    from_fifo <= read_byte;
    case (address)
      3'd0: from_register <= divisor[7:0];
      3'd1: from_register <= divisor_access ? divisor[15:8] : 8'd0;
      3'd3: from_register <= {divisor_access, 7'd3};
      3'd5: from_register <= status;
      default: from_register <= 8'd0;
    endcase
  end

endmodule
`default_nettype wire
