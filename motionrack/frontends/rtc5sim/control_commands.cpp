// The control commands of rtc5sim.h that are one call of the card; the others are in answers.cpp.
#include <motionrack/frontends/rtc5sim/calls.hpp>

using namespace motionrack::rtc5sim;
using motionrack::Result;
using motionrack::Trouble;
namespace rtc5 = motionrack::rtc5;

namespace {

bool busy(const Card& card) {
    return (card.engine.status() & (rtc5::status_bit("BUSY") | rtc5::status_bit("INTERNAL_BUSY"))) != 0;
}
/// What it is if the card does not start.
Trouble busy_or_wrong(const Card& card) {
    return busy(card) ? Trouble::machine : Trouble::refused;
}
Result<void> execute(Card& card, UINT list) {
    return as(busy_or_wrong(card), card.engine.execute_list(small(list)));
}

}  // namespace

// ---- Cards
// -------------------------------------------------------------------------------------------------------------

UINT n_get_error(UINT CardNo) {
    return with_bench(__func__, UINT{RTC5_NO_CARD}, [&](Bench& bench) -> Result<UINT> {
        MOTIONRACK_TRY(Card * card, bench.card(CardNo));
        return card->errors;
    });
}
UINT get_error() {
    return n_get_error(selected());
}
UINT n_get_last_error(UINT CardNo) {
    return with_bench(__func__, UINT{RTC5_NO_CARD}, [&](Bench& bench) -> Result<UINT> {
        MOTIONRACK_TRY(Card * card, bench.card(CardNo));
        return card->last_error;
    });
}
UINT get_last_error() {
    return n_get_last_error(selected());
}
void n_reset_error(UINT CardNo, UINT Code) {
    with_bench(__func__, false, [&](Bench& bench) -> Result<bool> {
        MOTIONRACK_TRY(Card * card, bench.card(CardNo));
        card->errors &= ~Code;
        return true;
    });
}
void reset_error(UINT Code) {
    n_reset_error(selected(), Code);
}

// ---- Files and tables
// --------------------------------------------------------------------------------------------------

void n_select_cor_table(UINT CardNo, UINT HeadA, UINT HeadB) {
    command(__func__, CardNo,
            [&](Card& card) -> Result<void> { return card.engine.select_cor_table(small(HeadA), small(HeadB)); });
}
void select_cor_table(UINT HeadA, UINT HeadB) {
    n_select_cor_table(selected(), HeadA, HeadB);
}

// ---- Running lists
// -----------------------------------------------------------------------------------------------------

void n_config_list(UINT CardNo, UINT Mem1, UINT Mem2) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> { return card.engine.config_list(Mem1, Mem2); });
}
void config_list(UINT Mem1, UINT Mem2) {
    n_config_list(selected(), Mem1, Mem2);
}
void n_set_start_list(UINT CardNo, UINT ListNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> { return card.engine.set_start_list(small(ListNo)); });
}
void set_start_list(UINT ListNo) {
    n_set_start_list(selected(), ListNo);
}
void n_set_start_list_1(UINT CardNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> { return card.engine.set_start_list(1); });
}
void set_start_list_1() {
    n_set_start_list_1(selected());
}
void n_set_start_list_2(UINT CardNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> { return card.engine.set_start_list(2); });
}
void set_start_list_2() {
    n_set_start_list_2(selected());
}
UINT n_get_input_pointer(UINT CardNo) {
    return with_card(__func__, CardNo, UINT{},
                     [&](Card& card) -> Result<UINT> { return static_cast<UINT>(card.engine.input_pointer()); });
}
UINT get_input_pointer() {
    return n_get_input_pointer(selected());
}
UINT n_get_list_space(UINT CardNo) {
    return with_card(__func__, CardNo, UINT{}, [&](Card& card) -> Result<UINT> {
        return static_cast<UINT>(card.engine.state().lists.input_end - card.engine.input_pointer());
    });
}
UINT get_list_space() {
    return n_get_list_space(selected());
}
void n_execute_list(UINT CardNo, UINT ListNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> { return execute(card, ListNo); });
}
void execute_list(UINT ListNo) {
    n_execute_list(selected(), ListNo);
}
void n_execute_list_1(UINT CardNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> { return execute(card, 1); });
}
void execute_list_1() {
    n_execute_list_1(selected());
}
void n_execute_list_2(UINT CardNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> { return execute(card, 2); });
}
void execute_list_2() {
    n_execute_list_2(selected());
}
void n_execute_at_pointer(UINT CardNo, UINT Pos) {
    command(__func__, CardNo,
            [&](Card& card) -> Result<void> { return as(busy_or_wrong(card), card.engine.execute_at(Pos)); });
}
void execute_at_pointer(UINT Pos) {
    n_execute_at_pointer(selected(), Pos);
}
void n_auto_change(UINT CardNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        card.engine.auto_change();
        return {};
    });
}
void auto_change() {
    n_auto_change(selected());
}
void n_start_loop(UINT CardNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        card.engine.start_loop();
        return {};
    });
}
void start_loop() {
    n_start_loop(selected());
}
void n_quit_loop(UINT CardNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        card.engine.quit_loop();
        return {};
    });
}
void quit_loop() {
    n_quit_loop(selected());
}
void n_pause_list(UINT CardNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        card.engine.pause_list();
        return {};
    });
}
void pause_list() {
    n_pause_list(selected());
}
void n_restart_list(UINT CardNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        card.engine.restart_list();
        return {};
    });
}
void restart_list() {
    n_restart_list(selected());
}
void n_stop_execution(UINT CardNo) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        card.engine.stop_execution();
        return {};
    });
}
void stop_execution() {
    n_stop_execution(selected());
}
void n_goto_xy(UINT CardNo, long X, long Y) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        return as(busy_or_wrong(card), card.engine.goto_xy(static_cast<double>(X), static_cast<double>(Y)));
    });
}
void goto_xy(long X, long Y) {
    n_goto_xy(selected(), X, Y);
}

