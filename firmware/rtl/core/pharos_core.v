// SPDX-License-Identifier: Apache-2.0
// RV32IM with Zicsr and Zifencei, machine mode only, in three stages: fetch, decode, execute (README.md).
//
// Buses: a request is held until a tick without wait; what was read is there in the next tick. A fetch that waits may
// change its address or be withdrawn. ibus_fault comes with the data, dbus_fault with the tick that takes the request.
// ibus_next is the address of the next tick, for a memory that looks it up beforehand; ibus_jumps: it does not follow.
// Reset: synchronous, at least one tick.
`default_nettype none

module pharos_core #(
    parameter [31:0] RESET_ADDRESS = 32'h80000000,
    parameter ADDRESS_TICK = 0  // 1: loads and stores spend a tick on their address; a shorter path for a slower chip
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
    output wire [63:0] cycle,  // since reset
    // For test benches: an instruction ends in this tick, at this address; it was trapped, or gave way to an interrupt.
    output wire        trace_ends,
    output wire [31:0] trace_address,
    output wire        trace_trapped,
    output wire        trace_interrupted
);

  localparam [3:0] INSTRUCTION_MISALIGNED = 4'd0;
  localparam [3:0] INSTRUCTION_FAULT = 4'd1;
  localparam [3:0] ILLEGAL_INSTRUCTION = 4'd2;
  localparam [3:0] BREAKPOINT = 4'd3;
  localparam [3:0] LOAD_FAULT = 4'd5;
  localparam [3:0] STORE_FAULT = 4'd7;
  localparam [3:0] TIMER_INTERRUPT = 4'd7;
  localparam [3:0] ENVIRONMENT_CALL = 4'd11;

  // Fetch.
  reg [31:2] fetch_address;
  reg d_valid;
  wire x_stays;  // the instruction in execute needs another tick
  wire redirect;
  wire [31:2] redirect_address;
  wire d_moves = d_valid && !x_stays;
  assign ibus_read = !d_valid || d_moves;
  assign ibus_address = fetch_address;
  wire fetched = ibus_read && !ibus_wait;
  assign ibus_next = redirect ? redirect_address : fetched ? fetch_address + 30'd1 : fetch_address;
  assign ibus_jumps = redirect;

  always @(posedge clock)
    if (reset) fetch_address <= RESET_ADDRESS[31:2];
    else fetch_address <= ibus_next;

  // Decode: the bus shows the word for one tick only.
  reg [31:2] d_address;
  reg d_fresh;
  reg [31:0] d_word_held;
  reg d_fault_held;
  wire [31:0] d_word = d_fresh ? ibus_readdata : d_word_held;
  wire d_fault = d_fresh ? ibus_fault : d_fault_held;

  always @(posedge clock)
    if (reset) d_valid <= 1'b0;
    else if (redirect) d_valid <= 1'b0;
    else if (fetched) d_valid <= 1'b1;
    else if (d_moves) d_valid <= 1'b0;

  always @(posedge clock) begin
    d_fresh      <= fetched;
    d_word_held  <= d_word;
    d_fault_held <= d_fault;
    if (fetched) d_address <= fetch_address;
  end

  wire [31:0] d_immediate;
  wire d_illegal, d_writes, d_load, d_store, d_branch, d_jump, d_jump_register, d_load_upper, d_add_upper, d_multiply;
  wire d_divide, d_control_register, d_environment_call, d_breakpoint, d_trap_return, d_fence_instructions;
  wire [2:0] d_operation;
  wire d_arithmetic_shift, d_subtract, d_compare_unsigned, d_use_immediate;
  core_decode decode (
      .instruction(d_word),
      .immediate(d_immediate),
      .illegal(d_illegal),
      .writes(d_writes),
      .load(d_load),
      .store(d_store),
      .branch(d_branch),
      .jump(d_jump),
      .jump_register(d_jump_register),
      .load_upper(d_load_upper),
      .add_upper(d_add_upper),
      .multiply(d_multiply),
      .divide(d_divide),
      .control_register(d_control_register),
      .environment_call(d_environment_call),
      .breakpoint(d_breakpoint),
      .trap_return(d_trap_return),
      .fence_instructions(d_fence_instructions),
      .operation(d_operation),
      .arithmetic_shift(d_arithmetic_shift),
      .subtract(d_subtract),
      .compare_unsigned(d_compare_unsigned),
      .use_immediate(d_use_immediate)
  );

  // Execute: what was decoded. A word that could not be fetched has none of the kinds below.
  reg x_valid;
  reg x_upper;    // the word below was taken; the one above is requested
  reg x_second;   // it has begun, in an earlier tick, what takes more than one: its result is awaited
  reg x_waiting;  // its request waited in the tick before
  reg [31:2] x_address;
  reg [31:0] x_word;
  reg [31:0] x_immediate;
  reg x_fault, x_illegal, x_writes, x_load, x_store, x_branch, x_jump, x_jump_register, x_add_upper, x_multiply;
  reg x_divide, x_control_register, x_environment_call, x_breakpoint, x_trap_return, x_fence_instructions;
  reg [2:0] x_operation;
  reg x_arithmetic_shift, x_subtract, x_compare_unsigned, x_use_immediate;
  wire [2:0] x_funct3 = x_word[14:12];

  wire ends;
  assign x_stays = x_valid && !ends;

  always @(posedge clock)
    if (reset) x_valid <= 1'b0;
    else if (!x_stays) x_valid <= d_valid && !redirect;

  always @(posedge clock)
    if (d_moves) begin
      x_address            <= d_address;
      x_word               <= d_word;
      x_immediate          <= d_immediate;
      x_fault              <= d_fault;
      x_illegal            <= d_illegal && !d_fault;
      x_writes             <= d_writes && !d_fault && d_word[11:7] != 5'd0;
      x_load               <= d_load && !d_fault;
      x_store              <= d_store && !d_fault;
      x_branch             <= d_branch && !d_fault;
      x_jump               <= d_jump && !d_fault;
      x_jump_register      <= d_jump_register;
      x_add_upper          <= d_add_upper;
      x_multiply           <= d_multiply && !d_fault;
      x_divide             <= d_divide && !d_fault;
      x_control_register   <= d_control_register && !d_fault;
      x_environment_call   <= d_environment_call && !d_fault;
      x_breakpoint         <= d_breakpoint && !d_fault;
      x_trap_return        <= d_trap_return && !d_fault;
      x_fence_instructions <= d_fence_instructions && !d_fault;
      x_operation          <= d_operation;
      x_arithmetic_shift   <= d_arithmetic_shift;
      x_subtract           <= d_subtract;
      x_compare_unsigned   <= d_compare_unsigned;
      x_use_immediate      <= d_use_immediate;
    end

  // Operands: block RAM is read as an instruction moves to execute; the result of the one that ends in that tick, which
  // the RAM does not show yet, comes from `bypass`.
  wire [31:0] result;
  wire write_back;
  wire [31:0] stored_1;
  wire [31:0] stored_2;
  core_registers registers (
      .clock(clock),
      .read(d_moves),
      .number_1(d_word[19:15]),
      .number_2(d_word[24:20]),
      .value_1(stored_1),
      .value_2(stored_2),
      .write(write_back),
      .write_number(x_word[11:7]),
      .write_value(result)
  );

  reg [31:0] bypass;
  reg bypass_1, bypass_2, zero_1, zero_2;
  always @(posedge clock)
    if (d_moves) begin
      bypass   <= result;
      bypass_1 <= write_back && x_word[11:7] == d_word[19:15];
      bypass_2 <= write_back && x_word[11:7] == d_word[24:20];
      zero_1   <= d_word[19:15] == 5'd0 || d_load_upper;
      zero_2   <= d_word[24:20] == 5'd0;
    end
  wire [31:0] operand_1 = zero_1 ? 32'd0 : bypass_1 ? bypass : stored_1;
  wire [31:0] operand_2 = zero_2 ? 32'd0 : bypass_2 ? bypass : stored_2;

  wire [31:0] alu_result;
  wire [31:0] sum;
  wire equal, less;
  core_alu alu (
      .a(operand_1),
      .b(x_use_immediate ? x_immediate : operand_2),
      .operation(x_operation),
      .arithmetic_shift(x_arithmetic_shift),
      .subtract(x_subtract),
      .compare_unsigned(x_compare_unsigned),
      .sum(sum),
      .equal(equal),
      .less(less),
      .result(alu_result)
  );

  // Jumps.
  wire [31:0] relative = {x_address, 2'd0} + x_immediate;
  wire [31:0] target = x_jump_register ? {sum[31:1], 1'b0} : relative;
  wire holds = (x_funct3[2] ? less : equal) != x_funct3[0];
  wire jumps = x_jump || (x_branch && holds);
  wire [31:2] next_address = x_address + 30'd1;

  // Loads and stores. The operands stay until the instruction ends. Where the bytes cross into the next word, there are
  // two requests.
  wire crosses;
  wire [3:0] lower_bytes, upper_bytes;
  reg [31:2] upper_address;
  reg [31:0] kept_address;  // with ADDRESS_TICK
  reg x_addressed;          // it holds the address of this instruction
  wire [31:0] data_address = ADDRESS_TICK != 0 ? kept_address : sum;
  reg [31:0] lower_lanes;
  reg lower_fresh;  // the bus shows the lower word
  wire [31:0] load_value;
  core_lanes lanes (
      .width(x_funct3),
      .offset(data_address[1:0]),
      .store_value(operand_2),
      .crosses(crosses),
      .lower_bytes(lower_bytes),
      .upper_bytes(upper_bytes),
      .store_lanes(dbus_writedata),
      .lower_lanes(lower_lanes),
      .upper_lanes(dbus_readdata),
      .load_value(load_value)
  );
  wire interrupt;
  wire first = x_valid && !x_second && !x_upper && !x_addressed;
  wire interrupted = first && !x_waiting && interrupt;
  wire works = first && !interrupted;
  wire requests = (ADDRESS_TICK != 0 ? x_addressed : works) || (x_valid && x_upper && !x_second);
  assign dbus_address = x_upper ? upper_address : data_address[31:2];
  assign dbus_bytes = x_upper ? upper_bytes : lower_bytes;
  assign dbus_read = requests && x_load;
  assign dbus_write = requests && x_store;
  wire accesses = dbus_read || dbus_write;
  wire accepted = accesses && !dbus_wait;
  wire refused = accepted && dbus_fault;
  wire last_accepted = accepted && (x_upper || !crosses);

  always @(posedge clock) begin
    x_upper       <= !reset && x_stays && (x_upper || (accepted && crosses));
    upper_address <= data_address[31:2] + 30'd1;
    kept_address  <= sum;
    x_addressed   <= ADDRESS_TICK != 0 && !reset && ((works && (x_load || x_store)) || (x_addressed && !accepted));
    lower_fresh   <= accepted;
    if (lower_fresh) lower_lanes <= dbus_readdata;
  end

  // Multiplication and division.
  wire [31:0] multiply_result;
  wire [31:0] divide_result;
  wire divide_done;
  core_multiply multiply (
      .clock(clock),
      .operation(x_funct3[1:0]),
      .a(operand_1),
      .b(operand_2),
      .result(multiply_result)
  );
  core_divide divide (
      .clock(clock),
      .reset(reset),
      .start(works && x_divide),
      .operation(x_funct3[1:0]),
      .a(operand_1),
      .b(operand_2),
      .done(divide_done),
      .result(divide_result)
  );

  always @(posedge clock) begin
    x_second  <= !reset && x_stays && (x_second || (x_load && last_accepted) || x_multiply || x_divide);
    x_waiting <= !reset && accesses && dbus_wait;
  end

  // Control registers.
  wire csr_illegal;
  wire [31:0] csr_value;
  wire [31:2] trap_vector;
  wire [31:2] return_address;
  wire trapped;
  reg [3:0] cause;
  reg [31:0] trap_value;
  core_csr csr (
      .clock(clock),
      .reset(reset),
      .number(x_word[31:20]),
      .reads_only(x_funct3[1] && x_word[19:15] == 5'd0),
      .operation(x_funct3[1:0]),
      .operand(x_funct3[2] ? {27'd0, x_word[19:15]} : operand_1),
      .commit(works && x_control_register && !csr_illegal),
      .illegal(csr_illegal),
      .value(csr_value),
      .trap(trapped || interrupted),
      .trap_interrupt(interrupted),
      .trap_cause(cause),
      .trap_address(x_address),
      .trap_value(trap_value),
      .trap_return(works && x_trap_return),
      .vector(trap_vector),
      .return_address(return_address),
      .timer_interrupt(timer_interrupt),
      .interrupt(interrupt),
      .retired(ends && x_valid && !trapped && !interrupted),
      .cycle(cycle)
  );

  // Exceptions, all in the first tick but a refused access to the upper word.
  wire illegal = x_illegal || (x_control_register && csr_illegal);
  wire off_target = jumps && target[1];
  wire trapped_at_once = (works && (x_fault || illegal || x_breakpoint || x_environment_call)) || refused;
  assign trapped = trapped_at_once || (works && off_target);
  always @* begin
    cause = x_store ? STORE_FAULT : LOAD_FAULT;
    trap_value = sum;
    if (x_jump || x_branch) begin
      cause = INSTRUCTION_MISALIGNED;
      trap_value = target;
    end
    if (x_environment_call) begin
      cause = ENVIRONMENT_CALL;
      trap_value = 32'd0;
    end
    if (x_breakpoint) begin
      cause = BREAKPOINT;
      trap_value = 32'd0;
    end
    if (illegal) begin
      cause = ILLEGAL_INSTRUCTION;
      trap_value = x_word;
    end
    if (x_fault) begin
      cause = INSTRUCTION_FAULT;
      trap_value = {x_address, 2'd0};
    end
    if (interrupted) begin
      cause = TIMER_INTERRUPT;
      trap_value = 32'd0;
    end
  end

  // End of an instruction.
  wire several_ticks = x_load || x_multiply || x_divide;
  // A jump ends in its first tick, also one to nowhere: so the end does not wait for a comparison.
  assign ends = interrupted || trapped_at_once || (x_second ? x_load || x_multiply || divide_done
                                                    : !several_ticks && !(x_store && !last_accepted));
  assign redirect = x_valid && ends &&
                    (interrupted || trapped || jumps || x_trap_return || x_fence_instructions);
  assign redirect_address = (interrupted || trapped) ? trap_vector :
                            x_trap_return ? return_address : x_fence_instructions ? next_address : target[31:2];
  assign write_back = x_valid && ends && x_writes && !trapped && !interrupted;
  assign result = x_load ? load_value :
                  x_multiply ? multiply_result :
                  x_divide ? divide_result :
                  x_control_register ? csr_value :
                  x_jump ? {next_address, 2'd0} :
                  x_add_upper ? relative : alu_result;

  assign trace_ends = x_valid && ends;
  assign trace_address = {x_address, 2'd0};
  assign trace_trapped = trapped;
  assign trace_interrupted = interrupted;

endmodule
`default_nettype wire
