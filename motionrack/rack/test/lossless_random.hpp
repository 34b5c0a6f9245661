// Random programs in chords from 2 um to 50 mm, with arcs and probing moves, on several racks, in both profiles.
// Requests hold, slow, resume and stop them at random instants: no axis has a velocity step, and the end is correct.
#pragma once

#include <algorithm>
#include <functional>
#include <motionrack/rack/mcx314_card.hpp>
#include <motionrack/rack/test/lossless_support.hpp>
#include <random>

namespace motionrack::rack {

/// Random numbers that are the same on every machine.
class Chance {
  public:
    explicit Chance(std::uint64_t seed) : random_(seed) {}
    int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    double number(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
    }
    double even_on_log(double low, double high) { return std::exp(number(std::log(low), std::log(high))); }

  private:
    std::mt19937_64 random_;
};

/// The probe triggers at and below this height; programs are above it, except for their probing moves.
inline constexpr double probe_height = 60, program_height = 75;

enum class Arcs { none, some };

/// Makes paths of straight moves: smooth curves, sharp corners and reversals, each in chords of one length or of many.
/// With arcs, half of the programs have sequences of arcs and helices between them.
class ChordMaker : public Chance {
  public:
    explicit ChordMaker(std::uint64_t seed, Arcs arcs = Arcs::none)
        : Chance(seed),
          probing_(~seed),
          probes_(probing_.pick(4) == 0),
          ramps_(seed ^ 0x7a4d),
          arcs_(seed ^ 0xa4c5),
          has_arcs_(arcs == Arcs::some && arcs_.pick(2) == 0) {}

    struct Program {
        std::string text;
        double x = 150, y = 100;
        double seconds = 0;  ///< approximate minimum duration of its chords
    };

    Program make() {
        out_ = {};
        out_.text = fmt::format("G21 G90 G17 {}\nG0 X150 Y100 Z75\nG1 F{:.0f}\n",
                                std::array{"G64 P0.01", "G64 P0.05", "G64 P0.002", "G61"}[pick(4)], feed());
        heading_ = number(-3, 3);
        const int stretches = 1 + pick(4);
        for (int i = 0; i < stretches; ++i) {
            if (probes_ && probing_.pick(2) == 0) add_probing();
            add_stretch();
            if (has_arcs_ && arcs_.pick(3) > 0) add_arcs();
        }
        out_.text += "M2\n";
        return out_;
    }

    bool probes() const { return probes_; }

  private:
    double feed() { return even_on_log(300, 9000); }

    /// Adds a probing move down, straight or inclined, with or without contact; then perhaps one up until release; and
    /// a move up.
    void add_probing() {
        const double feed = probing_.even_on_log(100, 5000);
        const bool touches = probing_.pick(3) > 0, slanted = probing_.pick(2) == 0;
        const double end = touches ? probing_.number(50, 58) : probing_.number(61, 70);
        std::string aside;
        if (slanted)
            aside = fmt::format(" X{:.4f} Y{:.4f}", out_.x + probing_.number(-5, 5), out_.y + probing_.number(-5, 5));
        out_.text += fmt::format("G38.3{} Z{:.4f} F{:.0f}\n", aside, end, feed);
        if (touches && probing_.pick(2) == 0)
            out_.text += fmt::format("G38.5 Z{:.4f} F{:.0f}\n", program_height - 1, 0.3 * feed);
        out_.text += fmt::format("G1 X{:.4f} Y{:.4f} Z{:.4f} F{:.0f}\n", out_.x, out_.y, program_height,
                                 probing_.even_on_log(300, 9000));
        out_.seconds += 2 * (program_height - end) / (feed / 60);
    }

    void add_stretch() {
        const double chord = even_on_log(0.002, 50), length = std::min(even_on_log(0.5, 40), 400 * chord);
        const double bend = pick(3) == 0 ? 0 : number(-0.3, 0.3);
        const bool mixed = pick(4) == 0, with_z = pick(3) == 0;
        if (pick(3) == 0) out_.text += fmt::format("F{:.0f}\n", feed());
        if (pick(2) == 0) heading_ += number(-3.2, 3.2);
        // On a ramp, Z moves by less than a pulse per chord, or by more.
        const bool is_ramp = ramps_.pick(3) == 0;
        const double slope = is_ramp ? ramps_.even_on_log(1e-5, 0.1) * (ramps_.pick(2) == 0 ? 1 : -1) : 0;
        double z = 0;
        for (double s = 0; s < length;) {
            // Steps of at most 50 mm stay on the table: a step that starts more than 45 mm from its middle leads
            // towards it.
            const double step = std::min(50.0, mixed ? chord * even_on_log(0.1, 3) : chord);
            heading_ += bend * std::min(step, 2.0);
            if (pick(40) == 0) heading_ += number(-3.2, 3.2);
            // Turns towards the middle of the table where its distance is above 45 mm.
            if (std::hypot(out_.x - 150, out_.y - 100) > 45) heading_ = std::atan2(100 - out_.y, 150 - out_.x);
            out_.x = rounded(out_.x + step * std::cos(heading_));
            out_.y = rounded(out_.y + step * std::sin(heading_));
            if (is_ramp)
                z = std::clamp(z + slope * step, -4.5, 4.5);  // Z 75 is 5 mm below its limit
            else if (with_z)
                z = std::clamp(z + 0.3 * step * number(-1, 1), -3.0, 3.0);
            out_.text += fmt::format("X{:.4f} Y{:.4f}{}\n", out_.x, out_.y,
                                     with_z || is_ramp ? fmt::format(" Z{:.4f}", 75 + z) : "");
            s += step;
        }
        out_.seconds += length / 60;
    }

