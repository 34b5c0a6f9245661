// Random programs in chords from 2 um to 50 mm, on some racks, in both profiles, held, slowed, let go on and stopped at
// random instants: no axis jumps, and they end where they should. MOTIONRACK_SEED=N picks the first program,
// MOTIONRACK_PROGRAMS=N how many.
#include <algorithm>
#include <random>

#include "lossless_support.hpp"

namespace motionrack::rack {
namespace {

/// Paths of straight moves: smooth curves, sharp corners and ways back, each in chords of one length or of many.
class ChordMaker {
  public:
    explicit ChordMaker(std::uint64_t seed) : random_(seed) {}

    struct Program {
        std::string text;
        double x = 150, y = 100;
        double seconds = 0;  ///< that its chords take at least, about
    };

    Program make() {
        out_ = {};
        out_.text = fmt::format("G21 G90 G17 {}\nG0 X150 Y100 Z75\nG1 F{:.0f}\n",
                                std::array{"G64 P0.01", "G64 P0.05", "G64 P0.002", "G61"}[pick(4)], feed());
        heading_ = number(-3, 3);
        const int stretches = 1 + pick(4);
        for (int i = 0; i < stretches; ++i) add_stretch();
        out_.text += "M2\n";
        return out_;
    }

    int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    double number(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
    }
    double even_on_log(double low, double high) { return std::exp(number(std::log(low), std::log(high))); }

  private:
    double feed() { return even_on_log(300, 9000); }

    void add_stretch() {
        const double chord = even_on_log(0.002, 50), length = std::min(even_on_log(0.5, 40), 400 * chord);
        const double bend = pick(3) == 0 ? 0 : number(-0.3, 0.3);
        const bool mixed = pick(4) == 0, with_z = pick(3) == 0;
        if (pick(3) == 0) out_.text += fmt::format("F{:.0f}\n", feed());
        if (pick(2) == 0) heading_ += number(-3.2, 3.2);
        double z = 0;
        for (double s = 0; s < length;) {
            // From wherever the way back towards the middle begins it does not lead off the table.
            const double step = std::min(50.0, mixed ? chord * even_on_log(0.1, 3) : chord);
            heading_ += bend * std::min(step, 2.0);
            if (pick(40) == 0) heading_ += number(-3.2, 3.2);
            // Towards the middle where the table would end.
            if (std::hypot(out_.x - 150, out_.y - 100) > 45) heading_ = std::atan2(100 - out_.y, 150 - out_.x);
            out_.x = rounded(out_.x + step * std::cos(heading_));
            out_.y = rounded(out_.y + step * std::sin(heading_));
            if (with_z) z = std::clamp(z + 0.3 * step * number(-1, 1), -3.0, 3.0);
            out_.text +=
                fmt::format("X{:.4f} Y{:.4f}{}\n", out_.x, out_.y, with_z ? fmt::format(" Z{:.4f}", 75 + z) : "");
            s += step;
        }
        out_.seconds += length / 60;
    }
    static double rounded(double x) { return std::round(x * 1e4) / 1e4; }

    std::mt19937_64 random_;
    Program out_;
    double heading_ = 0;
};

/// Racks whose pulses, start speeds and hosts differ.
RackConfig rack_of(ChordMaker& random, const std::string& profile) {
    RackConfig config = router(profile);
    const auto microsteps = std::array<std::int64_t, 4>{16, 16, 64, 32}[static_cast<std::size_t>(random.pick(4))];
    set_microsteps(config, microsteps);
    Mcx314Settings& card = config.cards[0].mcx314;
    card.host_latency_us = std::array<std::int64_t, 4>{50, 0, 20, 200}[static_cast<std::size_t>(random.pick(4))];
    card.bus_access_ns = std::array<std::int64_t, 3>{250, 1'000, 60}[static_cast<std::size_t>(random.pick(3))];
    return config;
}

struct Disturbed {
    Wishes wishes;
    bool stopped = false;
};

Disturbed wishes_of(ChordMaker& random, double seconds) {
    Disturbed out;
    double at = 0;
    const int count = random.pick(6);
    for (int i = 0; i < count; ++i) {
        at += random.number(0.005, 0.6 * seconds + 0.2);
        switch (random.pick(3)) {
            case 0:
                out.wishes.emplace_back(at, fmt::format("feed={:.2f}", random.number(0.1, 2)));
                break;
            default:
                out.wishes.emplace_back(at, "hold");
                at += random.number(0.001, 0.4);
                out.wishes.emplace_back(at, "resume");
        }
    }
    if (random.pick(6) == 0) {
        out.wishes.emplace_back(at + random.number(0.01, seconds + 0.2), "stop");
        out.stopped = true;
    }
    return out;
}

/// On a bend in chords trapezoids take an axis' acceleration up to twice: along the path, and from chord to chord. The
/// other profile shares it out.
constexpr double accel_of_trapezoids = 2;

void drive_one(std::uint64_t seed) {
    ChordMaker random(seed);
    const std::string profile = seed % 2 == 0 ? "trapezoid" : "jerk_limited";
    const ChordMaker::Program program = random.make();
    const RackConfig config = rack_of(random, profile);
    const Disturbed disturbed = wishes_of(random, program.seconds + 2);
    std::string told;
    for (const auto& [at, what] : disturbed.wishes) told += fmt::format(" {}@{:.4f}s", what, at);
    SCOPED_TRACE(fmt::format("MOTIONRACK_SEED={} {} microsteps {}, latency {} us, access {} ns, wishes{}", seed,
                             profile, config.axes[0].microsteps, config.cards[0].mcx314.host_latency_us,
                             config.cards[0].mcx314.bus_access_ns, told));
    const Driven driven =
        drive_with(config, program.text, disturbed.wishes, {}, seed % 2 == 0 ? accel_of_trapezoids : 1);
    expect_lossless(driven, 1.3);
    if (!disturbed.stopped || driven.outcome.ended) expect_end(driven, program.x, program.y);
}

TEST(LosslessAtRandom, NoAxisJumpsWhateverIsWishedOnTheWay) {
    const std::uint64_t first = seed_from_environment(), count = trials("MOTIONRACK_PROGRAMS", 200, 10'000);
    for (std::uint64_t seed = first; seed < first + count && !HasFailure(); ++seed) drive_one(seed);
}

}  // namespace
}  // namespace motionrack::rack
