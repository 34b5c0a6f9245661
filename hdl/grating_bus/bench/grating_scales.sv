// N linear scales that move at constant velocities: their quadrature lines, from positions with 16 bits of fraction.
//
//   position  0  1  2  3  0          after clock edge m: floor(m * rate / 65536)
//   a         __/~~~~\____
//   b         _/~~~~\_____
//
// The rate of scale k is 13,107 - 3,001 (k mod 9) per clock. At 100 MHz, scale 0 makes 20 million counts per second;
// scales with k mod 9 of 5 and more move backwards.
`timescale 1ns / 1ns

module grating_scales #(
    parameter N = 4
) (
    input  logic         clock,
    output logic [N-1:0] a,
    output logic [N-1:0] b
);
    for (genvar k = 0; k < N; k = k + 1) begin : scale
        localparam signed [47:0] RATE = 13107 - 3001 * (k % 9);
        logic signed [47:0] position = 0;

        always_ff @(posedge clock) position <= position + RATE;
        assign a[k] = position[17];
        assign b[k] = position[17] ^ position[16];
    end
endmodule
