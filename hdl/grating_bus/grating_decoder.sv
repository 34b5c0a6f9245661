// The decoder card: counts N scales from their quadrature lines, freezes all counts at HOLD and drives the count of the
// addressed scale on the bus.
//
//   hold   __/~~~~~~~~~~~~~~~~~~      the counts are frozen one clock after the rising edge
//   read_n ~~~~~~~~\__________/~      data has the count two clocks after read_n has fallen or addr has changed
`timescale 1ns / 1ns

module grating_decoder #(
    parameter N = 4
) (
    input  logic         clock,
    input  logic [N-1:0] a,
    input  logic [N-1:0] b,
    input  logic         hold,
    input  logic         read_n,
    input  logic [6:0]   addr,
    output logic         data_enable,
    output logic [31:0]  data,
    output logic         illegal      // both lines of a scale have changed in one clock; stays 1
);
    logic [31:0] count  [0:N-1];
    logic [31:0] frozen [0:N-1];
    logic [N-1:0] jumped;
    logic         hold_before = 0, read_before = 1;
    logic [6:0]   addr_before = 7'h7F;

    for (genvar k = 0; k < N; k = k + 1) begin : scale
        logic [1:0] was = 0;
        wire  [1:0] phase = {a[k], a[k] ^ b[k]};
        wire  [1:0] step = phase - was;

        initial begin
            count[k] = 0;
            frozen[k] = 0;
            jumped[k] = 0;
        end
        always_ff @(posedge clock) begin
            was <= phase;
            if (step == 2'd1) count[k] <= count[k] + 32'd1;
            if (step == 2'd3) count[k] <= count[k] - 32'd1;
            if (step == 2'd2) jumped[k] <= 1;
            if (hold && !hold_before) frozen[k] <= count[k];
        end
    end

    // ---- the answer: two clocks after read_n has fallen or addr has changed, and at least three after hold's edge
    localparam [7:0] SCALES = N;
    localparam BITS = N == 1 ? 1 : $clog2(N);
    wire [BITS-1:0] chosen = addr[BITS-1:0];
    wire        asked = !read_n && (read_before || addr != addr_before);
    wire        held = hold && !hold_before;
    logic       waits = 0;
    logic [1:0] since_asked = 0, since_held = 0;      // clocks, saturating at 2 and 3
    logic [31:0] data_before = 0;
    wire  [1:0] asked_for = asked ? 2'd0 : since_asked;
    wire  [1:0] held_for = held ? 2'd0 : since_held;
    wire        owes = asked || held || waits;
    wire        puts_out = data_enable && owes && asked_for == 2'd2 && (!hold || held_for == 2'd3);

    assign data_enable = !read_n && {1'b0, addr} < SCALES;
    assign data = !puts_out ? data_before : hold ? frozen[chosen] : count[chosen];
    always_ff @(posedge clock) begin
        hold_before <= hold;
        read_before <= read_n;
        addr_before <= addr;
        since_asked <= asked_for == 2'd2 ? 2'd2 : asked_for + 2'd1;
        since_held <= held_for == 2'd3 ? 2'd3 : held_for + 2'd1;
        waits <= owes && !puts_out;
        data_before <= data;
    end
    assign illegal = |jumped;
endmodule
