// The fuzzer of the card.
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <motionrack/cards/databoard4002/test/card_fuzz.hpp>
#include <motionrack/cards/databoard4002/test/host.hpp>

namespace motionrack::databoard4002::fuzz {

namespace {

constexpr std::uint8_t other_select = 14;
constexpr std::int64_t full_circle = std::int64_t{1} << 24;

// Adds up the edges of FOUT.
class Sum final : public sim::EdgeListener {
  public:
    void edges(const sim::EdgeBatch& batch) override { total += batch.step * std::int64_t{batch.size}; }
    std::int64_t total = 0;
};

class Run {
  public:
    Run(Feed& feed, Verdict& verdict)
        : feed_(feed), verdict_(verdict), host_(settings_from(feed)), other_(host_.kernel, "c2") {
        host_.bus.plug(other_, other_select);
        host_.start();
        for (const char* name : {"zero", "ref", "ems", "esr", "esl"}) inputs_[input_count_++] = wire(name);
        lines_ = {wire("o1"), wire("o2")};
        vout_ = wire("vout"), relay_ = wire("relay");
        ems_ = wire("ems"), esr_ = wire("esr"), esl_ = wire("esl");
        host_.kernel.subscribe(wire("fout"), host_.card.id(), feed.below(2) == 0);
        listening_ = feed.below(2) == 0;
        if (listening_) host_.card.pulses().set_edge_listener(&edges_);
    }

    void go(std::int64_t accesses) {
        for (std::int64_t i = 0; i < accesses && !feed_.empty() && verdict_.problem.empty(); ++i) {
            something();
            ++verdict_.accesses;
            poll();
        }
        if (verdict_.problem.empty()) still_alive();
        verdict_.seconds += to_seconds(host_.kernel.now());
    }

