// Commands to each kind of card, one at a time, drawn at random.
#include <fmt/format.h>

#include <array>
#include <iterator>
#include <limits>
#include <motionrack/cards/grating_bus/map.hpp>
#include <motionrack/rack/test/cut.hpp>

namespace motionrack::rack::cut {
namespace {

namespace gb = grating_bus;

constexpr int steps = 60;

Orders databoard4002(Random& random) {
    Orders out;
    const auto send = [&](char letter, std::initializer_list<std::uint64_t> bytes) {
        out.push_back(bus("d1", 8, 3, static_cast<unsigned char>(letter)));
        for (const std::uint64_t one : bytes) out.push_back(bus("d1", 8, 0, one & 0xFF));
    };
    out.push_back(bus("d1", 8, 1, 13));
    switch (below(random, 8)) {
        case 0: {
            const std::uint64_t rate = 16'383 - below(random, 4'000);
            send('R', {rate, rate >> 8});
            break;
        }
        case 1:
        case 2: {
            const std::uint64_t way = below(random, 4'000) - 2'000;
            send('N', {way, way >> 8, way >> 16});
            send('G', {});
            break;
        }
        case 3:
            send("QALMO" [below(random, 5)], {});
            break;
        case 4: {
            const char* const pin = std::array{"d1.esl", "d1.esr", "d1.ems", "d1.ref"}[below(random, 4)];
            out.push_back(level(pin, static_cast<double>(below(random, 2))));
            break;
        }
        case 5:
            out.push_back(peek("d1", 8, static_cast<std::uint32_t>(below(random, 2))));
            break;
        case 6:
            out.push_back(bus("d1", 8, 5, random() & 0xFF));
            break;
        default: {
            const auto port = static_cast<std::uint32_t>(below(random, 8));
            out.push_back(bus("d1", 8, port, random() & 0xFF));
        }
    }
    return out;
}

Orders ioflex02(Random& random) {
    const auto bit = [&] { return static_cast<double>(below(random, 2)); };
    switch (below(random, 5)) {
        case 0:
            return {peek("p1", 16, 0x2300 + 2 * static_cast<std::uint32_t>(below(random, 40)))};
        case 1: {
            const auto place = 0x2300 + 2 * static_cast<std::uint32_t>(below(random, 40));
            return {bus("p1", 16, place, below(random, 16))};
        }
        case 2: {  // both lines at the same instant, unlike an encoder
            const double a = bit(), b = bit();
            return {level("p1.a0", a), level("p1.b0", b)};
        }
        default: {
            const char* const line = std::array{"a", "b", "z", "cal"}[below(random, 4)];
            const std::string wire = fmt::format("p1.{}{}", line, below(random, 4));
            return {level(wire, bit())};
        }
    }
}

/// Returns a random operation of an IO8255: only modes 0 and 1; strobes change more often than other lines.
Orders io8255(Random& random) {
    const auto bit = [&] { return static_cast<double>(below(random, 2)); };
    switch (below(random, 6)) {
        case 0:
            return {peek("d8", 8, static_cast<std::uint32_t>(below(random, 3)))};
        case 1:
            return {bus("d8", 8, static_cast<std::uint32_t>(below(random, 3)), random() & 0xFF)};
        case 2:
            return {bus("d8", 8, 3, random() & (below(random, 4) == 0 ? 0xBF : 0x0F))};
        case 3:
            return {level(fmt::format("d8.p{}{}_in", "abc"[below(random, 3)], below(random, 8)), bit())};
        default:
            return {level(std::array{"d8.pc2_in", "d8.pc4_in", "d8.pc6_in"}[below(random, 3)], bit())};
    }
}

Orders rtc5(Random& random) {
    if (below(random, 3) == 0) return {peek("s", 32, 4 * static_cast<std::uint32_t>(below(random, 16)))};
    const char* const pin = std::array{"s.start_n", "s.mcbsp", "s.stop_n"}[below(random, 3)];
    return {level(pin, static_cast<double>(below(random, 2)))};
}

/// Forces tracks of scales and lines of the bus; most are released again.
Order line_of_bus(Random& random) {
    if (below(random, 2) == 0) {
        const std::string wire = fmt::format("decoder.{}{}", "ab"[below(random, 2)], below(random, 2));
        return level(wire, static_cast<double>(below(random, 2)));
    }
    static constexpr std::array lines = {"clk", "hold", "read_n", "addr", "addr1", "data0", "data31"};
    const std::string wire = std::string("bus.") + lines[below(random, lines.size())];
    const std::uint64_t to = below(random, 5);
    return level(wire, to < 2 ? static_cast<double>(to) : std::numeric_limits<double>::quiet_NaN());
}

Order break_bus(Random& random) {
    struct Fault {
        const char *what, *of;
    };
    static constexpr Fault all[] = {{"off", "g1"},
                                    {"off=0", "g1"},
                                    {"reset", "g1"},
                                    {"jitter=300", "g1"},
                                    {"jitter=0", "g1"},
                                    {"off", "g2"},
                                    {"off=0", "g2"},
                                    {"reset", "g2"},
                                    {"late=70", "g2"},
                                    {"late=0", "g2"},
                                    {"miss_edge=2", "g2"},
                                    {"no_latch", "decoder"},
                                    {"no_latch=0", "decoder"},
                                    {"off=0", "g1"},
                                    {"off=0", "g2"}};
    const Fault& one = all[below(random, std::size(all))];
    return fault(one.what, one.of);
}

Orders grating_bus(Random& random) {
    const char* const card = below(random, 2) == 0 ? "g1" : "g2";
    switch (below(random, 8)) {
        case 0:
        case 1:  // claims, releases, clears, sometimes resets
            return {bus(card, 16, 0, below(random, below(random, 4) == 0 ? 16 : 8))};
        case 2:
            return {peek(card, 16, 2 * static_cast<std::uint32_t>(below(random, 32)))};
        case 3:
            return {peek(card, 16, gb::counts_at + 2 * static_cast<std::uint32_t>(below(random, 6)))};
        case 4:
            return {peek("decoder", 16, gb::counts_at + 2 * static_cast<std::uint32_t>(below(random, 6)))};
        case 5:
        case 6:
            return {line_of_bus(random)};
        default:
            return {break_bus(random)};
    }
}

Orders any_of_them(Random& random) {
    constexpr std::array<Orders (*)(Random&), 6> all = {&databoard4002, &ioflex02,    &io8255,
                                                        &rtc5,          &grating_bus, &anything_to_pulse_chip};
    return all[below(random, all.size())](random);
}

constexpr const char* databoard4002_text = "[card.d1]\ntype = \"databoard4002\"\ncard_number = 13\n";
constexpr const char* ioflex02_text = "[card.p1]\ntype = \"ioflex02\"\n";
constexpr const char* io8255_text = "[card.d8]\ntype = \"io8255\"\n";
constexpr const char* rtc5_text = R"([card.s]
type = "rtc5"
list_memory = 2000
[belt.line]
card = "s"
velocity_mm_s = 100
counts_per_mm = 100
[scanner.head]
card = "s"
)";
constexpr const char* grating_bus_text = R"([card.decoder]
type = "grating_decoder"
scales = 3
[card.g1]
type = "grating_bus"
scales = 3
{0}[card.g2]
type = "grating_bus"
scales = 3
{0}[stage.table]
card = "g2"
input = 2
)";
constexpr const char* servo_text = R"([stage.table.servo]
profile = "scan"
from_mm = 0
to_mm = 4
max_velocity_mm_s = 20
max_accel_mm_s2 = 2000
)";

