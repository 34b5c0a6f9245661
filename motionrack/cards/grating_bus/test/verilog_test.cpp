// The bus in SystemVerilog (hdl/grating_bus, run by iverilog) against the twin: an independent implementation of the
// rules, clock by clock.
//
// The logic takes a clock from the edge of clk to S1, and its decoder one from a scale's lines to the count; hence the
// offset below, and counts of the clock before HOLD.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <motionrack/cards/grating_bus/test/twin.hpp>
#include <sstream>
#include <string>
#include <tests/source_root.hpp>

namespace motionrack::grating_bus::twin {
namespace {

constexpr Ticks clock_ticks = 100, first_s1 = 2;
const std::string folder = source_dir() + "/hdl/grating_bus/";

struct System {
    int words = 4, cards = 3, period = 2000, frames = 4, hosts = 1, apart = 0;  ///< period and apart in clocks
    bool verify_lines = false, slots = false;  ///< slots: whole cards with the pins of their connector
    int stride = 1, shift = 0;                 ///< word k of host h is that of scale (k stride + h shift) mod words
};

/// Results of the logic or of the twin, as text: "clock state", "clock" of good frames, the counters, and "card
/// sequence time crc", followed by address and count of each word.
struct Shown {
    std::vector<std::vector<std::string>> states, frames, published, counters;
    std::string end;
};

/// Returns the source files of the modules, and of the testbench `top`.
std::string files_of(const std::string& top) {
    std::string out;
    for (const char* file : {"card", "decoder", "shifter", "motion_card", "decoder_card"})
        out += " " + folder + "grating_" + file + ".sv";
    return out + " " + folder + "bench/grating_scales.sv " + folder + "bench/grating_" + top + ".sv";
}

bool installed(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null").c_str()) == 0;
}

Shown run_verilog(const System& system) {
    const std::vector<std::vector<std::string>> none(static_cast<std::size_t>(system.cards));
    Shown out{none, none, none, none, ""};
    const std::string program =
        (std::filesystem::temp_directory_path() / ("grating_" + std::to_string(getpid()))).string();
    std::string command =
        std::string("iverilog -g2012 -s grating_system_tb ") + (system.slots ? "-DSLOTS " : "") + "-o " + program;
    const auto parameter = [&](const char* name, int value) {
        command += std::string(" -Pgrating_system_tb.") + name + "=" + std::to_string(value);
    };
    parameter("N", system.words), parameter("CARDS", system.cards), parameter("PERIOD", system.period),
        parameter("FRAMES", system.frames);
    parameter("HOSTS", system.hosts), parameter("APART", system.apart);
    parameter("CHECKS", system.verify_lines ? 1 : 0);
    parameter("STRIDE", system.stride), parameter("SHIFT", system.shift);
    command += files_of(system.slots ? "slots" : "system") + " " + folder + "bench/grating_system_tb.sv";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::FILE* pipe = popen(("vvp " + program).c_str(), "r");
    if (!pipe) return out;
    std::array<char, 4096> line{};
    while (std::fgets(line.data(), line.size(), pipe)) {
        std::istringstream text(line.data());
        std::string kind, rest;
        std::size_t card = 0;
        text >> kind;
        if (kind != "end") text >> card;
        std::getline(text >> std::ws, rest);
        if (kind == "end") out.end = rest;
        if (kind == "state") out.states.at(card).push_back(rest);
        if (kind == "published") out.published.at(card).push_back(rest);
        if (kind == "counters") out.counters.at(card).push_back(rest);
        if (kind == "frame") out.frames.at(card).push_back(rest);
    }
    pclose(pipe);
    std::filesystem::remove(program);
    return out;
}

/// Returns the count of a scale after that clock edge, as in grating_scales.sv.
std::uint32_t position(int scale, std::int64_t edge) {
    const std::int64_t rate = 13'107 - 3'001 * (scale % 9), fraction = rate * edge;
    return static_cast<std::uint32_t>(fraction >= 0 ? fraction / 65'536 : -((-fraction + 65'535) / 65'536));
}

/// Returns the number of clocks at which drivers of one of the lines differ.
std::size_t conflicting(const Twin& twin, const std::set<Line>& lines) {
    std::set<std::int64_t> clocks;
    for (const Conflict& conflict : twin.conflicts())
        for (Ticks at = conflict.begin; lines.count(conflict.line) && at < conflict.end; at += clock_ticks)
            clocks.insert(at);
    return clocks.size();
}

Shown run_twin(const System& system) {
    CardSettings card;
    card.words = system.words;
    card.verify_lines = system.verify_lines;
    card.period = system.period * clock_ticks;
    card.offset = first_s1 * clock_ticks;
    for (int k = 0; k < system.words; ++k) card.list.push_back(k * system.stride % system.words);
    std::vector<CardSettings> cards(static_cast<std::size_t>(system.cards), card);
    for (int i = 0; i < system.hosts; ++i) {
        CardSettings& host = cards[static_cast<std::size_t>(i)];
        host.host = host.clock_out = host.address_out = true;
        host.offset += i * system.apart * clock_ticks;
        for (int& address : host.list) address = (address + i * system.shift) % system.words;
    }
    DecoderSettings decoder;
    decoder.scales = system.words;
    decoder.count = [](int scale, Ticks at) { return position(scale, at / clock_ticks - 1); };
    Twin twin(cards, {decoder});
    twin.run_to(card.period * system.frames);
    Shown out;
    for (int i = 0; i < system.cards; ++i) {
        std::vector<std::string>& states = out.states.emplace_back();
        for (const StateChange& change : twin.states(i))
            if (change.at > 0)
                states.push_back(
                    std::to_string(change.at / clock_ticks).append(" ").append(std::to_string(change.state)));
        std::vector<std::string>& published_at = out.published.emplace_back();
        const Counters& c = twin.counters(i);
        std::ostringstream counted;
        counted << c.broken << " " << c.missed_words << " " << c.alien << " " << c.lines;
        out.counters.push_back({counted.str()});
        std::vector<std::string>& frames = out.frames.emplace_back();
        for (const Published& published : twin.frames(i)) {
            const Frame& frame = published.frame;
            published_at.push_back(std::to_string(published.at / clock_ticks));
            std::string text =
                std::to_string(frame.sequence) + " " + std::to_string(frame.time) + " " + std::to_string(frame.crc);
            for (std::uint32_t k = 0; k < frame.words; ++k)
                text.append(" ")
                    .append(std::to_string(frame.addresses[k]))
                    .append(" ")
                    .append(std::to_string(frame.counts[k]));
            frames.push_back(text);
        }
    }
    std::ostringstream end;
    end << system.period * system.frames << " " << conflicting(twin, {clk}) << " "
        << conflicting(twin, {hold, read_n, addr}) << " 0";
    out.end = end.str();
    return out;
}

/// Returns a frame's text without its card, sequence, time and CRC.
std::string counts_of(const std::string& frame) {
    std::size_t at = 0;
    for (int i = 0; i < 3; ++i) at = frame.find(' ', at) + 1;
    return frame.substr(at);
}

/// Returns the number of frames whose counts differ from those of card 0 in the same period.
std::size_t compare(const std::vector<System>& systems) {
    std::size_t different = 0;
    for (const System& system : systems) {
        const Shown twin = run_twin(system), verilog = run_verilog(system);
        EXPECT_EQ(verilog.end, twin.end)
            << "clocks, clocks with a conflict on clk, on other lines, whether a scale's lines jumped";
        for (std::size_t card = 0; card < twin.frames.size(); ++card) {
            SCOPED_TRACE("card " + std::to_string(card) + " of " + std::to_string(system.cards) + ", N " +
                         std::to_string(system.words) + ", hosts " + std::to_string(system.hosts) + ", apart " +
                         std::to_string(system.apart));
            EXPECT_EQ(verilog.states[card], twin.states[card]);
            EXPECT_EQ(verilog.published[card], twin.published[card]);
            EXPECT_EQ(verilog.counters[card], twin.counters[card]);
            if (system.verify_lines && system.hosts > 1) continue;  // some periods have no frame to claim
            EXPECT_EQ(twin.frames[card].size(), static_cast<std::size_t>(system.frames));
            EXPECT_EQ(verilog.frames[card], twin.frames[card]);
            for (std::size_t i = 0; i < verilog.frames[card].size(); ++i)
                different += counts_of(verilog.frames[card][i]) != counts_of(verilog.frames[0].at(i));
        }
    }
    return different;
}

constexpr const char* no_iverilog =
    "iverilog is not installed (Debian package iverilog); the Verilog referee did not run";
bool no_referee() {
    return !installed("iverilog") || !installed("vvp");
}

TEST(GratingVerilog, HoldsTheSameFramesInTheSameStatesAsTheTwin) {
    if (no_referee()) GTEST_SKIP() << no_iverilog;
    const std::size_t different =
        compare({{4, 3}, {4, 11}, {8, 3}, {8, 11}, {1, 2}, {16, 1}, {40, 2}, {8, 11, 20'000, 2}});
    EXPECT_EQ(different, 0u);
}

TEST(GratingVerilog, ThreeHostsReadTheSameWrongFramesAsOnTheTwin) {
    if (no_referee()) GTEST_SKIP() << no_iverilog;
    std::vector<System> systems;
    for (const int apart : {1, 2, 3, 4, 5, 7, 9, 10, 11, 13, 20, 31, 44}) systems.push_back({4, 5, 500, 3, 3, apart});
    EXPECT_GT(compare(systems), 50u) << "hosts beside each other read different frames";
}

TEST(GratingVerilog, ReadsAnyListOfAddressesAndHostsWithOtherListsContend) {
    if (no_referee()) GTEST_SKIP() << no_iverilog;
    System stepping{8, 3}, other{5, 3}, apart{4, 4, 500, 3, 2, 0}, more{8, 4, 1000, 3, 2, 0};
    stepping.stride = 3, other.stride = 2, apart.shift = 1, more.stride = 3, more.shift = 2;
    EXPECT_EQ(compare({stepping, other}), 0u);
    compare({apart, more});
}

TEST(GratingVerilog, CountsErrorsAndPublishesOnlyGoodFramesAsTheTwin) {
    if (no_referee()) GTEST_SKIP() << no_iverilog;
    std::vector<System> systems{{4, 3}, {1, 2}};
    for (const int late : {0, 1, 2, 3, 5, 9, 11, 13, 44}) systems.push_back({4, 5, 500, 3, 3, late});
    systems.push_back({8, 4, 1000, 3, 2, 0});
    systems.back().stride = 3, systems.back().shift = 2;
    for (System& system : systems) system.verify_lines = true;
    compare(systems);
}

TEST(GratingVerilog, WholeCardsOnTheirConnectorsReadTheSameFrames) {
    if (no_referee()) GTEST_SKIP() << no_iverilog;
    System system{8, 5};
    system.slots = system.verify_lines = true, system.stride = 3;
    EXPECT_EQ(compare({system}), 0u);
}

TEST(GratingVerilog, IsAcceptedByVerilatorToo) {
    if (!installed("verilator"))
        GTEST_SKIP() << "verilator is not installed (Debian package verilator); it did not read the Verilog";
    const std::string lint = "verilator --lint-only -Wall -Wno-WIDTH -GN=8 --top-module ";
    const std::string bench = lint + "grating_system -GCARDS=11" + files_of("system");
    EXPECT_EQ(std::system(bench.c_str()), 0) << bench;
    for (const char* top : {"grating_motion_card -GHOST=1", "grating_motion_card", "grating_decoder_card"}) {
        std::string command = lint + top;
        for (const char* file : {"card", "decoder", "shifter", "motion_card", "decoder_card"})
            command += " " + folder + "grating_" + file + ".sv";
        EXPECT_EQ(std::system(command.c_str()), 0) << command;
    }
}

}  // namespace
}  // namespace motionrack::grating_bus::twin
