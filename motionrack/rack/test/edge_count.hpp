// Edges of wires in a recording against the counters of the cards that generate or count them, over random moves with
// random ends.
//
//   card           wires of the recording      counter
//   mcx314         xpp, xpm; both kinds        x.LP
//   databoard4002  fout, sign                  POSITION
//   grating_bus    frame_done                  FRAMES
//
// The edges of out0 .. out31 (IOFLEX02), laser_on and busy (RTC5), int, rst and relay (DataBoard 4002), out0 .. out7
// and drive (MCX314) have no counter; registers show their levels.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/recorder.hpp>
#include <motionrack/rack/test/drawn.hpp>
#include <string>
#include <tests/environment.hpp>
#include <tests/goes_on.hpp>
#include <vector>

namespace motionrack::rack {

/// How two recorded wires encode pulses and their direction.
enum class Wires {
    both_ways,         ///< first wire: pulses forwards; second wire: pulses backwards
    low_is_forwards,   ///< first wire: pulses; second wire: direction, low is forwards
    high_is_forwards,  ///< first wire: pulses; second wire: direction, high is forwards
    tracks,            ///< A and B of an encoder
};

struct EdgesSeen {
    std::int64_t count = 0;              ///< position: forward minus backward
    std::int64_t first = 0, second = 0;  ///< edges of each wire
};

/// Adds up the edges of two wires.
class EdgeCount final : public ChangeSink {
  public:
    EdgeCount(EdgesSeen& seen, Wires wires, std::size_t first, const std::vector<Channel>& channels)
        : seen_(seen), wires_(wires), first_(first) {
        is_first_high_ = channels[first].initial != 0;
        is_second_high_ = channels[1 - first].initial != 0;
    }
    void change(std::size_t index, std::int64_t value, Instant) override {
        const bool is_first = index == first_, is_high = value != 0;
        bool& level = is_first ? is_first_high_ : is_second_high_;
        if (level == is_high) return;
        level = is_high;
        ++(is_first ? seen_.first : seen_.second);
        seen_.count += step(is_first, is_high);
    }

  private:
    int step(bool is_first, bool is_high) const {
        // Forwards, A leads B.
        if (wires_ == Wires::tracks) return (is_first_high_ != is_second_high_) == is_first ? 1 : -1;
        if (!is_high) return 0;
        if (wires_ == Wires::both_ways) return is_first ? 1 : -1;
        if (!is_first) return 0;
        return is_second_high_ == (wires_ == Wires::high_is_forwards) ? 1 : -1;
    }

    EdgesSeen& seen_;
    Wires wires_;
    std::size_t first_;
    bool is_first_high_, is_second_high_;
};

/// A rack with two recorded wires; its first card drives.
class Counted {
  public:
    Counted(const std::string& text, const std::string& first, const std::string& second, Wires wires)
        : rack(*read_rack_text(text).config), tap(rack.kernel()) {
        rack.start();
        RecorderSettings settings;
        settings.signals = {first, second};
        settings.tap = &tap;
        settings.sink = [&](const Declaration& declared) {
            EXPECT_EQ(declared.channels.size(), 2u);
            const std::size_t at = declared.channels[0].name == first ? 0 : 1;
            return std::make_shared<EdgeCount>(seen, wires, at, declared.channels);
        };
        recorder = std::move(*Recorder::create(rack, settings));
    }
    Card& card() { return *rack.cards()[0]; }
    void pass(Duration time) {
        card().host().pass(time);
        recorder->drain();
    }
    std::int64_t value(const std::string& name) { return *card().inspect(name); }
    std::int64_t value(const char* of, const std::string& name) { return *rack.card(of)->inspect(name); }

