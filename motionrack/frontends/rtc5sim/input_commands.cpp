// Control commands of rtc5sim.h for encoders, starts, McBSP and laser signals that are one call of the card.
#include <motionrack/frontends/rtc5sim/calls.hpp>

using namespace motionrack::rtc5sim;
using motionrack::ErrorKind;
using motionrack::Result;
namespace rtc5 = motionrack::rtc5;

namespace {

/// Accepts a call that has no effect.
void taken(const char* who, UINT number) {
    command(who, number, [](Card&) -> Result<void> { return {}; });
}

}  // namespace

// ---- Encoders and starts

void n_simulate_encoder(UINT CardNo, UINT EncoderNo) {
    call(__func__, CardNo, &rtc5::BeltEncoders::simulate, small(EncoderNo));
}
void n_set_rot_center(UINT CardNo, long X, long Y) {
    call(__func__, CardNo, &rtc5::FlyCorrection::set_rot_center, point(X, Y));
}
void n_init_fly_2d(UINT CardNo, long OffsetX, long OffsetY) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_TRY(const std::int32_t x, whole32("OffsetX", OffsetX));
        MOTIONRACK_TRY(const std::int32_t y, whole32("OffsetY", OffsetY));
        card.engine.parts().fly.zero_2d(x, y);
        return {};
    });
}
void n_set_encoder_speed_ctrl(UINT CardNo, UINT EncoderNo, double Speed, double Smooth) {
    call(__func__, CardNo, &rtc5::BeltEncoders::watch_speed, small(EncoderNo), Speed, Smooth);
}
void n_set_ext_start_delay(UINT CardNo, long Delay, UINT EncoderNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_TRY(const std::int32_t delay, whole32("Delay", Delay));
        return card.engine.set_ext_start_delay(delay, small(EncoderNo));
    });
}
void n_simulate_ext_start_ctrl(UINT CardNo) {
    call(__func__, CardNo, &rtc5::ExternalStarts::trigger);
}
void n_simulate_ext_stop(UINT CardNo) {
    call(__func__, CardNo, &rtc5::Engine::external_stop);
}
UINT n_get_marking_info(UINT CardNo) {
    return question(__func__, CardNo, UINT{},
                    [&](Card& card) -> Result<UINT> { return card.engine.parts().flags.take_marking_info(); });
}
UINT n_get_startstop_info(UINT CardNo) {
    return question(__func__, CardNo, UINT{},
                    [&](Card& card) -> Result<UINT> { return card.engine.get_startstop_info(); });
}

// ---- McBSP

long n_get_mcbsp(UINT CardNo) {
    return question(__func__, CardNo, 0L, [](Card& card) -> Result<long> {
        return as(ErrorKind::stopped, card.engine.parts().mcbsp.store_now());
    });
}

void n_set_mcbsp_in(UINT CardNo, UINT Mode, double Scale) {
    call(__func__, CardNo, &rtc5::FlyCorrection::set_mcbsp_in, small(Mode), Scale);
}
void n_set_multi_mcbsp_in(UINT CardNo, UINT Ctrl, UINT P, UINT Mode) {
    call(__func__, CardNo, &rtc5::FlyCorrection::set_multi_mcbsp_in, small(Ctrl), P, small(Mode));
}
void n_set_mcbsp_x(UINT CardNo, double ScaleX) {
    call(__func__, CardNo, &rtc5::FlyCorrection::set_mcbsp_x, ScaleX);
}
void n_set_mcbsp_y(UINT CardNo, double ScaleY) {
    call(__func__, CardNo, &rtc5::FlyCorrection::set_mcbsp_y, ScaleY);
}
void n_set_mcbsp_rot(UINT CardNo, double Resolution) {
    call(__func__, CardNo, &rtc5::FlyCorrection::set_mcbsp_rot, Resolution);
}
void n_set_mcbsp_matrix(UINT CardNo) {
    call(__func__, CardNo, &rtc5::FlyCorrection::set_mcbsp_matrix);
}
void n_apply_mcbsp(UINT CardNo, UINT HeadNo, UINT at_once) {
    call(__func__, CardNo, &rtc5::Engine::apply_mcbsp, small(HeadNo), small(at_once));
}

// ---- Signals and recording

long n_get_value(UINT CardNo, UINT Signal) {
    return question(__func__, CardNo, 0L,
                    [&](Card& card) -> Result<long> { return card.engine.parts().recorder.value(Signal); });
}
void n_stop_trigger(UINT CardNo) {
    call(__func__, CardNo, &rtc5::SignalRecorder::stop);
}

// ---- Laser signals

void n_enable_laser(UINT CardNo) {
    call(__func__, CardNo, &rtc5::LaserControl::enable);
}
void n_disable_laser(UINT CardNo) {
    call(__func__, CardNo, &rtc5::LaserControl::disable);
}
void n_set_laser_timing(UINT CardNo, UINT, UINT, UINT, UINT) {
    taken(__func__, CardNo);
}

void n_set_laser_mode(UINT CardNo, UINT) {
    taken(__func__, CardNo);
}
void n_set_laser_control(UINT CardNo, UINT) {
    taken(__func__, CardNo);
}
void n_set_standby(UINT CardNo, UINT, UINT) {
    taken(__func__, CardNo);
}
void n_set_laser_pulses_ctrl(UINT CardNo, UINT, UINT) {
    taken(__func__, CardNo);
}
void n_set_firstpulse_killer(UINT CardNo, UINT) {
    taken(__func__, CardNo);
}
void n_set_qswitch_delay(UINT CardNo, UINT) {
    taken(__func__, CardNo);
}
void n_set_laser_pulses(UINT CardNo, UINT, UINT) {
    taken(__func__, CardNo);
}
void n_set_firstpulse_killer_list(UINT CardNo, UINT) {
    taken(__func__, CardNo);
}
void n_set_qswitch_delay_list(UINT CardNo, UINT) {
    taken(__func__, CardNo);
}
