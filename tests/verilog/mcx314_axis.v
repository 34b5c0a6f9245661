// One axis generator of the MCX314 in Verilog, from motionrack/cards/mcx314/RULES.md: fixed-pulse and continuous drives
// with T- and S-curve, automatic or manual deceleration and the decelerating stop. One clock is one tick (8 MHz).
//
//   start ─┐ two clocks ┌ each clock: stop ─► acc + CV >= R: pulse ─► CV one step nearer to its target
//
// A third writing of the same rules: a referee between the event-driven model and the tick-by-tick twin.
`timescale 1ns / 1ns

module mcx314_axis (
    input  wire        clock,
    input  wire        start,          // the command was accepted after the last tick
    input  wire        continuous,
    input  wire        stop,           // 26h was written after the last tick
    input  wire [23:0] r,              // 16,000 .. 16,777,215
    input  wire [12:0] v, sv, a, d,    // 1 .. 8,000
    input  wire [15:0] k, ao,          // K 1 .. 65,535
    input  wire [27:0] p, dp,
    input  wire        manld, dsnde, sacc,
    output reg         busy,
    output reg         pulse           // High for the tick of the pulse's active edge
);
    localparam INC = 2'd0, CONST = 2'd1, DEC = 2'd2;

    reg [1:0]  wait_ticks;
    reg [24:0] acc;
    reg [12:0] cv, aim;
    reg [16:0] va;
    reg [12:0] ca;
    reg [20:0] ja;
    reg [1:0]  phase;
    reg        up, down;               // ramp +1, -1; neither: 0
    reg        final_, final_seen, stopping, stop_asked;
    reg [28:0] n, accel_pulses;

    wire [20:0] j = {1'b0, k, 4'b0};   // 16 K ticks a step of CA

    // Pulses left, signed: P may be smaller than n.
    wire signed [30:0] left = $signed({3'b0, p}) - $signed({2'b0, n});

    // The final deceleration's rule; with automatic deceleration P - n <= accel_pulses + AO.
    function due;
        input signed [30:0] pulses_left;
        input [28:0] made, gained;
        due = manld ? made >= {1'b0, dp} : pulses_left <= $signed({2'b0, gained}) + $signed({15'b0, ao});
    endfunction

    reg [12:0] target, limit;
    reg        ended;

    // Of an S-ramp: how far the speed is from its aim, and how far it gets while CA falls to 1, J ticks a step.
    function [47:0] way;
        input unused;
        way = (up ? aim - cv : cv - aim) * 48'd64000 - va;
    endfunction
    function [47:0] fall;
        input unused;
        fall = j * (ca * (ca - 48'd1) / 2);
    endfunction

    initial begin
        busy = 0; pulse = 0; stop_asked = 0; ca = 0;
    end

    always @(posedge clock) begin
        pulse = 0;
        ended = 0;
        if (start && !busy) begin
            busy = 1; wait_ticks = 2; acc = 0; va = 0; ja = 0; ca = 0; n = 0; accel_pulses = 0;
            up = 0; down = 0; phase = INC; final_seen = 0; stopping = 0; stop_asked = 0;
            cv = (v > sv) ? sv : v;
            final_ = !continuous && due($signed({3'b0, p}), 29'd0, 29'd0);
        end
        if (busy) begin
            if (stop) stop_asked = 1;
            if (wait_ticks != 0) wait_ticks = wait_ticks - 1;
            else begin
                // 1: stop, and a fixed drive without pulses left
                if (stop_asked) begin
                    stop_asked = 0;
                    if (cv <= sv) ended = 1;
                    else begin final_ = 1; stopping = 1; end
                end
                if (!continuous && left <= 0) ended = 1;
                // 2: pulse
                if (!ended) begin
                    acc = acc + cv;
                    if (acc >= r) begin
                        acc = acc - r;
                        pulse = 1;
                        n = n + 1;
                        if (up) accel_pulses = accel_pulses + 1;
                        if (down && !final_ && accel_pulses != 0) accel_pulses = accel_pulses - 1;
                        if (!continuous) begin
                            if (n >= {1'b0, p}) ended = 1;
                            else if (due($signed({3'b0, p}) - $signed({2'b0, n}), n, accel_pulses)) final_ = 1;
                        end
                    end
                end
                // 3: speed
                if (!ended && stopping && cv <= sv) ended = 1;
                if (!ended) begin
                    if (sacc) s_curve; else t_curve;
                    final_seen = final_;
                    if (stopping && cv <= sv) ended = 1;
                end
                if (ended) busy = 0;
            end
        end
    end

    task aim_speed;
        target = !final_ ? v : (cv > sv) ? sv : cv;
    endtask

    task t_curve;
        begin
            aim_speed;
            if (up != (target > cv) || down != (target < cv)) va = 0;
            up = target > cv;
            down = target < cv;
            if (up || down) begin
                ca = (down && dsnde) ? d : a;
                va = va + ca;
                if (va >= 64000) begin
                    va = va - 64000;
                    cv = up ? cv + 1 : cv - 1;
                end
                aim_speed;
                if (cv == target) begin up = 0; down = 0; va = 0; end
            end
        end
    endtask

    task ramp_over;
        begin up = 0; down = 0; va = 0; ja = 0; end
    endtask

    task s_curve;
        begin
            aim_speed;
            if (final_ && !final_seen) begin
                if (up) ramp_over;
                else if (down) begin
                    aim = target;
                    if (cv <= aim) ramp_over;
                    else if (phase == DEC) begin phase = INC; ja = 0; end
                end
            end
            if (!up && !down && cv != target) begin
                up = target > cv;
                down = target < cv;
                aim = target;
                phase = INC; ca = 0; va = 0; ja = down ? j : 0;
            end
            limit = (down && dsnde) ? d : a;
            if (up || down) begin
                if (phase == INC) begin
                    ja = ja + 1;
                    if (ja >= j) begin
                        ja = 0;
                        ca = ca + 1;
                        if (ca >= limit) phase = CONST;
                    end
                end else if (ca > 1 && way(0) <= fall(0)) begin
                    ca = ca - 1;
                    phase = DEC;
                end
                va = va + ca;
                if (va >= 64000) begin
                    va = va - 64000;
                    cv = up ? cv + 1 : cv - 1;
                end
                if (cv == aim) ramp_over;
                else if (phase == INC && way(0) <= fall(0) + ca * (ja + 48'd1)) begin
                    phase = DEC;
                    ja = 0;
                end
            end
        end
    endtask
endmodule
