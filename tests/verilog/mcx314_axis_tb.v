// Drives mcx314_axis once with the parameters of its command line (+R=16000 +V=8000 ..) and prints the tick of every
// pulse, then "end" and the tick at which the drive ended. +TV=n +V2=v: V becomes v after tick n; +TS=n: 26h after
// tick n. The command comes after tick 0.
`timescale 1ns / 1ns

module mcx314_axis_tb;
    reg clock = 0, start = 0, stop = 0;
    integer r, v, sv, a, d, k, p, dp, ao, mode, continuous, tv, v2, ts, most, tick;
    wire busy, pulse;

    mcx314_axis axis (.clock(clock), .start(start), .continuous(continuous[0]), .stop(stop), .r(r[23:0]),
                      .v(v[12:0]), .sv(sv[12:0]), .a(a[12:0]), .d(d[12:0]), .k(k[15:0]), .ao(ao[15:0]),
                      .p(p[27:0]), .dp(dp[27:0]), .manld(mode[0]), .dsnde(mode[1]), .sacc(mode[2]),
                      .busy(busy), .pulse(pulse));

    initial begin
        if (!$value$plusargs("R=%d", r)) r = 16000;
        if (!$value$plusargs("V=%d", v)) v = 8000;
        if (!$value$plusargs("SV=%d", sv)) sv = 8000;
        if (!$value$plusargs("A=%d", a)) a = 8000;
        if (!$value$plusargs("D=%d", d)) d = 8000;
        if (!$value$plusargs("K=%d", k)) k = 1;
        if (!$value$plusargs("P=%d", p)) p = 0;
        if (!$value$plusargs("DP=%d", dp)) dp = 0;
        if (!$value$plusargs("AO=%d", ao)) ao = 0;
        if (!$value$plusargs("MODE=%d", mode)) mode = 0;
        if (!$value$plusargs("CONTINUOUS=%d", continuous)) continuous = 0;
        if (!$value$plusargs("TV=%d", tv)) tv = -1;
        if (!$value$plusargs("V2=%d", v2)) v2 = 1;
        if (!$value$plusargs("TS=%d", ts)) ts = -1;
        if (!$value$plusargs("MOST=%d", most)) most = 1000000;
        start = 1;
        tick = 0;
        while (tick < most && (tick == 0 || busy)) begin
            tick = tick + 1;
            #62 clock = 1;
            #1 if (pulse) $display("%0d", tick);
            #62 clock = 0;
            start = 0;
            stop = tick == ts;
            if (tick == tv) v = v2;
        end
        $display("end %0d", tick);
        $finish;
    end
endmodule
