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

// ---- Encoders and starts ----

void n_simulate_encoder(UINT CardNo, UINT EncoderNo) {
    call(__func__, CardNo, &rtc5::Engine::simulate_encoder, small(EncoderNo));
}
void n_set_rot_center(UINT CardNo, long X, long Y) {
    call(__func__, CardNo, &rtc5::Engine::set_rot_center, point(X, Y));
}
void n_init_fly_2d(UINT CardNo, long OffsetX, long OffsetY) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_TRY(const std::int32_t x, whole32("OffsetX", OffsetX));
        MOTIONRACK_TRY(const std::int32_t y, whole32("OffsetY", OffsetY));
        card.engine.init_fly_2d(x, y);
        return {};
    });
}
void n_set_encoder_speed_ctrl(UINT CardNo, UINT EncoderNo, double Speed, double Smooth) {
    call(__func__, CardNo, &rtc5::Engine::set_encoder_speed, small(EncoderNo), Speed, Smooth);
}
void n_set_ext_start_delay(UINT CardNo, long Delay, UINT EncoderNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_TRY(const std::int32_t delay, whole32("Delay", Delay));
        return card.engine.set_ext_start_delay(delay, small(EncoderNo));
    });
}
void n_simulate_ext_start_ctrl(UINT CardNo) {
    call(__func__, CardNo, &rtc5::Engine::external_start);
}
void n_simulate_ext_stop(UINT CardNo) {
    call(__func__, CardNo, &rtc5::Engine::external_stop);
}
UINT n_get_marking_info(UINT CardNo) {
    return question(__func__, CardNo, UINT{},
                    [&](Card& card) -> Result<UINT> { return card.engine.get_marking_info(); });
}
UINT n_get_startstop_info(UINT CardNo) {
    return question(__func__, CardNo, UINT{},
                    [&](Card& card) -> Result<UINT> { return card.engine.get_startstop_info(); });
}

// ---- McBSP ----

void n_set_mcbsp_in(UINT CardNo, UINT Mode, double Scale) {
    call(__func__, CardNo, &rtc5::Engine::set_mcbsp_in, small(Mode), Scale);
}
void n_set_multi_mcbsp_in(UINT CardNo, UINT Ctrl, UINT P, UINT Mode) {
    call(__func__, CardNo, &rtc5::Engine::set_multi_mcbsp_in, small(Ctrl), P, small(Mode));
}
void n_set_mcbsp_x(UINT CardNo, double ScaleX) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        const Online o = online(card);
        return card.engine.set_mcbsp_online(ScaleX, o.y, o.turn);
    });
}
void n_set_mcbsp_y(UINT CardNo, double ScaleY) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        const Online o = online(card);
        return card.engine.set_mcbsp_online(o.x, ScaleY, o.turn);
    });
}
void n_set_mcbsp_rot(UINT CardNo, double Resolution) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        const Online o = online(card);
        return card.engine.set_mcbsp_online(o.x, o.y, Resolution);
    });
}
void n_set_mcbsp_matrix(UINT CardNo) {
    call(__func__, CardNo, &rtc5::Engine::set_mcbsp_matrix);
}
void n_apply_mcbsp(UINT CardNo, UINT HeadNo, UINT at_once) {
    call(__func__, CardNo, &rtc5::Engine::apply_mcbsp, small(HeadNo), small(at_once));
}

// ---- Laser signals ----

void n_set_laser_mode(UINT CardNo, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void n_set_laser_control(UINT CardNo, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void n_set_standby(UINT CardNo, UINT, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void n_set_laser_pulses_ctrl(UINT CardNo, UINT, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void n_set_firstpulse_killer(UINT CardNo, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void n_set_qswitch_delay(UINT CardNo, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void n_set_laser_pulses(UINT CardNo, UINT, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void n_set_firstpulse_killer_list(UINT CardNo, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
void n_set_qswitch_delay_list(UINT CardNo, UINT) {
    command(__func__, CardNo, [](Card&) -> Result<void> { return {}; });
}
