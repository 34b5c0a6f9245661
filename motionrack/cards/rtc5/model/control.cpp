// Executes control commands, which change settings between ticks, and answers queries.
#include <fmt/format.h>

#include <motionrack/cards/rtc5/model/engine.hpp>

namespace motionrack::rtc5 {

void Engine::load_program_file() {
    state_.reset(settings_);
    parts_.lists.clear();
    parts_.heads.clear_tables();
    parts_.fly.load_table(nullptr);
    parts_.laser.switch_off();
}

Result<void> Engine::execute_list(std::uint32_t list, std::int64_t position) {
    MOTIONRACK_TRY(const std::int64_t at, parts_.lists.find_position(list, position));
    return parts_.execution.execute_at(at);
}

/// Stops lists, motion, correction, pending starts, laser and recording. `cause`: the bit to set in the start and stop
/// info.
void Engine::stop(std::uint32_t cause) {
    State& s = state_;
    parts_.execution.stop();
    parts_.path.stop();
    s.p = parts_.fly.leave(s.p, parts_.heads.global());
    parts_.starts.stop();
    parts_.laser.switch_off();
    parts_.recorder.stop();
    parts_.flags.raise_startstop(cause);
}

void Engine::pause_list() {
    if (parts_.execution.pause()) parts_.laser.switch_now(false);
}

void Engine::restart_list() {
    if (parts_.execution.restart()) parts_.laser.switch_now(true);
}

Result<void> Engine::goto_xy(double x, double y) {
    if (state_.lists.running || state_.activity.kind != ActivityKind::none)
        return fail(ErrorKind::refused,
                    "goto_xy: a list is running, or the card moves. Nothing was moved. Wait until it is not busy");
    MOTIONRACK_TRY(const Command jump, list_command(Op::jump_abs, {x, y}));
    interpreter_.jump_to({jump.p[0], jump.p[1]});
    state_.lists.moving_alone = 1;
    return {};
}

Result<void> Engine::set_ext_start_delay(std::int32_t delay, int encoder) {
    if (encoder < 0 || encoder >= encoder_count)
        return fail(ErrorKind::refused,
                    fmt::format("set_ext_start_delay: encoder {} must be 0 or 1. Nothing was changed", encoder));
    parts_.starts.set_delay(delay, encoder);
    return {};
}

std::uint32_t Engine::startstop_info() const {
    return parts_.flags.startstop_info() | startstop_bit("NO_STOP_SIGNAL") |
           (state_.laser.disabled ? 0 : startstop_bit("LASER_ENABLED"));
}

std::uint32_t Engine::get_startstop_info() {
    const std::uint32_t out = startstop_info();
    parts_.flags.clear_startstop_info();
    return out;
}

}  // namespace motionrack::rtc5
