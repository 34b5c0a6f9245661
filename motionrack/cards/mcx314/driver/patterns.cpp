// Bit patterns: the host stacks 16 steps per word, three words ahead; and interpolation step by step.
//
//   36h  WR2..WR7 become BP1P BP1M BP2P BP2M BP3P BP3M      38h  stacks them
//   34h, 35h  start      RR0 BPSC: words on the stack, 3: full         37h  WR2..WR7 are themselves again
#include <fmt/format.h>

#include <motionrack/cards/mcx314/driver/checks.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr int stack_size = 3;
constexpr Duration poll_period_of_patterns = microseconds(20);
constexpr std::array<std::uint32_t, 3> plus_registers = {register_named(map::registers, "BP1P").offset,
                                                         register_named(map::registers, "BP2P").offset,
                                                         register_named(map::registers, "BP3P").offset};
constexpr std::array<std::uint32_t, 3> minus_registers = {register_named(map::registers, "BP1M").offset,
                                                          register_named(map::registers, "BP2M").offset,
                                                          register_named(map::registers, "BP3M").offset};

}  // namespace

Result<void> Driver::BP2D(const BPDATA& data, unsigned axes) {
    return begin_pattern("BP2D", data, axes, 2);
}
Result<void> Driver::BP3D(const BPDATA& data, unsigned axes) {
    return begin_pattern("BP3D", data, axes, 3);
}

Result<void> Driver::begin_pattern(const char* who, const BPDATA& data, unsigned axes, int count) {
    MOTIONRACK_CHECK(check_count(who, axes, count));
    const ChannelList list = channels_of(axes);
    const int first = list.channel[0];
    const unsigned own = 1u << first;
    const Speeds speeds{data.A == 0 ? Curve::constant : Curve::t, data.SV, data.V, data.A, 0, 0};
    MOTIONRACK_CHECK(check_speeds(own, speeds));
    if (data.A != 0) MOTIONRACK_CHECK(check(own, param::DP, data.DecPoint));
    MOTIONRACK_CHECK(check_initialised(own, who));
    MOTIONRACK_CHECK(check_free(axes, who));
    abandon_path();
    own_range_again(own);
    put_speeds(own, speeds);
    CurveData curve;
    if (data.A != 0) curve.dec_point = data.DecPoint;
    put_deceleration(first, curve);
    EnableDeceleration(data.A != 0);
    unsigned word = field("WR5", "AX1").set(path_mode_, static_cast<unsigned>(first));
    word = field("WR5", "AX2").set(word, static_cast<unsigned>(list.channel[1]));
    word = field("WR5", "AX3").set(word, count > 2 ? static_cast<unsigned>(list.channel[2]) : 0);
    write_path_mode(field("WR5", "LSPD").set(word, 0));
    path_axes_ = axes;
    pieces_ = {};
    command(0, cmd::BP_CLEAR);
    command(0, cmd::BP_ENABLE);
    pattern_ = {axes, count, 0, false};
    return {};
}

Result<void> Driver::BPStack(const BPWORD& word, Duration timeout) {
    if (pattern_.axes == 0)
        return fail(ErrorKind::refused, "BPStack: no pattern is open. Nothing was written. Call BP2D or BP3D first.");
    const Instant end = later(interrupt_.now(), timeout);
    while (true) {
        const MainStatus main = status();
        if (pattern_.running && !main.driving(pattern_.axes)) {
            const unsigned axes = pattern_.axes;
            close_pattern();
            const std::string why = error_text(axes);
            return fail(ErrorKind::machine,
                        why.empty()
                            ? "The pattern's next word came too late or after its end code: the drive has ended. "
                              "Lower the speed, or stack words earlier."
                            : "The pattern was stopped. " + why);
        }
        if (main.patterns_stacked() < stack_size) break;
        if (!pattern_.running)
            return fail(ErrorKind::refused,
                        "BPStack: the stack holds three words and the drive does not run. Nothing was written. Call "
                        "BPStart.");
        if (interrupt_.stop_requested()) {
            SlowStop(pattern_.axes);
            close_pattern();
            return fail(ErrorKind::stopped, "The pattern was stopped on request.");
        }
        if (interrupt_.now() >= end)
            return fail(
                ErrorKind::machine,
                fmt::format("The pattern's stack had no room for {:.3f} s; nothing was stopped. Wait longer, or stop "
                            "the axes.",
                            to_seconds(timeout)));
        doze(0, poll_period_of_patterns);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(pattern_.count); ++i) {
        port_.write(plus_registers[i], word.plus[i]);
        port_.write(minus_registers[i], word.minus[i]);
    }
    command(0, cmd::BP_STACK);
    ++pattern_.words;
    return {};
}

Result<void> Driver::BPStart() {
    if (pattern_.axes == 0 || pattern_.words == 0)
        return fail(ErrorKind::refused,
                    "BPStart: no pattern with data is open. Nothing was written. Call BP2D or BP3D and BPStack first.");
    if (pattern_.running) return fail(ErrorKind::refused, "BPStart: the pattern runs already. Nothing was written.");
    command(0, pattern_.count == 3 ? cmd::BP3 : cmd::BP2);
    pattern_.running = true;
    return {};
}

Result<void> Driver::BPEnd(Duration timeout) {
    if (pattern_.axes == 0)
        return fail(ErrorKind::refused, "BPEnd: no pattern is open. Nothing was written. Call BP2D or BP3D first.");
    const unsigned axes = pattern_.axes;
    close_pattern();
    return wait_until_done(axes, timeout);
}

/// Ends a chain or a pattern that is open but no longer running.
void Driver::abandon_path() {
    chain_ = {};
    if (pattern_.axes != 0) close_pattern();
}

void Driver::close_pattern() {
    command(0, cmd::BP_DISABLE);
    pattern_ = {};
}

// ---- steps

Result<void> Driver::SetStep(StepBy by) {
    MOTIONRACK_CHECK(check_no_path("SetStep", status()));
    const unsigned word = field("WR5", "CMPLS").set(path_mode_, by == StepBy::command);
    write_path_mode(field("WR5", "EXPLS").set(word, by == StepBy::wire));
    return {};
}

Result<void> Driver::Step() {
    if (!field("WR5", "CMPLS").test(path_mode_))
        return fail(
            ErrorKind::refused,
            "Step: the interpolation does not step by command. Nothing was written. Call SetStep(StepBy::command) "
            "before it starts.");
    command(0, cmd::STEP);
    return {};
}

/// The chip has one interpolator: a new command would be queued, or change the running interpolation.
Result<void> Driver::check_free(unsigned axes, const char* who) {
    const MainStatus main = status();
    MOTIONRACK_CHECK(check_standing(axes, who, main));
    return check_no_path(who, main);
}

}  // namespace motionrack::mcx314
