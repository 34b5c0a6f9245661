// Fuzzes the chip and checks the invariants.
#include <fmt/format.h>

#include <motionrack/cards/mcx314/test/chip_fuzz.hpp>
#include <motionrack/cards/mcx314/test/chip_fuzz_shadow.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::mcx314::fuzz {

namespace {

constexpr int axis_count = 4;
constexpr const char* input_names[] = {"in0", "in1", "in2", "in3", "expp", "expm", "inpos", "alarm", "lmtp", "lmtm"};

// Adds up the edges of one axis.
class Sum final : public sim::EdgeListener {
  public:
    void edges(const sim::EdgeBatch& batch) override { total += batch.step * std::int64_t{batch.size}; }
    std::int64_t total = 0;
};

// A fixed drive started by a command, and whether something may end it before P.
struct Fixed {
    bool on = false, excused = false, rewritten = false;
    std::int64_t from = 0;
    int direction = 1;
};

class Run {
  public:
    Run(Feed& feed, Verdict& verdict, Variant variant)
        : feed_(feed),
          verdict_(verdict),
          extended_(variant == Variant::mcx314as),
          chip_(kernel_, "c", {variant}),
          shadow_(extended_) {
        for (int a = 0; a < axis_count; ++a)
            for (int i = 0; i < 10; ++i)
                inputs_[a][i] = kernel_.find_wire(std::string("c.") + "xyzu"[a] + input_names[i]);
        common_ = {kernel_.find_wire("c.emgn"), kernel_.find_wire("c.expls_n")};
        kernel_.start();
        for (int a = 0; a < 2; ++a) chip_.pulses(a).set_edge_listener(&edges_[a]);
    }

    void go(std::int64_t accesses) {
        const std::int64_t end = verdict_.accesses + accesses;
        for (int round = 1; verdict_.accesses < end && !feed_.empty() && verdict_.problem.empty(); ++round) {
            something();
            pass();
            if (round % 256 == 0) look_twice();
            if (round % 128 == 0) let_end();
        }
        for (int a = 0; a < axis_count; ++a) verdict_.pulses += chip_.pulses_made(a);
        verdict_.mix(kernel_.trace_hash());
    }

