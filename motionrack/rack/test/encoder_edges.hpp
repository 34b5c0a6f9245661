// Recorded edges of an axis' encoder tracks against all cards that count the tracks by wire, over random moves with
// random ends.
//
//   wires of the recording    card             inputs             counter
//   X.enc_a, X.enc_b          ioflex02         p1.a0, p1.b0       POSITION, and edges of each track
//                             grating_decoder  d1.a0, d1.b0       COUNT
//                             grating_bus      its bus            COUNT of the frame published last
//                             rtc5             s1.enc0_a, enc0_b  ENCODER0
//   Y.enc_a, Y.enc_b          the same at the next inputs, crossed over: all count backwards
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/test/edge_count.hpp>

namespace motionrack::rack {

/// Mechanics of an axis of the machine.
struct EncoderAxis {
    std::int64_t counts_per_rev = 4'000;  ///< per 3,200 pulses
    bool loses_steps = false;             ///< the motor does not follow every rate of its card
};

inline std::string encoder_machine(const EncoderAxis& axis) {
    std::string text =
        "[card.c1]\ntype = \"mcx314\"\n[card.p1]\ntype = \"ioflex02\"\n"
        "[card.d1]\ntype = \"grating_decoder\"\nscales = 2\n[card.g1]\ntype = \"grating_bus\"\nscales = 2\n"
        "[card.s1]\ntype = \"rtc5\"\nlist_memory = 64\n";
    const char* const motor = axis.loses_steps ? "" : "start_stop_hz = 1e7\npull_out_hz = 1e7\n";
    for (const auto& [name, channel] : {std::pair{'X', 'x'}, std::pair{'Y', 'y'}})
        text += fmt::format(
            "[axis.{0}]\ncard = \"c1\"\nchannel = \"{1}\"\nencoder_counts_per_rev = {2}\n[axis.{0}.motor]\n{3}", name,
            channel, axis.counts_per_rev, motor);
    text += "[wires]\n";
    for (const auto& [name, input, a, b] : {std::tuple{'X', 0, 'a', 'b'}, std::tuple{'Y', 1, 'b', 'a'}})
        text += fmt::format(
            "\"p1.a{1}\" = \"{0}.enc_{2}\"\n\"p1.b{1}\" = \"{0}.enc_{3}\"\n\"d1.a{1}\" = \"{0}.enc_{2}\"\n"
            "\"d1.b{1}\" = \"{0}.enc_{3}\"\n\"s1.enc{1}_a\" = \"{0}.enc_{2}\"\n\"s1.enc{1}_b\" = \"{0}.enc_{3}\"\n",
            name, input, a, b);
    return text;
}

/// The cards that count one of the encoders.
class EncoderReaders {
  public:
    EncoderReaders(Counted& bench, char axis) : bench_(bench), input_(axis == 'X' ? 0 : 1) {}

    void expect_what_was_recorded() {
        const std::string at = std::to_string(input_);
        const struct {
            const char* card;
            std::string value;
        } counters[] = {{"p1", at + ".POSITION"}, {"d1", at + ".COUNT"}, {"g1", at + ".COUNT"}, {"s1", "ENCODER" + at}};
        for (const auto& [card, value] : counters)
            EXPECT_EQ((input_ == 0 ? 1 : -1) * bench_.value(card, value), bench_.seen.count) << card << ' ' << value;
        EXPECT_EQ(bench_.value(input_ == 0 ? "x.EP" : "y.EP"), bench_.seen.count) << "c1, whose inputs are no wires";
        EXPECT_EQ(bench_.value("p1", at + ".ILLEGAL_TRANSITIONS"), 0);
        expect_each_edge();
    }

  private:
    /// Expects that the IOFLEX02 has counted the edges of each track, modulo 65,536.
    void expect_each_edge() {
        constexpr std::uint32_t base = 0x2300, strobe = 0x10, axis = 0x18;
        Card& card = *bench_.rack.card("p1");
        card.bus_write(16, base + axis, input_);
        card.bus_write(16, base + strobe, 1);
        const bool crossed = input_ != 0;
        EXPECT_EQ(bench_.value("p1", crossed ? "EDGES_B" : "EDGES_A"), bench_.seen.first & 0xFFFF);
        EXPECT_EQ(bench_.value("p1", crossed ? "EDGES_A" : "EDGES_B"), bench_.seen.second & 0xFFFF);
    }

    Counted& bench_;
    std::uint32_t input_;
};

inline void count_encoder(std::uint64_t moves, char letter, const EncoderAxis& axis) {
    SCOPED_TRACE(fmt::format("axis {}, {} counts{}", letter, axis.counts_per_rev, axis.loses_steps ? ", weak" : ""));
    Random random(seed_from_environment());
    const std::string name(1, letter);
    Counted bench(encoder_machine(axis), name + ".enc_a", name + ".enc_b", Wires::tracks);
    EncoderReaders readers(bench, letter);
    // At most 5 million counts per second, the limit of the encoder's electronics.
    const std::int64_t max_speed = std::min<std::int64_t>(8'000, 10'000 * 3'200 / axis.counts_per_rev);
    Mcx314Moves driving(bench, letter == 'X' ? 'x' : 'y', 0, max_speed, 400);
    for (std::uint64_t i = 0; moves_on(i, moves, bench) && !testing::Test::HasFailure(); ++i) {
        SCOPED_TRACE(fmt::format("move {}", i));
        driving.make(random);
        bench.pass(milliseconds(10));  // step loss after a stop without a ramp shows within 8 ms
        readers.expect_what_was_recorded();
    }
    EXPECT_NE(bench.seen.first, 0);
}

}  // namespace motionrack::rack
