// The control commands of rtc5sim.h for encoders, starts, McBSP and the laser's signals that are one call of the card.
#include <motionrack/frontends/rtc5sim/calls.hpp>

using namespace motionrack::rtc5sim;
using motionrack::Result;
namespace rtc5 = motionrack::rtc5;

namespace {

/// What online positioning does at present.
struct Online {
    double x = 0, y = 0, turn = 0;
};
Online online(const Card& card) {
    const rtc5::McBsp& m = card.engine.state().mcbsp;
    if (m.online_matrix) return {};
    return {m.online_x ? m.online_scale_x : 0, m.online_y ? m.online_scale_y : 0,
            m.online_rot ? m.online_resolution : 0};
}

}  // namespace

// ---- Encoders and starts
// -----------------------------------------------------------------------------------------------

void n_simulate_encoder(UINT CardNo, UINT EncoderNo) {
    command(__func__, CardNo,
            [&](Card& card) -> Result<void> { return card.engine.simulate_encoder(small(EncoderNo)); });
}
void simulate_encoder(UINT EncoderNo) {
    n_simulate_encoder(selected(), EncoderNo);
}
void n_set_rot_center(UINT CardNo, long X, long Y) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> { return card.engine.set_rot_center(point(X, Y)); });
}
void set_rot_center(long X, long Y) {
    n_set_rot_center(selected(), X, Y);
}
void n_init_fly_2d(UINT CardNo, long OffsetX, long OffsetY) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_TRY(const std::int32_t x, whole32("OffsetX", OffsetX));
        MOTIONRACK_TRY(const std::int32_t y, whole32("OffsetY", OffsetY));
        card.engine.init_fly_2d(x, y);
        return {};
    });
}
void init_fly_2d(long OffsetX, long OffsetY) {
    n_init_fly_2d(selected(), OffsetX, OffsetY);
}
void n_set_encoder_speed_ctrl(UINT CardNo, UINT EncoderNo, double Speed, double Smooth) {
    command(__func__, CardNo,
            [&](Card& card) -> Result<void> { return card.engine.set_encoder_speed(small(EncoderNo), Speed, Smooth); });
}
void set_encoder_speed_ctrl(UINT EncoderNo, double Speed, double Smooth) {
    n_set_encoder_speed_ctrl(selected(), EncoderNo, Speed, Smooth);
}
void n_set_ext_start_delay(UINT CardNo, long Delay, UINT EncoderNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_TRY(const std::int32_t delay, whole32("Delay", Delay));
        return card.engine.set_ext_start_delay(delay, small(EncoderNo));
    });
}
void set_ext_start_delay(long Delay, UINT EncoderNo) {
    n_set_ext_start_delay(selected(), Delay, EncoderNo);
}
void n_simulate_ext_start_ctrl(UINT CardNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        card.engine.external_start();
        return {};
    });
}
void simulate_ext_start_ctrl() {
    n_simulate_ext_start_ctrl(selected());
}
void n_simulate_ext_stop(UINT CardNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        card.engine.external_stop();
        return {};
    });
}
void simulate_ext_stop() {
    n_simulate_ext_stop(selected());
}
UINT n_get_marking_info(UINT CardNo) {
    return question(__func__, CardNo, UINT{},
                    [&](Card& card) -> Result<UINT> { return card.engine.get_marking_info(); });
}
UINT get_marking_info() {
    return n_get_marking_info(selected());
}
UINT n_get_startstop_info(UINT CardNo) {
    return question(__func__, CardNo, UINT{},
                    [&](Card& card) -> Result<UINT> { return card.engine.get_startstop_info(); });
}
UINT get_startstop_info() {
    return n_get_startstop_info(selected());
}

// ---- McBSP
// -------------------------------------------------------------------------------------------------------------