  private:
    // ---- actions
    void something() {
        if (extended_ && feed_.below(12) == 0) return extension();
        const std::uint32_t roll = feed_.below(100);
        if (roll < 4)
            drive();
        else if (roll < 30)
            data();
        else if (roll < 45)
            command(plausible_axes(), plausible_code());
        else if (roll < 55)
            write(2 * feed_.below(8), feed_.word());
        else if (roll < 60)
            mode();
        else if (roll < 66)
            write_byte(feed_.below(16), feed_.word());
        else if (roll < 74)
            pattern();
        else if (roll < 82)
            read(2 * feed_.below(8));
        else if (roll < 86)
            read_byte(feed_.below(16));
        else
            wire();
    }
    // A short fixed drive.
    void drive() {
        const std::uint32_t axes = plausible_axes(), any = feed_.word();
        data_of(axes, 0, 16'000 + any % 8'000);
        data_of(axes, 4, 1'000 + any % 7'000);
        data_of(axes, 5, 1 + feed_.below(8'000));
        data_of(axes, 2, 1'000 + any % 7'000);
        data_of(axes, 6, any % 300);
        command(axes, 0x20 + any % 2);
    }
    void data_of(std::uint32_t axes, std::uint32_t code, std::uint32_t value) {
        write(14, value >> 16);
        write(12, value);
        command(axes, code);
    }
    void data() {
        static constexpr std::uint32_t codes[] = {0, 1, 2, 3, 4, 5, 5, 5, 6, 6, 6, 6, 7, 8, 8, 9, 10, 11, 12, 13};
        const std::uint32_t code = codes[feed_.below(20)];
        data_of(plausible_axes(), code, plausible_value(code));
    }
    std::uint32_t plausible_value(std::uint32_t code) {
        const std::uint32_t any = feed_.word() << 16 | feed_.word();
        if (any % 16 == 0) return feed_.word() << 16 | feed_.word();
        switch (code) {
            case 0:
                return any % 4 ? 16'000 + any / 4 % 64'000 : any % 9'000'000;
            case 1:
                return any % 40;
            case 6:
            case 8:
                return any % 3 ? any / 4 % 300 - (code == 8 || any % 2 ? 150 : 0) : any % 5'000;
            case 7:
            case 13:
                return any % 200;
            case 9:
            case 10:
            case 11:
            case 12:
                return any % 1'000 - 500;
            default:
                return any % 8'200;
        }
    }
    std::uint32_t plausible_axes() { return feed_.below(4) == 0 ? feed_.below(16) : 1u << feed_.below(4); }
    std::uint32_t plausible_code() {
        static constexpr std::uint32_t codes[] = {0x0F, 0x10, 0x12, 0x20, 0x20, 0x20, 0x21, 0x21, 0x22, 0x23,
                                                  0x24, 0x25, 0x26, 0x27, 0x30, 0x30, 0x31, 0x32, 0x33, 0x34,
                                                  0x35, 0x36, 0x37, 0x38, 0x39, 0x3A, 0x3A, 0x3B, 0x3C, 0x3D};
        const std::uint32_t n = feed_.below(31);
        return n < 30 ? codes[n] : feed_.word() & 0xFF;
    }
    void mode() {
        command(plausible_axes(), 0x0F);
        const std::uint32_t bits = feed_.word();
        switch (feed_.below(4)) {
            case 0:
                return write(2, bits & feed_.word() & 0xFFAA & (feed_.below(4) != 0 ? 0xFF00 : 0xFFFF));
            case 1:
                return write(4, bits & feed_.word() & (feed_.below(4) != 0 ? 0xA7E0 : 0xFFFF));
            case 2:
                return write(6, bits & (feed_.below(4) != 0 ? 0x0F87 : 0xFFFF));
            default:
                return write(10, (bits & 0xC300) | (feed_.below(6) == 0 ? bits & 0x1800 : 0) |
                                     (feed_.below(3) != 0 ? 0x24 : bits & 0x3F));
        }
    }
    void pattern() {
        command(0, 0x36);
        for (std::uint32_t i = 0; i < 6; ++i) write(4 + 2 * i, i % 2 ? feed_.word() & 0x1111 : feed_.word() & 0xEEEE);
        command(0, 0x38);
        if (feed_.below(4) != 0) command(0, 0x37);
        if (feed_.below(2) != 0) command(0, 0x34 + feed_.below(2));
    }
    // Commands of the MCX314As. Synchronous actions are rare, because afterwards no drive needs to end at P.
    void extension() {
        static constexpr std::uint32_t codes[] = {0x62, 0x62, 0x62, 0x63, 0x65, 0x14,
                                                  0x61, 0x61, 0x0E, 0x60, 0x60, 0x60};
        const std::uint32_t code = codes[feed_.below(12)], axes = plausible_axes();
        if (feed_.below(40) == 0) return data_of(axes, 0x64, feed_.word() << 16 | (feed_.word() & 0xE3FF));
        if (code != 0x60) return data_of(axes, code, 1 + feed_.word() % 8'000);
        const std::uint32_t filters = feed_.below(3) == 0 ? (feed_.word() & 0x7F00) : 0;
        const std::uint32_t low = feed_.word() & feed_.word() & (feed_.below(4) == 0 ? 0xFFu : 0xEFu);
        const std::uint32_t high = feed_.word() & (feed_.below(4) == 0 ? 0xFFFFu : 0x7EFFu);
        data_of(axes, 0x60, high << 16 | filters | low);
    }
    void wire() {
        const std::uint32_t which = feed_.below(44);
        const sim::WireId id = which >= 40 ? common_[which % 2] : inputs_[which / 10][which % 10];
        const bool asks = which < 40 ? which % 10 == 4 || which % 10 == 5 : which % 2 == 1;  // drive or step inputs
        kernel_.force(id, feed_.below(asks ? 2 : 8) != 0);
        kernel_.settle();
    }
    void pass() {
        static constexpr std::uint32_t max_ticks[] = {1, 4, 1'250, 12'500, 125'000, 1'250'000, 12'500'000, 125'000'000};
        const std::uint32_t roll = feed_.below(256);  // usually a few microseconds, sometimes milliseconds
        const std::uint32_t n = roll < 60 ? 0 : roll < 80 ? 1 : roll < 100 ? 2 : roll < 140 ? 3 : roll < 210 ? 4 : 5;
        const std::uint32_t length = max_ticks[roll == 255 ? 7 : roll >= 252 ? 6 : n];
        run_for(Duration{std::int64_t{feed_.word()} * length / 65'536});
    }
    void run_for(Duration time) {
        const Instant until = kernel_.now() + time;
        while (kernel_.run_until(until) == sim::RunEnd::broken) continue;
        check();
    }

    // ---- accesses
    void command(std::uint32_t axes, std::uint32_t code) { write(0, axes << 8 | code); }
    void write(std::uint32_t offset, std::uint32_t value) {
        access([&] { chip_.write(offset, static_cast<std::uint16_t>(value)); },
               shadow_.write(offset, static_cast<std::uint16_t>(value), 0xFFFF));
    }
    void write_byte(std::uint32_t port, std::uint32_t value) {
        access([&] { chip_.write_byte(port, static_cast<std::uint8_t>(value)); },
               shadow_.write_byte(port, static_cast<std::uint8_t>(value)));
    }
    void read(std::uint32_t offset) {
        const std::uint16_t peeked = chip_.peek(offset), value = chip_.read(offset);
        after_read(peeked == value, value);
    }
    void read_byte(std::uint32_t port) {
        const unsigned peeked = chip_.peek(port & ~1u) >> (8 * (port & 1u)) & 0xFFu, value = chip_.read_byte(port);
        after_read(peeked == value, value);
    }
    void after_read(bool as_peeked, unsigned value) {
        ++verdict_.accesses;
        verdict_.mix(value);
        kernel_.settle();
        require(as_peeked, "a read shows something else than a peek");
        check();
    }
    template <class Do>
    void access(const Do& act, const Effect& effect) {
        ++verdict_.accesses;
        const unsigned drove = driving();
        foresee(effect, drove);
        act();
        kernel_.settle();
        for (int a = 0; a < axis_count; ++a)
            if (effect.writes_lp >> a & 1u) base_[a] = static_cast<std::uint32_t>(chip_.lp(a)) - count_of(a);
        for (int a = 0; a < axis_count; ++a)
            if (effect.fixed_direction != 0 && (effect.axes & ~drove & driving() & ~shadow_.external) >> a & 1u)
                fixed_[a] = {true, ((shadow_.software_limits | shadow_.unknown) >> a & 1u) != 0, false,
                             chip_.pulses(a).count(kernel_.now()), effect.fixed_direction};
        check();
    }
    /// Records the effect of the next access on the running fixed drives.
    void foresee(const Effect& effect, unsigned drove) {
        for (int a = 0; a < axis_count; ++a) {
            Fixed& fixed = fixed_[a];
            if ((effect.stops | shadow_.software_limits | (shadow_.acts != 0 ? 15u : 0u)) >> a & 1u)
                fixed.excused = true;
            if (effect.writes_p >> a & 1u) fixed.rewritten = true;
            // A drive may have ended and wait for in-position, so the effect may belong to it or to the next drive.
            const bool may_follow = (shadow_.in_position & drove & (effect.begins ? 15u : effect.writes_p)) >> a & 1u;
            if (may_follow || (shadow_.external >> a & 1u)) fixed.on = false;
        }
    }

    // ---- invariants
    unsigned driving() const { return chip_.peek(0) & 0xFu; }
    std::uint32_t count_of(int a) { return static_cast<std::uint32_t>(chip_.pulses(a).count(kernel_.now())); }

    void require(bool holds, const std::string& what, int axis = -1) {
        if (holds || !verdict_.problem.empty()) return;
        verdict_.problem =
            fmt::format("{}{}; access {}, tick {}", what, axis < 0 ? "" : fmt::format(" ({})", "XYZU"[axis]),
                        verdict_.accesses, kernel_.now() / nanoseconds(125));
    }

    void check() {
        const unsigned status = chip_.peek(0);
        verdict_.mix(status);
        const bool path = (status & 0x0100u) != 0;
        require(path || (status & 0x1E00u) == 0, "CNEXT or ZONE without an interpolation");
        for (int a = 0; a < axis_count; ++a) {
            verdict_.mix(count_of(a));
            if ((shadow_.recounted | (shadow_.acts != 0 ? 15u : 0u)) >> a & 1u)
                base_[a] = static_cast<std::uint32_t>(chip_.lp(a)) - count_of(a);
            require(static_cast<std::uint32_t>(chip_.lp(a)) == base_[a] + count_of(a),
                    "LP and the pulses do not add up", a);
            if (fixed_[a].on && !(status >> a & 1u)) end_fixed(a);
        }
        for (int a = 0; a < 2; ++a) {
            chip_.pulses(a).deliver_edges();
            require(static_cast<std::uint32_t>(edges_[a].total) == count_of(a), "edges and counts do not add up", a);
        }
    }
    void end_fixed(int a) {
        Fixed& fixed = fixed_[a];
        fixed.on = false;
        if (fixed.excused) return;
        const std::int64_t made = (chip_.pulses(a).count(kernel_.now()) - fixed.from) * fixed.direction;
        const std::int64_t wanted = shadow_.pulses[a];
        if (made == wanted || (fixed.rewritten && made > wanted)) return void(++verdict_.exact_drives);
        command(1u << a, 0x0F);
        if ((chip_.peek(2) & 0xFF00u) != 0) return;
        require(false,
                fmt::format("a fixed drive ended after {} pulses, not P = {}, with no stop latched", made, wanted), a);
    }
    // Checks that a read of the status registers does not change the future.
    void look_twice() {
        const sim::Snapshot before = kernel_.snapshot();
        const std::array<Sum, 2> edges = edges_;
        std::array<std::uint64_t, 2> hash{};
        for (int sample = 0; sample < 2; ++sample) {
            for (const std::uint32_t offset : {0u, 2u, 4u, 8u, 10u, 12u, 14u})
                if (sample == 1) chip_.read(offset);
            const Instant until = kernel_.now() + microseconds(200);
            while (kernel_.run_until(until) == sim::RunEnd::broken) continue;
            Verdict seen;
            for (int a = 0; a < axis_count; ++a) {
                chip_.write(0, static_cast<std::uint16_t>(0x010Fu << a));
                for (std::uint32_t offset = 0; offset < 16; offset += 2) seen.mix(chip_.peek(offset));
                seen.mix(count_of(a));
            }
            hash[sample] = seen.hash;
            kernel_.restore(before);
        }
        edges_ = edges;
        require(hash[0] == hash[1], "a read of a status register had an effect");
    }
    // Checks that after 27h with all inputs released no axis drives, and that 25h would start no drive.
    void let_end() {
        for (const auto& axis : inputs_)
            for (const sim::WireId input : axis) kernel_.force(input, 1);
        for (const sim::WireId input : common_) kernel_.force(input, 1);
        kernel_.settle();
        command(0, 0x37);
        if (extended_) data_of(15, 0x64, 0), data_of(15, 0x60, 0);
        command(15, 0x0F);
        write(4, 0);
        write(2, 0);
        command(15, 0x27);
        run_for(nanoseconds(125) * 3);
        require((chip_.peek(0) & 0x010Fu) == 0, "something drives after 27h with all inputs released");
        command(15, 0x25);
        run_for(microseconds(100));
        require((chip_.peek(0) & 0x010Fu) == 0, "25h began something that 27h had ended");
    }

    Feed& feed_;
    Verdict& verdict_;
    bool extended_;
    sim::Kernel kernel_;
    Chip chip_;
    Shadow shadow_;
    std::array<std::array<sim::WireId, 10>, axis_count> inputs_{};
    std::array<sim::WireId, 2> common_{};
    std::array<Sum, 2> edges_;
    std::array<std::uint32_t, axis_count> base_{};  // LP minus the pulses counted
    std::array<Fixed, axis_count> fixed_{};
};

}  // namespace

void run(Feed& feed, std::int64_t accesses, Verdict& verdict, Variant variant) {
    Run(feed, verdict, variant).go(accesses);
}

}  // namespace motionrack::mcx314::fuzz
