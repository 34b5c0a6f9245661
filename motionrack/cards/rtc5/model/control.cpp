// Control commands: settings made between ticks, and answers.
#include <fmt/format.h>

#include <motionrack/cards/rtc5/model/engine.hpp>

namespace motionrack::rtc5 {

void Engine::load_program_file() {
    state_.reset(settings_);
    memory_.clear();
    heads_.clear_tables();
    fly_.load_table(nullptr);
    laser_.switch_off();
}

Result<void> Engine::execute_list(std::uint32_t list, std::int64_t position) {
    MOTIONRACK_TRY(const std::int64_t at, memory_.find_position(list, position));
    return list_.execute_at(at);
}

/// `cause`: bit of the start and stop info.
void Engine::stop(std::uint32_t cause) {
    State& s = state_;
    list_.stop();
    path_.stop();
    s.p = fly_.leave(s.p, heads_.global());
    starts_.stop();
    laser_.switch_off();
    recorder_.stop();
    flags_.raise_startstop(cause);
}

void Engine::pause_list() {
    if (list_.pause()) laser_.switch_now(false);
}

void Engine::restart_list() {
    if (list_.restart()) laser_.switch_now(true);
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
    starts_.set_delay(delay, encoder);
    return {};
}

void Engine::encoder_sequence_error(int encoder) {
    flags_.raise(encoder == 0 ? marking_bit("ENCODER_X_SEQUENCE") : marking_bit("ENCODER_Y_SEQUENCE"), state_.tick);
}

std::uint32_t Engine::startstop_info() const {
    return flags_.startstop_info() | startstop_bit("NO_STOP_SIGNAL") |
           (state_.laser.disabled ? 0 : startstop_bit("LASER_ENABLED"));
}

std::uint32_t Engine::get_startstop_info() {
    const std::uint32_t out = startstop_info();
    flags_.clear_startstop_info();
    return out;
}

}  // namespace motionrack::rtc5