// ---- Settings
// ----------------------------------------------------------------------------------------------------------

void n_set_jump_speed_ctrl(UINT CardNo, double Speed) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(checked(rtc5::Op::set_jump_speed, Speed));
        card.engine.set_jump_speed(Speed);
        return {};
    });
}
void set_jump_speed_ctrl(double Speed) {
    n_set_jump_speed_ctrl(selected(), Speed);
}
void n_set_mark_speed_ctrl(UINT CardNo, double Speed) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(checked(rtc5::Op::set_mark_speed, Speed));
        card.engine.set_mark_speed(Speed);
        return {};
    });
}
void set_mark_speed_ctrl(double Speed) {
    n_set_mark_speed_ctrl(selected(), Speed);
}
void n_set_matrix(UINT CardNo, UINT HeadNo, double M11, double M12, double M21, double M22, UINT at_once) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        return card.engine.set_matrix(small(HeadNo), {M11, M12, M21, M22}, small(at_once));
    });
}
void set_matrix(UINT HeadNo, double M11, double M12, double M21, double M22, UINT at_once) {
    n_set_matrix(selected(), HeadNo, M11, M12, M21, M22, at_once);
}
void n_set_offset(UINT CardNo, UINT HeadNo, long XOffset, long YOffset, UINT at_once) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        return card.engine.set_offset(small(HeadNo), point(XOffset, YOffset), small(at_once));
    });
}
void set_offset(UINT HeadNo, long XOffset, long YOffset, UINT at_once) {
    n_set_offset(selected(), HeadNo, XOffset, YOffset, at_once);
}
void n_set_angle(UINT CardNo, UINT HeadNo, double Angle, UINT at_once) {
    command(__func__, CardNo,
            [&](Card& card) -> Result<void> { return card.engine.set_angle(small(HeadNo), Angle, small(at_once)); });
}
void set_angle(UINT HeadNo, double Angle, UINT at_once) {
    n_set_angle(selected(), HeadNo, Angle, at_once);
}
void n_set_scale(UINT CardNo, UINT HeadNo, double Scale, UINT at_once) {
    command(__func__, CardNo,
            [&](Card& card) -> Result<void> { return card.engine.set_scale(small(HeadNo), Scale, small(at_once)); });
}
void set_scale(UINT HeadNo, double Scale, UINT at_once) {
    n_set_scale(selected(), HeadNo, Scale, at_once);
}
void n_set_hi(UINT CardNo, UINT HeadNo, double GalvoGainX, double GalvoGainY, long GalvoOffsetX, long GalvoOffsetY) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        return card.engine.set_hi(small(HeadNo), {GalvoGainX, GalvoGainY}, point(GalvoOffsetX, GalvoOffsetY));
    });
}
void set_hi(UINT HeadNo, double GalvoGainX, double GalvoGainY, long GalvoOffsetX, long GalvoOffsetY) {
    n_set_hi(selected(), HeadNo, GalvoGainX, GalvoGainY, GalvoOffsetX, GalvoOffsetY);
}
void n_set_control_mode(UINT CardNo, UINT Mode) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(checked(rtc5::Op::set_control_mode_list, Mode));
        card.engine.set_control_mode(Mode);
        return {};
    });
}
void set_control_mode(UINT Mode) {
    n_set_control_mode(selected(), Mode);
}
void n_write_io_port(UINT CardNo, UINT Value) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(checked(rtc5::Op::write_io_port_list, Value));
        card.engine.mutable_state().io = Value;
        return {};
    });
}
void write_io_port(UINT Value) {
    n_write_io_port(selected(), Value);
}
UINT n_get_io_status(UINT CardNo) {
    return question(__func__, CardNo, UINT{},
                    [&](Card& card) -> Result<UINT> { return static_cast<UINT>(card.engine.state().io); });
}
UINT get_io_status() {
    return n_get_io_status(selected());
}
