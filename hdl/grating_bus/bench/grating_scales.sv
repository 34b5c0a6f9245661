// N linear scales that move at steady speeds: their quadrature lines, made from positions with 16 bits of fraction.
//
//   position  0  1  2  3  0          after clock edge m it is floor(m * rate / 65536); rate of scale k: 13,107 - 3,001 k, so that scale 0
//   a         __/~~~~\____           moves at 20 MHz counts at 100 MHz and the later ones backwards
//   b         _/~~~~\_____
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
