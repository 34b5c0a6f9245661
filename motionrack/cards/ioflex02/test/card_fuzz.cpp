// The fuzzer of the card.
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <motionrack/cards/ioflex02/driver/flex2pos.hpp>
#include <motionrack/cards/ioflex02/test/card_fuzz.hpp>
#include <motionrack/cards/ioflex02/test/rig.hpp>

namespace motionrack::ioflex02::fuzz {

namespace {

class Run {
  public:
    Run(Feed& feed, Verdict& verdict) : feed_(feed), verdict_(verdict), rig_(settings_from(feed)) {
        rig_.start();
        for (std::size_t i = 0; i < inputs_.size(); ++i)
            inputs_[i] = rig_.kernel.find_wire("c1." + std::string(map::pins[i].name));
        for (std::size_t i = 0; i < outputs_.size(); ++i)
            outputs_[i] = rig_.kernel.find_wire("c1." + std::string(map::pins[32 + i].name));
    }

    void go(std::int64_t accesses) {
        for (std::int64_t i = 0; i < accesses && !feed_.empty() && verdict_.problem.empty(); ++i) {
            something();
            ++verdict_.accesses;
            poll();
            if (i % 64 == 0) look_closer();
        }
        if (verdict_.problem.empty()) still_alive();
        verdict_.seconds += to_seconds(rig_.kernel.now());
    }

  private:
    static Settings settings_from(Feed& feed) {
        Settings out;
        out.preloaded = feed.below(4) != 0;
        constexpr std::array<std::int64_t, 4> us = {0, 7, 130, 2'000'000};
        out.configuration_time = microseconds(us[feed.below(4)]);
        return out;
    }

