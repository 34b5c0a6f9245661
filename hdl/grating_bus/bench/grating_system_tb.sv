// Runs grating_system (with the macro SLOTS: grating_slots) for FRAMES periods and prints the events of each card:
//   state CARD CLOCK STATE                          the card has entered a state
//   frame CARD SEQUENCE TIME CRC ADDRESS COUNT ..   the claimed frame, after all cards have completed theirs
//   published CARD CLOCK                            the card has published a good frame
//   counters CARD BROKEN MISSED ALIEN LINES         at the end
//   end CLOCK CONFLICTS CONFLICTS ILLEGAL           clocks with a conflict on clk and on others; 1: a scale too fast
`timescale 1ns / 1ns

module grating_system_tb #(
    parameter N      = 4,
    parameter CARDS  = 3,
    parameter PERIOD = 20000,
    parameter FRAMES = 3,
    parameter HOSTS  = 1,
    parameter APART  = 0,
    parameter CHECKS = 0,
    parameter STRIDE = 1,
    parameter SHIFT  = 0
);
    logic                clock = 0, claim = 0, illegal, clk_conflict, conflict;
    logic [6:0]          word_asked = 0;
    logic [CARDS*32-1:0] words, sequences, crcs;
    logic [CARDS*64-1:0] times;
    logic [CARDS*7-1:0]  addresses;
    logic [6:0]          address [0:CARDS*N-1];
    logic [CARDS-1:0]    claimed, frame_done, frame_good, done;
    logic [CARDS*64-1:0] counters;
    logic [CARDS*4-1:0]  states, was;
    logic [31:0]         frame [0:CARDS*N-1];
    integer              cycle, clk_conflicts, conflicts, i, w, reading;

`ifdef SLOTS
    grating_slots
`else
    grating_system
`endif
        #(.N(N), .CARDS(CARDS), .PERIOD(PERIOD), .HOSTS(HOSTS), .APART(APART), .CHECKS(CHECKS), .STRIDE(STRIDE),
          .SHIFT(SHIFT)) system (
        .clock(clock), .claim(claim), .give_back(1'b0), .word_asked(word_asked), .words_read(words),
        .addresses_read(addresses), .sequences_read(sequences), .times_read(times), .crcs_read(crcs), .claimed(claimed),
        .frame_done(frame_done), .frame_good(frame_good), .counters(counters), .states(states), .illegal(illegal),
        .clk_conflict(clk_conflict), .conflict(conflict));

    initial begin
        was = 0;
        done = 0;
        clk_conflicts = 0;
        conflicts = 0;
        reading = -1;
        for (cycle = 1; cycle <= FRAMES * PERIOD; cycle = cycle + 1) begin
            #5 clock = 1;
            #4;
            for (i = 0; i < CARDS; i = i + 1)
                if (states[4*i+:4] != was[4*i+:4]) $display("state %0d %0d %0d", i, cycle, states[4*i+:4]);
            was = states;
            for (i = 0; i < CARDS; i = i + 1) if (frame_good[i]) $display("published %0d %0d", i, cycle);
            if (clk_conflict) clk_conflicts = clk_conflicts + 1;
            if (conflict) conflicts = conflicts + 1;
            done = done | frame_done;
            claim = &done;
            if (reading >= 0) begin
                for (i = 0; i < CARDS; i = i + 1) begin
                    frame[i*N+reading] = words[32*i+:32];
                    address[i*N+reading] = addresses[7*i+:7];
                end
                reading = reading + 1;
                if (reading == N) begin
                    for (i = 0; i < CARDS; i = i + 1) begin
                        $write("frame %0d %0d %0d %0d", i, sequences[32*i+:32], times[64*i+:64], crcs[32*i+:32]);
                        for (w = 0; w < N; w = w + 1) $write(" %0d %0d", address[i*N+w], frame[i*N+w]);
                        $write("\n");
                    end
                    reading = -1;
                end
                word_asked = reading < 0 ? 7'd0 : reading[6:0];
            end
            if (claim) begin
                reading = -2;
                done = 0;
            end
            else if (reading == -2) begin
                reading = 0;
                word_asked = 0;
            end
            #1 clock = 0;
        end
        for (i = 0; i < CARDS; i = i + 1)
            $display("counters %0d %0d %0d %0d %0d", i, counters[64*i+:16], counters[64*i+16+:16], counters[64*i+32+:16],
                     counters[64*i+48+:16]);
        $display("end %0d %0d %0d %0d", FRAMES * PERIOD, clk_conflicts, conflicts, illegal);
        $finish;
    end
endmodule
