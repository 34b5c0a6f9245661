// The edges of a card's outputs, as a recording has them, are the card's counter: whatever the moves, and however they
// end.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/wave_recorder.hpp>
#include <random>
#include <string>
#include <tests/environment.hpp>
#include <vector>

namespace motionrack::rack {
namespace {

using Random = std::mt19937_64;

std::int64_t drawn(Random& random, std::int64_t least, std::int64_t most) {
    return least + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(most - least + 1));
}

/// What the second wire is: of pulses backwards, or the direction, by its level forwards.
enum class Other { backwards, low_is_forwards, high_is_forwards };

/// Adds up the rises of a wire, by the level of the other one; or those of both, forwards and backwards.
class EdgeCount final : public WaveSink {
  public:
    EdgeCount(std::int64_t& count, std::size_t pulses, Other other, bool level)
        : count_(count), pulses_(pulses), other_(other), level_(level) {}
    void change(std::size_t index, std::int64_t value, Instant) override {
        const bool is_high = value != 0;
        if (index != pulses_ && other_ != Other::backwards)
            level_ = is_high;
        else if (is_high)
            count_ += index == pulses_ && is_forwards() ? 1 : -1;
    }
    Result<void> close(Instant) override { return {}; }

  private:
    bool is_forwards() const { return other_ == Other::backwards || level_ == (other_ == Other::high_is_forwards); }

    std::int64_t& count_;
    std::size_t pulses_;
    Other other_;
    bool level_;
};

/// One card in a rack, its two wires recorded.
class Counted {
  public:
    Counted(const std::string& text, const std::string& pulses, const std::string& other, Other means)
        : rack(*read_rack_text(text).config), tap(rack.kernel()) {
        rack.start();
        WaveSettings settings;
        settings.signals = {pulses, other};
        settings.tap = &tap;
        settings.sink = [&](const std::vector<WaveSignal>& signals) {
            EXPECT_EQ(signals.size(), 2u);
            const std::size_t first = signals[0].scope + '.' + signals[0].name == pulses ? 0 : 1;
            return std::make_unique<EdgeCount>(edges, first, means, signals[1 - first].initial != 0);
        };
        recorder = std::move(*WaveRecorder::create(rack, settings));
    }
    Card& card() { return *rack.cards()[0]; }
    void pass(Duration time) {
        card().host().pass(time);
        recorder->drain();
    }
    std::int64_t value(const char* name) { return *card().inspect(name); }

    Rack rack;
    WireTap tap;
    std::int64_t edges = 0;
    std::unique_ptr<WaveRecorder> recorder;
};

std::uint64_t moves() {
    return trials("MOTIONRACK_MOVES", 50, 1000);
}

TEST(EdgesOfOutputs, AreTheCounterOfTheMcx314) {
    for (const bool one_pulse : {false, true}) {
        Random random(seed_from_environment());
        Counted bench("card.c1 = \"mcx314\"", "c1.xpp", "c1.xpm",
                      one_pulse ? Other::low_is_forwards : Other::backwards);
        const auto write = [&](std::uint32_t at, std::int64_t value) {
            bench.card().bus_write(16, at, static_cast<std::uint32_t>(value & 0xFFFF));
        };
        const auto command = [&](unsigned code, std::int64_t value) {
            write(0x0E, value >> 16);
            write(0x0C, value);
            write(0, 0x100 | code);
        };
        write(0, 0x10F);
        write(0x04, one_pulse ? 0x0040 : 0);
        for (std::uint64_t i = 0; i < moves(); ++i) {
            command(0x00, drawn(random, 16'000, 800'000));
            command(0x02, drawn(random, 50, 8'000));
            command(0x04, drawn(random, 1, 300));
            command(0x05, drawn(random, 1, 8'000));
            command(0x06, drawn(random, 0, 400));
            write(0, 0x100 | drawn(random, 0x20, 0x23));
            bench.pass(microseconds(drawn(random, 1, 3'000)));
            if (drawn(random, 0, 1) != 0) write(0, 0x100 | drawn(random, 0x26, 0x27));
            for (int wait = 0; (bench.value("RR0") & 1) != 0 && wait < 400; ++wait) {
                bench.pass(milliseconds(5));
                if (wait == 20) write(0, 0x127);
            }
            bench.pass(milliseconds(1));
            ASSERT_EQ(bench.edges, bench.value("x.LP")) << "move " << i << (one_pulse ? ", one pulse" : "");
        }
        EXPECT_NE(bench.edges, 0);
    }
}

TEST(EdgesOfOutputs, AreTheCounterOfTheDataBoard4002) {
    Random random(seed_from_environment());
    Counted bench("card.c1 = \"databoard4002\"", "c1.fout", "c1.sign", Other::high_is_forwards);
    const auto out = [&](std::uint32_t port, std::int64_t value) {
        bench.card().bus_write(8, port, static_cast<std::uint32_t>(value & 0xFF));
        bench.pass(microseconds(150));
    };
    const auto command = [&](char letter, std::int64_t value, int bytes) {
        out(3, static_cast<unsigned char>(letter));
        for (int i = 0; i < bytes; ++i) out(0, value >> (8 * i));
    };
    out(1, 13);
    for (std::uint64_t i = 0; i < moves(); ++i) {
        command('R', drawn(random, 15'000, 16'383), 2);
        command('N', drawn(random, -60, 60), 3);
        command('G', 0, 0);
        bench.pass(microseconds(drawn(random, 1, 20'000)));
        switch (drawn(random, 0, 4)) {
            case 0:
                command('Q', 0, 0);
                break;
            case 1:  // a new order on the way, perhaps the other way round
                command('N', drawn(random, -60, 60), 3);
                command('G', 0, 0);
                break;
            default:
                break;
        }
        for (int wait = 0; bench.value("MOVING") != 0 && wait < 400; ++wait) bench.pass(milliseconds(20));
        bench.pass(milliseconds(25));  // the last pulse is over
        ASSERT_EQ(bench.edges, bench.value("POSITION")) << "move " << i;
    }
    EXPECT_NE(bench.edges, 0);
}

}  // namespace
}  // namespace motionrack::rack
