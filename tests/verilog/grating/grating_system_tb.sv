// Runs grating_system for FRAMES periods and prints what each card does:
//   state CARD CLOCK STATE                          a state was entered
//   frame CARD SEQUENCE TIME CRC COUNT ..           the claimed frame, after it was complete
//   end CLOCK CONFLICTS ILLEGAL                     clocks with a conflict on a line; whether a scale was too fast
`timescale 1ns / 1ns

module grating_system_tb #(
    parameter N      = 4,
    parameter CARDS  = 3,
    parameter PERIOD = 20000,
    parameter FRAMES = 3
);
    logic                clock = 0, claim = 0, illegal, conflict;
    logic [7:0]          word_asked = 0;
    logic [CARDS*32-1:0] words, sequences, crcs;
    logic [CARDS*64-1:0] times;
    logic [CARDS-1:0]    claimed, frame_done;
    logic [CARDS*4-1:0]  states, was;
    logic [31:0]         frame [0:CARDS*N-1];
    integer              cycle, conflicts, i, w, reading;

    grating_system #(.N(N), .CARDS(CARDS), .PERIOD(PERIOD)) system (
        .clock(clock), .claim(claim), .give_back(1'b0), .word_asked(word_asked), .words_read(words),
        .sequences_read(sequences), .times_read(times), .crcs_read(crcs), .claimed(claimed), .frame_done(frame_done),
        .states(states), .illegal(illegal), .conflict(conflict));

    initial begin
        was = 0;
        conflicts = 0;
        reading = -1;
        for (cycle = 1; cycle <= FRAMES * PERIOD; cycle = cycle + 1) begin
            #5 clock = 1;
            #4;
            for (i = 0; i < CARDS; i = i + 1)
                if (states[4*i+:4] != was[4*i+:4]) $display("state %0d %0d %0d", i, cycle, states[4*i+:4]);
            was = states;
            if (conflict) conflicts = conflicts + 1;
            claim = &frame_done;
            if (reading >= 0) begin
                for (i = 0; i < CARDS; i = i + 1) frame[i*N+reading] = words[32*i+:32];
                reading = reading + 1;
                if (reading == N) begin
                    for (i = 0; i < CARDS; i = i + 1) begin
                        $write("frame %0d %0d %0d %0d", i, sequences[32*i+:32], times[64*i+:64], crcs[32*i+:32]);
                        for (w = 0; w < N; w = w + 1) $write(" %0d", frame[i*N+w]);
                        $write("\n");
                    end
                    reading = -1;
                end
                word_asked = reading < 0 ? 8'd0 : reading;
            end
            if (claim) reading = -2;
            else if (reading == -2) begin
                reading = 0;
                word_asked = 0;
            end
            #1 clock = 0;
        end
        $display("end %0d %0d %0d", FRAMES * PERIOD, conflicts, illegal);
        $finish;
    end
endmodule