  private:
    static Settings settings_from(Feed& feed) {
        Settings settings;
        constexpr std::array<std::int32_t, 4> passes = {1, 1, 7, 400};
        constexpr std::array<std::int64_t, 4> byte_us = {100, 100, 3, 2'000};
        settings.firmware_pass_ticks = passes[feed.below(4)];
        settings.byte_time = microseconds(byte_us[feed.below(4)]);
        settings.zeroing = feed.below(4) != 0;
        return settings;
    }
    sim::WireId wire(const char* pin) { return host_.kernel.find_wire("c1." + std::string(pin)); }
    int level(sim::WireId id) { return host_.kernel.level(id); }
    Duration max_access_time() const {
        const Settings& s = host_.card.settings();
        return s.byte_time + nanoseconds(2'500) * (s.firmware_pass_ticks + 1);
    }

    // ---- actions
    void something() {
        const std::uint32_t roll = feed_.below(100);
        if (roll < 45) return access();
        if (roll < 65) return order();
        if (roll < 90) return pass();
        if (roll < 97) return set_wire(inputs_[feed_.below(5)], feed_.below(3) == 0);
        if (roll < 99) return encoder_lines();
        if (feed_.below(8) == 0) hang();
    }
    std::uint8_t byte() {
        constexpr char letters[] = "ADGILMNOPQRSVWGGGP";
        return static_cast<std::uint8_t>(feed_.below(3) ? letters[feed_.below(sizeof letters - 1)] : feed_.below(256));
    }
    void access() {
        const auto port = static_cast<std::uint8_t>(feed_.below(10) ? feed_.below(8) : feed_.below(256));
        const bool rare = feed_.below(20) == 0;
        if (feed_.below(3) == 0) {
            if (port != ports::RST || rare) in(port);
        } else if ((port != ports::C3 && port != ports::CS) || rare) {
            const std::uint8_t value = byte();
            out(port, port == ports::CS && value == other_select ? std::uint8_t{0} : value);
            if (port == ports::CS && feed_.below(4)) out(ports::CS, select);
        }
    }
    /// A command with its arguments as a program sends it, sometimes truncated.
    void order() {
        constexpr char letters[] = "ADLMNNNOPPPQRRRSVWGGG";
        const char code = letters[feed_.below(sizeof letters - 1)];
        const int full = code == 'S' ? 240 : code == 'R' ? 2 : code == 'D' || code == 'N' || code == 'P' ? 3 : 0;
        const int bytes =
            feed_.below(16) == 0 && full > 0 ? static_cast<int>(feed_.below(static_cast<std::uint32_t>(full))) : full;
        out(ports::CS, select);
        run(max_access_time());
        out(ports::C2, static_cast<std::uint8_t>(code));
        for (int i = 0; i < bytes; ++i) {
            run(max_access_time());
            // High bytes for moves that end, and for visible speeds.
            const bool high = (full == 3 && i == 2) || (full == 2 && i == 1) || (full == 240 && i % 5 == 1);
            const std::uint32_t wild = feed_.word();
            const std::uint32_t plausible = full == 3 ? (wild & 1 ? 0xFFu : 0u) : 0x3Fu;
            out(ports::DATA, static_cast<std::uint8_t>(high && wild % 8 ? plausible : wild >> 4));
        }
    }
    void pass() {
        constexpr std::array<std::int64_t, 6> scales = {10, 100, 1'000, 10'000, 10'000, 100'000};
        run(Duration{static_cast<std::int64_t>(feed_.below(1'000)) * scales[feed_.below(6)]});
    }
    void set_wire(sim::WireId id, bool active) {
        host_.kernel.set_wire(id, active);
        host_.kernel.settle();
    }
    /// Disconnects the encoder, drives its lines from outside and, sooner or later, releases them.
    void encoder_lines() {
        if (!taken_ || feed_.below(8) == 0) {
            take_encoder(!taken_);
        } else {
            host_.kernel.force(lines_[feed_.below(2)], feed_.below(2) != 0);
            host_.kernel.settle();
            ++may_count_;
        }
    }
    void take_encoder(bool taken) {
        taken_ = taken;
        host_.card.take_encoder(taken);
        host_.kernel.settle();
        may_count_ = 0;
        rebase();
    }
    void hang() {
        if (!host_.card.hung()) hung_at_ = host_.kernel.now();
        host_.card.fault("watchdog.hang", 1, host_.kernel.now());
    }

    // ---- execution, and the permitted reactions of the card
    void run(Duration time) {
        const bool hung = host_.card.hung();
        host_.run(time);
        if (!hung) return;
        const Duration since = host_.kernel.now() - hung_at_;
        if (host_.card.hung()) {
            check(since <= whole_seconds(1), "the watchdog has not ended a hang after 1 s");
        } else {
            check(since + max_access_time() >= whole_seconds(1), "a hang ended before the watchdog's second");
            ++verdict_.watchdogs;
            was_reset();
        }
    }
    void in(std::uint8_t port) {
        host_.port.in(port);
        if (port == ports::RST) reset_by_host();
    }
    void out(std::uint8_t port, std::uint8_t value) {
        if (port == ports::CS) chosen_ = value == select;
        if (chosen_ && (host_.card.peek(ports::STAT) & stat::READY)) taken(port, value);
        host_.port.out(port, value);
        if (port == ports::C3 && chosen_) reset_by_host();
    }
    /// Records that the card will process that access.
    void taken(std::uint8_t port, std::uint8_t value) {
        if (port == ports::C2 && value == 'G') went_ = true;
        const bool arms =
            port == ports::C4 && host_.card.settings().zeroing && (value & (event::ZERO | event::REF)) != 0;
        if (port == ports::C4) arms_ = arms, armed_ = armed_ || arms;
        if ((port == ports::C2 && value == 'A') || port == ports::C4) {
            loose_ = true;
            loose_until_ = host_.kernel.now() + max_access_time();
        }
    }
    void reset_by_host() {
        ++verdict_.resets;
        was_reset();
        check((host_.card.peek(ports::STAT) & stat::READY) != 0, "not Ready after a reset");
    }
    void was_reset() {
        went_ = false;
        check(level(vout_) == 0 && level(relay_) == 0, "the output is not 0 V with an open relay after a reset");
        check(host_.card.fout_hz() == 0, "pulses after a reset");
        arms_ = armed_ = loose_ = false;
        still_at_ = pulses();
        rebase();
    }

    // ---- invariants
    void check(bool holds, const char* what) {
        if (holds || !verdict_.problem.empty()) return;
        verdict_.problem =
            fmt::format("{} (access {}, {:.7f} s)", what, verdict_.accesses, to_seconds(host_.kernel.now()));
    }
    std::int64_t pulses() { return host_.card.pulses().count(host_.kernel.now()); }
    void rebase() {
        counter_ = host_.card.position();
        offset_ = counter_ - pulses();
    }
    void poll() {
        verdict_.pulses += std::abs(pulses() - last_pulses_);
        last_pulses_ = pulses();
        look_at_outputs();
        look_at_counter();
        if (!went_) {
            check(!host_.card.moving(), "it moves though there was no G");
            check(level(vout_) == 0 && host_.card.fout_hz() == 0, "an output though there was no G");
            check(pulses() == still_at_, "pulses though there was no G");
        }
        check(!other_.moving() && other_.position() == 0, "the other card of the bus listens");
        if (verdict_.accesses % 64 == 0) look_closer();
    }
    void look_at_outputs() {
        const int volts = level(vout_);
        check(std::abs(volts) <= 10'000'000, "more than 10 V");
        check(level(relay_) != 0 || volts == 0, "volts behind an open relay");
        check(level(ems_) == 0 || (volts == 0 && level(relay_) == 0), "volts in an emergency stop");
        check(level(esr_) == 0 || volts <= 0, "volts into the right end stop");
        check(level(esl_) == 0 || volts >= 0, "volts into the left end stop");
    }
    void look_at_counter() {
        if (loose_ || armed_) {
            if (host_.kernel.now() > loose_until_ && !host_.card.hung()) {  // the access was processed
                loose_ = false;
                armed_ = arms_;
            }
            return rebase();
        }
        const std::int64_t position = host_.card.position();
        if (taken_) return check(std::abs(position - counter_) <= may_count_, "more counts than changes of the lines");
        check((position - pulses() - offset_) % full_circle == 0, "the counter is not the pulses since it was zeroed");
    }
    void look_closer() {
        const std::uint64_t before = host_.kernel.state_hash();
        for (int port = 0; port < 8; ++port) (void)host_.card.peek(static_cast<std::uint8_t>(port));
        check(host_.kernel.state_hash() == before, "peek changes the card");
        host_.card.pulses().deliver_edges();
        if (listening_) check(edges_.total == pulses(), "edges and pulses differ");
        if (host_.card.hung()) return;
        run(max_access_time());
        check((host_.card.peek(ports::STAT) & stat::READY) != 0, "Ready does not return");
    }
    void still_alive() {
        run(milliseconds(1'020));
        check(!host_.card.hung(), "a hang without end");
        for (const sim::WireId id : inputs_) set_wire(id, false);
        if (taken_) take_encoder(false);
        out(ports::CS, select);
        out(ports::C3, 0);
        host_.command('R', 16'344, 2);
        host_.command('N', 100, 3);
        host_.command('G');
        host_.run(milliseconds(30));
        check(host_.card.position() == 100, "it does not go where it is told any more");
    }

    Feed& feed_;
    Verdict& verdict_;
    Host host_;
    Card other_;
    Sum edges_;
    std::array<sim::WireId, 5> inputs_{};
    std::size_t input_count_ = 0;
    std::array<sim::WireId, 2> lines_{};
    sim::WireId vout_{}, relay_{}, ems_{}, esr_{}, esl_{};
    Instant hung_at_{};
    Instant loose_until_{};
    bool listening_ = false;
    bool chosen_ = true;
    bool went_ = false;   // a G was accepted since the last reset
    bool arms_ = false;   // the last C4 arms the zeroing
    bool armed_ = false;  // zero pulse or reference may zero the counter
    bool loose_ = false;  // A or C4 is in progress, which may also zero the counter
    bool taken_ = false;  // the encoder is disconnected
    std::int64_t counter_ = 0, offset_ = 0, still_at_ = 0, may_count_ = 0, last_pulses_ = 0;
};

}  // namespace

void run(Feed& feed, std::int64_t accesses, Verdict& verdict) {
    Run(feed, verdict).go(accesses);
}

}  // namespace motionrack::databoard4002::fuzz