    /// Adds arcs, most of them tangential to the path before them, some of them helices.
    void add_arcs() {
        const int count = 1 + arcs_.pick(8);
        const bool helices = arcs_.pick(3) == 0;
        if (arcs_.pick(2) == 0) out_.text += fmt::format("F{:.0f}\n", arcs_.even_on_log(300, 9000));
        for (int i = 0; i < count; ++i) {
            if (arcs_.pick(4) == 0) heading_ += arcs_.number(-3.2, 3.2);
            if (std::hypot(out_.x - 150, out_.y - 100) > 45) heading_ = std::atan2(100 - out_.y, 150 - out_.x);
            const double radius = arcs_.even_on_log(0.05, 20), left = arcs_.pick(2) == 0 ? 1 : -1;
            const double sweep = left * std::min(arcs_.even_on_log(0.02, 6), 60 / radius);
            const double across = rounded(-left * radius * std::sin(heading_)),
                         along = rounded(left * radius * std::cos(heading_));
            const double x = out_.x + across, y = out_.y + along;
            out_.x = rounded(x - across * std::cos(sweep) + along * std::sin(sweep));
            out_.y = rounded(y - across * std::sin(sweep) - along * std::cos(sweep));
            out_.text +=
                fmt::format("G{} X{:.4f} Y{:.4f} I{:.4f} J{:.4f}{}\n", left > 0 ? 3 : 2, out_.x, out_.y, across, along,
                            helices ? fmt::format(" Z{:.4f}", program_height + arcs_.number(-2, 2)) : "");
            heading_ += sweep;
            out_.seconds += radius * std::fabs(sweep) / 60;
        }
        out_.text += "G1\n";
    }

    static double rounded(double x) { return std::round(x * 1e4) / 1e4; }