    // ---- actions
    void something() {
        const std::uint32_t roll = feed_.below(200);
        if (roll < 70) return turn();
        if (roll < 85) return set_wire(feed_.below(32), feed_.below(2) != 0);
        if (roll < 115) return write();
        if (roll < 135) return (void)rig_.port.read(address());
        if (roll < 196) return pass();
        if (roll < 198) return image();
        if (roll == 198) return init();
        capture();
    }
    void turn() {
        const auto axis = static_cast<int>(feed_.below(4));
        const std::uint32_t wild = feed_.word();
        phase_[axis] += wild % 16 == 0 ? wild >> 8 & 3 : (wild >> 4) % 8 ? 1 : -1;
        const int lines = lines_of_phase(phase_[axis]);
        set_wire(static_cast<std::uint32_t>(axis), (lines & 1) != 0);
        set_wire(static_cast<std::uint32_t>(4 + axis), lines >> 1 != 0);
        if (wild & 1) rig_.run(nanoseconds(100 + (wild >> 5)));
    }
    void set_wire(std::uint32_t number, bool level) {
        const sim::WireId wire = inputs_[number];
        // in0 to in15 are also the lines of the axes.
        const bool counts = number < 8 || (number >= 16 && number % 4 < 2);
        const std::uint32_t axis = number < 16 ? number % 4 : (number - 16) / 4;
        if (counts && (rig_.kernel.level(wire) != 0) != level) ++may_count_[axis];
        rig_.kernel.set_wire(wire, level);
        if (feed_.below(2)) rig_.kernel.settle();
    }
    std::uint32_t address() {
        const std::uint32_t wild = feed_.word();
        return wild % 16 ? rig_.base + 2 * ((wild >> 4) % 0x34) : feed_.word();
    }
    void write() {
        const std::uint32_t at = address();
        std::uint32_t value = feed_.word();
        if (at == rig_.base && feed_.below(16)) value &= ~1u;  // CONTROL: otherwise usually no project runs
        rig_.port.write(at, static_cast<std::uint16_t>(value));
        follow();
    }
    void pass() {
        constexpr std::array<std::int64_t, 6> scales = {1, 10, 100, 1'000, 10'000, 10'000'000};
        rig_.run(Duration{static_cast<std::int64_t>(feed_.below(1'000)) * scales[feed_.below(6)]});
        follow();
    }
    void capture() { rig_.capture(static_cast<int>(feed_.below(4))); }

    std::vector<std::uint8_t> some_image() {
        ImageContent content;
        if (feed_.below(4) == 0) content.project = "other";
        content.ident = static_cast<std::uint8_t>(feed_.below(3) ? position_ident : feed_.below(256));
        content.payload.resize(min_payload + feed_.below(40));
        for (std::uint8_t& byte : content.payload)
            byte = static_cast<std::uint8_t>(feed_.below(3) ? 0 : feed_.below(256));
        std::vector<std::uint8_t> raw = *raw_image(content);
        if (feed_.below(3) == 0)
            raw[feed_.below(static_cast<std::uint32_t>(raw.size()))] ^= static_cast<std::uint8_t>(feed_.below(256));
        if (feed_.below(4) == 0) raw.resize(feed_.below(static_cast<std::uint32_t>(raw.size())));
        return raw;
    }
    void image() {
        rig_.feed(some_image(), feed_.below(2) != 0);
        const ArrayState state = rig_.card.array();
        (state == ArrayState::failed ? verdict_.refused : verdict_.images) += 1;
        follow();
    }
    /// Through the function library, from a file with arbitrary content.
    void init() {
        FlexSettings settings;
        settings.image = compressed(some_image());
        if (feed_.below(2)) settings.image[feed_.below(static_cast<std::uint32_t>(settings.image.size()))] ^= 1;
        if (feed_.below(4) == 0)
            for (std::uint8_t& byte : settings.image) byte = static_cast<std::uint8_t>(feed_.below(256));
        settings.start_timeout = milliseconds(3'000);
        Flex2Pos card(rig_.port, rig_.port, settings);
        card.Init(static_cast<std::uint16_t>(feed_.below(8) ? rig_.base : feed_.word()));
        check(card.Result >= Flex_Ok && card.Result <= Flex_ErrProject, "an outcome of Init that is none");
        check(card.why().empty() == card.ok(), "an outcome of Init and its sentence do not agree");
        if (card.ok()) card.read_details();
        (card.ok() ? verdict_.images : verdict_.refused) += 1;
        follow();
    }
    /// Makes the next poll() accept any change of the counts: the card's FPGA project may have restarted, or an axis
    /// may have been zeroed.
    void follow() { rebase_ = true; }

    // ---- invariants
    void check(bool holds, const char* what) {
        if (holds || !verdict_.problem.empty()) return;
        verdict_.problem =
            fmt::format("{} (access {}, {:.7f} s)", what, verdict_.accesses, to_seconds(rig_.kernel.now()));
    }
    void poll() {
        check(rig_.card.time() <= mask_24, "a time of more than 24 bits");
        const bool known = rig_.card.running() && rig_.card.peek(offset("STS")) != no_answer;
        for (int axis = 0; axis < 4; ++axis) {
            const std::int32_t position = rig_.card.position(axis);
            check(position >= -8'388'608 && position <= 8'388'607, "a position of more than 24 bits");
            const std::int64_t raw = rig_.card.raw_count(axis);
            if (!rebase_) {
                // Edges delayed by the filter may count later.
                may_count_[axis] -= std::llabs(raw - last_[axis]);
                check(may_count_[axis] >= 0, "more counts than edges");
                verdict_.counts += std::llabs(raw - last_[axis]);
            }
            last_[axis] = raw;
            verdict_.illegal += rig_.card.illegal(axis) > 0;
            if (known)
                check((rig_.card.peek(offset("STS")) >> axis & 1) ==
                          (rig_.card.calibration(axis) == CalState::calibrated),
                      "a status beside its state");
        }
        rebase_ = false;
        int high = 0, low = 0;
        for (std::size_t i = 0; i < outputs_.size(); ++i) (i < 16 ? low : high) |= rig_.kernel.level(outputs_[i]);
        check(high == 0, "an output of X7 is not 0");
        check(low == 0 || known, "an output is not 0 without a project");
    }
    void look_closer() {
        rig_.kernel.settle();  // a read includes wires set at this instant, a peek does not
        const std::uint64_t before = rig_.kernel.state_hash();
        for (std::uint32_t at = 0; at < window; ++at) words_[at] = rig_.card.peek(at);
        check(rig_.kernel.state_hash() == before, "peek changes the card");
        for (const RegisterInfo& reg : map::registers)
            if (reg.access == Access::read) check(rig_.read(reg.offset) == words_[reg.offset], "peek and read differ");
    }
    void still_alive() {
        for (const sim::WireId wire : inputs_) rig_.kernel.set_wire(wire, 0);
        rig_.feed(*unpacked(position_image()));
        rig_.run(milliseconds(2'001));
        check(rig_.card.running(), "it does not take an image any more");
        for (std::int64_t& phase : rig_.phase) phase = 0;
        for (int axis = 0; axis < 4; ++axis) rig_.turn(axis, 100);
        for (int axis = 0; axis < 4; ++axis) check(position(rig_, axis) == 100, "it does not count any more");
        rig_.write(offset("CMD"), cResNm);
        rig_.pulse("z0");
        check(rig_.card.position(0) == 0 && rig_.card.status(0) == sCal, "it does not calibrate any more");
    }

    Feed& feed_;
    Verdict& verdict_;
    Rig rig_;
    std::array<sim::WireId, 32> inputs_{};
    std::array<sim::WireId, 32> outputs_{};
    std::array<std::uint16_t, window> words_{};
    std::int64_t phase_[4] = {};
    std::int64_t may_count_[4] = {};
    std::int64_t last_[4] = {};  // raw counts
    bool rebase_ = true;
};

}  // namespace

void run(Feed& feed, std::int64_t accesses, Verdict& verdict) {
    Run(feed, verdict).go(accesses);
}

}  // namespace motionrack::ioflex02::fuzz