    Rack rack;
    RecorderTap tap;
    EdgesSeen seen;
    std::unique_ptr<Recorder> recorder;
};

/// Moves one axis of an MCX314, the first card of a rack, by its registers.
class Mcx314Moves {
  public:
    /// `wr2`: value of the axis' register WR2.
    Mcx314Moves(Counted& bench, char axis, std::uint32_t wr2, std::int64_t max_speed, std::int64_t max_pulses)
        : bench_(bench),
          axis_(std::string("xyzu").find(axis)),
          name_(std::string(1, axis) + "."),
          max_speed_(max_speed),
          max_pulses_(max_pulses) {
        write(0, select() | 0x0F);
        write(0x04, wr2);
    }
    /// Drives with random numbers, possibly with a stop, until the axis is at standstill.
    void make(Random& random) {
        command(0x00, drawn(random, 16'000, 800'000));
        command(0x02, drawn(random, 50, 8'000));
        command(0x04, drawn(random, 1, 300));
        command(0x05, drawn(random, 1, max_speed_));
        command(0x06, drawn(random, 0, max_pulses_));
        write(0, select() | drawn(random, 0x20, 0x23));
        bench_.pass(microseconds(drawn(random, 1, 3'000)));
        if (drawn(random, 0, 1) != 0) write(0, select() | drawn(random, 0x26, 0x27));
        for (int wait = 0; is_driving() && wait < 400; ++wait) {
            bench_.pass(milliseconds(5));
            if (wait == 20) write(0, select() | 0x27);
        }
        EXPECT_FALSE(is_driving());
        bench_.pass(milliseconds(1));
    }
    std::int64_t value(const char* name) { return bench_.value(name_ + name); }

  private:
    bool is_driving() { return (bench_.value("RR0") >> axis_ & 1) != 0; }
    std::int64_t select() const { return std::int64_t{0x100} << axis_; }
    void write(std::uint32_t at, std::int64_t value) {
        bench_.card().bus_write(16, at, static_cast<std::uint32_t>(value & 0xFFFF));
    }
    void command(unsigned code, std::int64_t value) {
        write(0x0E, value >> 16);
        write(0x0C, value);
        write(0, select() | code);
    }

    Counted& bench_;
    std::size_t axis_;
    std::string name_;
    std::int64_t max_speed_, max_pulses_;
};

/// Returns true if another move follows: `moves` of them, and up to 100 more while none has made a pulse.
inline bool moves_on(std::uint64_t made, std::uint64_t moves, const Counted& bench) {
    return goes_on(made, moves, moves + 100, bench.seen.first != 0);
}

/// Compares the pulses of one axis with its logical position LP.
inline void count_mcx314(std::uint64_t moves, char axis, bool is_one_pulse) {
    Random random(seed_from_environment());
    const std::string pin = std::string("c1.") + axis;
    Counted bench("card.c1 = \"mcx314\"", pin + "pp", pin + "pm",
                  is_one_pulse ? Wires::low_is_forwards : Wires::both_ways);
    Mcx314Moves driving(bench, axis, is_one_pulse ? 0x0040 : 0, 8'000, 400);
    for (std::uint64_t i = 0; moves_on(i, moves, bench); ++i) {
        driving.make(random);
        ASSERT_EQ(bench.seen.count, driving.value("LP")) << "move " << i << " of " << axis;
    }
    EXPECT_NE(bench.seen.first, 0);
}

inline void count_databoard4002(std::uint64_t moves) {
    Random random(seed_from_environment());
    Counted bench("card.c1 = \"databoard4002\"", "c1.fout", "c1.sign", Wires::high_is_forwards);
    const auto out = [&](std::uint32_t port, std::int64_t value) {
        bench.card().bus_write(8, port, static_cast<std::uint32_t>(value & 0xFF));
        bench.pass(microseconds(150));
    };
    const auto command = [&](char letter, std::int64_t value, int bytes) {
        out(3, static_cast<unsigned char>(letter));
        for (int i = 0; i < bytes; ++i) out(0, value >> (8 * i));
    };
    out(1, 13);
    for (std::uint64_t i = 0; moves_on(i, moves, bench); ++i) {
        command('R', drawn(random, 15'000, 16'383), 2);
        command('N', drawn(random, -60, 60), 3);
        command('G', 0, 0);
        bench.pass(microseconds(drawn(random, 1, 20'000)));
        switch (drawn(random, 0, 4)) {
            case 0:
                command('Q', 0, 0);
                break;
            case 1:  // a new command during the move, possibly in the other direction
                command('N', drawn(random, -60, 60), 3);
                command('G', 0, 0);
                break;
            default:
                break;
        }
        for (int wait = 0; bench.value("MOVING") != 0 && wait < 400; ++wait) bench.pass(milliseconds(20));
        bench.pass(milliseconds(25));  // the last pulse has ended
        ASSERT_EQ(bench.seen.count, bench.value("POSITION")) << "move " << i;
    }
    EXPECT_NE(bench.seen.first, 0);
}

/// Compares the pulses of frame_done with the frames published by the card, at random instants and with random claims.
inline void count_grating_bus(std::uint64_t moves, const char* card) {
    Random random(seed_from_environment());
    const std::string name = card;
    Counted bench("card.c1 = \"grating_bus\"\ncard.c2 = \"grating_bus\"\n", name + ".frame_done", name + ".int_n",
                  Wires::both_ways);
    const auto frames = [&] { return bench.value(card, "FRAMES_L") | bench.value(card, "FRAMES_H") << 16; };
    for (std::uint64_t i = 0; moves_on(i, moves, bench); ++i) {
        bench.pass(microseconds(drawn(random, 1, 3'000)));
        if (drawn(random, 0, 1) != 0)  // CLAIM, RELEASE
            bench.rack.card(card)->bus_write(16, 0, static_cast<std::uint32_t>(drawn(random, 1, 2)));
        bench.recorder->drain();
        ASSERT_EQ((bench.seen.first + 1) / 2, frames()) << "instant " << i << " of " << card;
    }
    EXPECT_NE(bench.seen.first, 0);
}

}  // namespace motionrack::rack
