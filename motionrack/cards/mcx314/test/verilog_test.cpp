// Compares the axis generator in Verilog (tests/verilog/mcx314_axis.v, run by iverilog), a third implementation of the
// rules, with the twin and with the event-driven chip.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <motionrack/cards/mcx314/test/chip_rig.hpp>
#include <motionrack/cards/mcx314/test/twin_host.hpp>
#include <string>
#include <tests/environment.hpp>
#include <tests/source_root.hpp>
#include <vector>

namespace motionrack::mcx314::twin {
namespace {

// Parameters of a drive, as on the command line of the testbench.
struct VerilogDrive {
    std::int64_t r, v, sv, a, d, k, ao, p, dp;
    unsigned mode = 0;  // WR3: 1 manual, 2 own deceleration, 4 S-curve
    bool continuous = false;
    std::int64_t change_tick = -1, new_speed = 1, stop_tick = -1;
};

struct Course {
    std::vector<std::int64_t> pulses;
    std::int64_t end = 0;
};

Course run_twin(const VerilogDrive& drive) {
    Host host;
    host.speeds(1, drive.r, drive.v, drive.sv, drive.a, drive.d, drive.k, drive.ao);
    host.data(1, 0x06, drive.p);
    host.data(1, 0x07, drive.dp);
    host.mode(1, 3, drive.mode);
    host.command(1, drive.continuous ? 0x22 : 0x20);
    while (host.twin.any_driving() && host.twin.now() < 1'000'000) {
        host.twin.tick();
        if (host.twin.now() == drive.change_tick) host.data(1, 0x05, drive.new_speed);
        if (host.twin.now() == drive.stop_tick) host.command(1, 0x26);
    }
    Course out;
    for (const Pulse& pulse : host.twin.pulses()) out.pulses.push_back(pulse.tick);
    out.end = host.twin.now();
    return out;
}

// Returns the pulses of the same traffic on the event-driven chip; `end`: the last tick.
std::vector<std::int64_t> pulses_of_chip(const VerilogDrive& drive, std::int64_t end) {
    Program program;
    const auto write = [&](std::int64_t tick, int offset, std::int64_t value) {
        Op op;
        op.tick = tick, op.kind = Op::Kind::write;
        op.offset = static_cast<std::uint8_t>(offset), op.value = static_cast<std::uint16_t>(value);
        program.ops.push_back(op);
    };
    const auto data = [&](std::int64_t tick, int code, std::int64_t value) {
        write(tick, 14, value >> 16), write(tick, 12, value), write(tick, 0, 0x100 | code);
    };
    data(0, 0x00, drive.r), data(0, 0x05, drive.v), data(0, 0x04, drive.sv), data(0, 0x02, drive.a),
        data(0, 0x03, drive.d);
    data(0, 0x01, drive.k), data(0, 0x0D, drive.ao), data(0, 0x06, drive.p), data(0, 0x07, drive.dp);
    write(0, 0, 0x10F), write(0, 6, drive.mode), write(0, 0, drive.continuous ? 0x122 : 0x120);
    if (drive.change_tick >= 0) data(drive.change_tick, 0x05, drive.new_speed);
    if (drive.stop_tick >= 0) write(drive.stop_tick, 0, 0x126);
    write(end + 100'000, 14, 0);
    std::vector<std::int64_t> out;
    for (const Pulse& pulse : run_on_chip(program).pulses) out.push_back(pulse.tick);
    return out;
}

std::string plus_arguments(const VerilogDrive& d) {
    std::string out;
    const auto add = [&](const char* name, std::int64_t value) {
        out += std::string(" +") + name + "=" + std::to_string(value);
    };
    add("R", d.r), add("V", d.v), add("SV", d.sv), add("A", d.a), add("D", d.d), add("K", d.k), add("AO", d.ao),
        add("P", d.p);
    add("DP", d.dp), add("MODE", d.mode), add("CONTINUOUS", d.continuous ? 1 : 0);
    add("TV", d.change_tick), add("V2", d.new_speed), add("TS", d.stop_tick);
    return out;
}

Course run_verilog(const std::string& program, const VerilogDrive& drive) {
    Course out;
    std::FILE* pipe = popen(("vvp " + program + plus_arguments(drive)).c_str(), "r");
    if (!pipe) return out;
    std::array<char, 80> line{};
    while (std::fgets(line.data(), line.size(), pipe)) {
        const std::string text = line.data();
        if (text.rfind("end ", 0) == 0)
            out.end = std::atoll(text.c_str() + 4);
        else
            out.pulses.push_back(std::atoll(text.c_str()));
    }
    pclose(pipe);
    return out;
}

TEST(Mcx314Verilog, MakesTheSamePulsesInTheSameTicksAsTheTwinAndTheChip) {
    if (std::system("command -v iverilog >/dev/null && command -v vvp >/dev/null") != 0)
        GTEST_SKIP() << "iverilog is not installed (Debian package iverilog); the Verilog referee did not run";
    const std::string folder = source_dir() + "/tests/verilog/";
    const std::string program =
        (std::filesystem::temp_directory_path() / ("mcx314_axis_" + std::to_string(getpid()))).string();
    ASSERT_EQ(
        std::system(
            ("iverilog -g2001 -o " + program + " " + folder + "mcx314_axis.v " + folder + "mcx314_axis_tb.v").c_str()),
        0);

    const std::vector<VerilogDrive> drives{
        {16'000, 8000, 1000, 8000, 8000, 1, 0, 20'000, 0, 0},  // T, trapezoid
        {16'000, 8000, 1000, 8000, 8000, 1, 8, 3001, 0, 0},    // T, triangle
        {20'000, 5000, 400, 3000, 700, 1, 3, 5000, 0, 2},      // own deceleration, with creep or truncated
        {20'000, 5000, 400, 3000, 7000, 1, 0, 5000, 4000, 3},  // manual
        {160'000, 3000, 5000, 100, 100, 1, 0, 50, 0, 0},       // V <= SV: constant
        {16'000, 6000, 200, 8000, 8000, 1, 0, 20'000, 0, 4},   // complete S
        {16'000, 6000, 200, 1500, 8000, 1, 0, 20'000, 0, 4},   // partial S
        {16'000, 6000, 200, 1500, 900, 3, 5, 30'000, 0, 6},    // S with its own deceleration
        {16'000, 6000, 200, 8000, 8000, 1, 0, 4000, 0, 4},     // truncated S
        {32'000, 4000, 500, 2000, 2000, 1, 0, 9000, 0, 0, false, 20'000, 2500},    // V lowered while driving
        {16'000, 4000, 500, 4000, 4000, 1, 0, 20'000, 0, 4, false, 30'000, 7000},  // V raised in an S ramp
        {16'000, 8000, 500, 3000, 3000, 1, 0, 0, 0, 0, true, -1, 1, 60'000},  // continuous, stopped while accelerating
        {16'000, 4000, 500, 3000, 3000, 2, 0, 0, 0, 4, true, -1, 1, 50'000},  // S, stopped while accelerating
        {16'000, 5000, 500, 2000, 2000, 1, 0, 0, 0, 4, true, 90'000, 1000, 130'000},  // S, stopped while decelerating
        {16'000, 8000, 8000, 1, 1, 1, 0, 0, 0, 0},                                    // no pulses
    };
    for (std::size_t i = 0; i < drives.size(); i += thorough() ? 1 : 4) {
        const Course twin = run_twin(drives[i]), verilog = run_verilog(program, drives[i]);
        EXPECT_EQ(twin.end, verilog.end) << "drive " << i << plus_arguments(drives[i]);
        EXPECT_LT(twin.end, 1'000'000) << "drive " << i;
        EXPECT_EQ(twin.pulses, verilog.pulses) << "drive " << i << plus_arguments(drives[i]);
        EXPECT_EQ(pulses_of_chip(drives[i], verilog.end), verilog.pulses) << "drive " << i << plus_arguments(drives[i]);
    }
    std::filesystem::remove(program);
}

}  // namespace
}  // namespace motionrack::mcx314::twin