/// Encoders of axes whose edges are wires.
constexpr const char* encoder_wires = R"([wires]
"p1.a1" = "X.enc_a"
"p1.b1" = "X.enc_b"
"p1.z1" = "X.enc_z"
"decoder.a0" = "X.enc_a"
"decoder.b0" = "X.enc_b"
"s.enc1_a" = "B.enc_b"
"s.enc1_b" = "B.enc_a"
)";

/// Returns the story of a seed. Every third seed has a servo loop closed through the frames; in the others, the frame
/// period is so short that many calls end within a frame.
Story grating_story(std::uint64_t seed) {
    Random random(seed);
    const bool servo = seed % 3 == 0;
    const int period_us = servo ? 200 : std::array{1, 3, 20}[below(random, 3)];
    Story out;
    out.text = fmt::format(grating_bus_text, fmt::format("period_us = {}\n", period_us)) + (servo ? servo_text : "");
    out.steps = steps_of(random, steps, &grating_bus, servo ? 3e6 : 1e5);
    return out;
}

template <Orders (*orders)(Random&)>
std::vector<Step> many(std::uint64_t seed) {
    Random random(seed);
    return steps_of(random, steps, orders);
}

}  // namespace

std::vector<Bench> benches() {
    return {
        {"databoard4002",
         [](std::uint64_t seed) {
             return Story{databoard4002_text, many<&databoard4002>(seed)};
         }},
        {"ioflex02",
         [](std::uint64_t seed) {
             return Story{ioflex02_text, many<&ioflex02>(seed)};
         }},
        {"io8255",
         [](std::uint64_t seed) {
             return Story{io8255_text, many<&io8255>(seed)};
         }},
        {"rtc5",
         [](std::uint64_t seed) {
             return Story{rtc5_text, many<&rtc5>(seed)};
         }},
        {"grating_bus", &grating_story},
        {"all_cards",
         [](std::uint64_t seed) {
             const std::string text = mcx314_machine() + databoard4002_text + ioflex02_text + io8255_text + rtc5_text +
                                      fmt::format(grating_bus_text, "period_us = 2000\n") + encoder_wires;
             return Story{text, many<&any_of_them>(seed)};
         }},
    };
}

}  // namespace motionrack::rack::cut