    Chance probing_;
    bool probes_;
    Chance ramps_, arcs_;
    bool has_arcs_;
    Program out_;
    double heading_ = 0;
};

inline RackConfig router_with_probe() {
    std::string text = *rack_template("router");
    text.replace(text.find("\"mcx314\" ", text.find("variant =")), 8, "\"mcx314as\"");
    return *read_rack_text(text + fmt::format("\n[probe]\nz_max_mm = {}\n", probe_height)).config;
}

/// Returns a rack with random microsteps, host latency and bus access time.
inline RackConfig rack_of(ChordMaker& random, const std::string& profile) {
    RackConfig config = random.probes() ? router_with_probe() : router();
    config.controller.profile = profile;
    const auto microsteps = std::array<std::int64_t, 4>{16, 16, 64, 32}[static_cast<std::size_t>(random.pick(4))];
    set_microsteps(config, microsteps);
    Mcx314Settings& card = config.cards[0].settings.edit<Mcx314Settings>();
    card.host_latency_us = std::array<std::int64_t, 4>{50, 0, 20, 200}[static_cast<std::size_t>(random.pick(4))];
    card.bus_access_ns = std::array<std::int64_t, 3>{250, 1'000, 60}[static_cast<std::size_t>(random.pick(3))];
    return config;
}

struct Disturbed {
    Wishes wishes;
    bool stopped = false;
};

inline Disturbed wishes_of(ChordMaker& random, double seconds) {
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

/// Returns the known breaches of random programs in the profile of a rack.
inline test::LimitFactors of_random_profile(const RackConfig& config) {
    return config.jerk_limited() ? test::LimitFactors() : test::known_breaches("random_trapezoids");
}

/// Requests a stop by Ctrl-C or by a flag, in addition to the other requests or in place of a stop command.
inline void ask_stop(Disturbed& disturbed, Chance& chance, double seconds) {
    if (chance.pick(disturbed.stopped ? 2 : 5) > 0) return;
    double at = chance.number(0.001, seconds);
    if (disturbed.stopped) {
        at = disturbed.wishes.back().first;
        disturbed.wishes.pop_back();
    }
    // A job without commands may be stopped by a flag instead; one with commands checks for Ctrl-C itself.
    const bool alone = disturbed.wishes.empty() && chance.pick(2) == 0;
    disturbed.wishes.emplace_back(at, alone ? "flag" : "ctrl-c");
    disturbed.stopped = true;
}

/// Runs the random program of `seed`. MOTIONRACK_SEED=N with MOTIONRACK_PROGRAMS=1 runs only that of seed N.
inline void drive_one(std::uint64_t seed, Arcs arcs = Arcs::none) {
    ChordMaker random(seed, arcs);
    const std::string profile = seed % 2 == 0 ? "trapezoid" : "jerk_limited";
    const ChordMaker::Program program = random.make();
    const RackConfig config = rack_of(random, profile);
    Disturbed disturbed = wishes_of(random, program.seconds + 2);
    Chance stops(seed + 0x5eed);
    ask_stop(disturbed, stops, program.seconds + 2);
    std::string reported;
    for (const auto& [at, what] : disturbed.wishes) reported += fmt::format(" {}@{:.4f}s", what, at);
    SCOPED_TRACE(fmt::format("MOTIONRACK_SEED={} {} microsteps {}, latency {} us, access {} ns, wishes{}", seed,
                             profile, config.axes[0].microsteps, mcx314_in(config.cards[0]).host_latency_us,
                             mcx314_in(config.cards[0]).bus_access_ns, reported));
    const test::LimitFactors known = test::larger_of(test::known_breaches("random_chords"), of_random_profile(config));
    const Driven driven = drive_with(config, program.text, disturbed.wishes, {}, known, known.max_accel);
    test::ReachedFactors::of_program().add("random_chords", {1, driven.worst.parts});
    expect_lossless(driven, known.max_velocity_step);
    if (!disturbed.stopped || driven.outcome.ended) expect_end(driven, program.x, program.y);
}

/// Runs a program on a host that is late at random instants. The axes then stop without a ramp and lose steps, but the
/// card sends each pulse of the program and continues in about the planned time: in at most 1.45 times it, plus the
/// delays and 0.3 s for each.
inline void drive_late(std::uint64_t seed) {
    ChordMaker random(seed, Arcs::some);
    if (random.probes()) return;
    const std::string profile = seed % 2 == 0 ? "trapezoid" : "jerk_limited";
    const ChordMaker::Program program = random.make();
    RackConfig config = rack_of(random, profile);
    for (RackAxis& axis : config.axes) axis.following_error_alarm = 0;
    const double undisturbed =
        to_seconds(drive_with(config, program.text, {}, {}, of_random_profile(config)).outcome.time);
    Chance late(seed + 0x1a7e);
    std::vector<std::pair<double, double>> waits(static_cast<std::size_t>(1 + late.pick(4)));
    double waited = 0;
    for (auto& [at, length] : waits) {
        at = late.number(0.1, undisturbed);
        length = late.even_on_log(0.001, 0.05);
        waited += length + 0.3;
    }
    std::sort(waits.begin(), waits.end());
    std::string reported;
    for (const auto& [at, length] : waits) reported += fmt::format(" {:.4f} s at {:.4f} s", length, at);
    SCOPED_TRACE(fmt::format("MOTIONRACK_SEED={} {} latency {} us, access {} ns, late{}", seed, profile,
                             mcx314_in(config.cards[0]).host_latency_us, mcx314_in(config.cards[0]).bus_access_ns,
                             reported));
    std::size_t next = 0;
    const auto be_late = [&](Rack& rack) {
        if (next == waits.size() || to_seconds(rack.kernel().now()) < waits[next].first) return;
        rack.cards().front()->host().pass(from_seconds(waits[next++].second));
    };
    const Driven driven = drive_with(config, program.text, {}, be_late,
                                     test::larger_of(test::known_breaches("late_host"), of_random_profile(config)));
    test::ReachedFactors::of_program().add("late_host", {1, driven.worst.parts});
    expect_end(driven, program.x, program.y);
    EXPECT_LT(to_seconds(driven.outcome.time), 1.45 * undisturbed + waited);
    for (const AxisOutcome& axis : driven.outcome.axes) {
        EXPECT_EQ(axis.pulses_net, axis.pulse_position - axis.pulse_start);
        EXPECT_LE(axis.top.peak_velocity, 1.01 * axis.limits.max_velocity) << "axis " << axis.index;
    }
}

/// Runs a share of the programs, so that several processes can divide them: every `shares`th from `share`, up to the
/// first failure.
inline void drive_share(std::uint64_t share, std::uint64_t shares, std::uint64_t otherwise,
                        const std::function<void(std::uint64_t seed)>& drive) {
    const std::uint64_t first = seed_from_environment(), count = cases("MOTIONRACK_PROGRAMS", otherwise);
    for (std::uint64_t i = share; i < count && !testing::Test::HasFailure(); i += shares) drive(first + i);
}
inline void drive_disturbed(std::uint64_t seed) {
    drive_one(seed, Arcs::some);
}

}  // namespace motionrack::rack