void n_set_mcbsp_in(UINT CardNo, UINT Mode, double Scale) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> { return card.engine.set_mcbsp_in(small(Mode), Scale); });
}
void set_mcbsp_in(UINT Mode, double Scale) {
    n_set_mcbsp_in(selected(), Mode, Scale);
}
void n_set_multi_mcbsp_in(UINT CardNo, UINT Ctrl, UINT P, UINT Mode) {
    command(__func__, CardNo,
            [&](Card& card) -> Result<void> { return card.engine.set_multi_mcbsp_in(small(Ctrl), P, small(Mode)); });
}
void set_multi_mcbsp_in(UINT Ctrl, UINT P, UINT Mode) {
    n_set_multi_mcbsp_in(selected(), Ctrl, P, Mode);
}
void n_set_mcbsp_x(UINT CardNo, double ScaleX) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        const Online o = online(card);
        return card.engine.set_mcbsp_online(ScaleX, o.y, o.turn);
    });
}
void set_mcbsp_x(double ScaleX) {
    n_set_mcbsp_x(selected(), ScaleX);
}
void n_set_mcbsp_y(UINT CardNo, double ScaleY) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        const Online o = online(card);
        return card.engine.set_mcbsp_online(o.x, ScaleY, o.turn);
    });
}
void set_mcbsp_y(double ScaleY) {
    n_set_mcbsp_y(selected(), ScaleY);
}
void n_set_mcbsp_rot(UINT CardNo, double Resolution) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        const Online o = online(card);
        return card.engine.set_mcbsp_online(o.x, o.y, Resolution);
    });
}
void set_mcbsp_rot(double Resolution) {
    n_set_mcbsp_rot(selected(), Resolution);
}
void n_set_mcbsp_matrix(UINT CardNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        card.engine.set_mcbsp_matrix();
        return {};
    });
}
void set_mcbsp_matrix() {
    n_set_mcbsp_matrix(selected());
}
void n_apply_mcbsp(UINT CardNo, UINT HeadNo, UINT at_once) {
    command(__func__, CardNo,
            [&](Card& card) -> Result<void> { return card.engine.apply_mcbsp(small(HeadNo), small(at_once)); });
}
void apply_mcbsp(UINT HeadNo, UINT at_once) {
    n_apply_mcbsp(selected(), HeadNo, at_once);
}

// ---- Laser signals
// -----------------------------------------------------------------------------------------------------

void n_set_laser_mode(UINT CardNo, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void set_laser_mode(UINT Mode) {
    n_set_laser_mode(selected(), Mode);
}
void n_set_laser_control(UINT CardNo, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void set_laser_control(UINT Ctrl) {
    n_set_laser_control(selected(), Ctrl);
}
void n_set_standby(UINT CardNo, UINT, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void set_standby(UINT HalfPeriod, UINT PulseLength) {
    n_set_standby(selected(), HalfPeriod, PulseLength);
}
void n_set_laser_pulses_ctrl(UINT CardNo, UINT, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void set_laser_pulses_ctrl(UINT HalfPeriod, UINT PulseLength) {
    n_set_laser_pulses_ctrl(selected(), HalfPeriod, PulseLength);
}
void n_set_firstpulse_killer(UINT CardNo, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void set_firstpulse_killer(UINT Length) {
    n_set_firstpulse_killer(selected(), Length);
}
void n_set_qswitch_delay(UINT CardNo, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void set_qswitch_delay(UINT Delay) {
    n_set_qswitch_delay(selected(), Delay);
}
void n_set_laser_pulses(UINT CardNo, UINT, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void set_laser_pulses(UINT HalfPeriod, UINT PulseLength) {
    n_set_laser_pulses(selected(), HalfPeriod, PulseLength);
}
void n_set_firstpulse_killer_list(UINT CardNo, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void set_firstpulse_killer_list(UINT Length) {
    n_set_firstpulse_killer_list(selected(), Length);
}
void n_set_qswitch_delay_list(UINT CardNo, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void set_qswitch_delay_list(UINT Delay) {
    n_set_qswitch_delay_list(selected(), Delay);
}
