// Control commands of rtc5sim.h that are one call of the card; others are in answers.cpp.
#include <motionrack/frontends/rtc5sim/calls.hpp>

using namespace motionrack::rtc5sim;
using motionrack::ErrorKind;
using motionrack::Result;
namespace rtc5 = motionrack::rtc5;

namespace {

bool busy(const Card& card) {
    return (card.engine.status() & (rtc5::status_bit("BUSY") | rtc5::status_bit("INTERNAL_BUSY"))) != 0;
}
/// Returns the kind of error of a command that the card refuses: machine if the card is busy, else refused.
ErrorKind busy_or_wrong(const Card& card) {
    return busy(card) ? ErrorKind::machine : ErrorKind::refused;
}
void execute(const char* who, UINT number, UINT list, UINT position = 0) {
    command(who, number, [&](Card& card) { return as(busy_or_wrong(card), card.engine.execute_list(list, position)); });
}

}  // namespace

// ---- Cards

UINT n_get_error(UINT CardNo) {
    return with_bench(__func__, UINT{RTC5_ACCESS_DENIED}, [&](CardTable& bench) -> Result<UINT> {
        MOTIONRACK_TRY(Card * card, bench.card(CardNo));
        return card->errors;
    });
}
UINT n_get_last_error(UINT CardNo) {
    return with_bench(__func__, UINT{RTC5_ACCESS_DENIED}, [&](CardTable& bench) -> Result<UINT> {
        MOTIONRACK_TRY(Card * card, bench.card(CardNo));
        return card->last_error;
    });
}
void n_reset_error(UINT CardNo, UINT Code) {
    with_bench(__func__, false, [&](CardTable& bench) -> Result<bool> {
        MOTIONRACK_TRY(Card * card, bench.card(CardNo));
        card->errors &= ~Code;
        return true;
    });
}

// ---- Files and tables

void n_select_cor_table(UINT CardNo, UINT HeadA, UINT HeadB) {
    call(__func__, CardNo, &rtc5::HeadTransforms::select_tables, small(HeadA), small(HeadB));
}

// ---- Running lists

void n_config_list(UINT CardNo, UINT Mem1, UINT Mem2) {
    command(__func__, CardNo, [&](Card& card) {
        // -1 means all remaining memory.
        return as(busy_or_wrong(card),
                  card.engine.parts().lists.configure(Mem1, Mem2 == 0xFFFFFFFF ? -1 : std::int64_t{Mem2}));
    });
}
void n_set_start_list(UINT CardNo, UINT ListNo) {
    call(__func__, CardNo, &rtc5::Engine::set_start_list, ListNo, 0);
}
void n_set_start_list_pos(UINT CardNo, UINT ListNo, UINT Pos) {
    call(__func__, CardNo, &rtc5::Engine::set_start_list, ListNo, Pos);
}
void n_set_start_list_1(UINT CardNo) {
    call(__func__, CardNo, &rtc5::Engine::set_start_list, 1, 0);
}
void n_set_start_list_2(UINT CardNo) {
    call(__func__, CardNo, &rtc5::Engine::set_start_list, 2, 0);
}
UINT n_load_list(UINT CardNo, UINT ListNo, UINT Pos) {
    return question(__func__, CardNo, UINT{},
                    [&](Card& card) -> Result<UINT> { return card.engine.parts().lists.load_list(ListNo, Pos); });
}
void n_load_sub(UINT CardNo, UINT Index) {
    call(__func__, CardNo, &rtc5::ListMemory::load_sub, Index);
}
UINT n_get_input_pointer(UINT CardNo) {
    return with_card(__func__, CardNo, UINT{},
                     [&](Card& card) -> Result<UINT> { return static_cast<UINT>(card.engine.input_pointer()); });
}
UINT n_get_list_space(UINT CardNo) {
    return with_card(__func__, CardNo, UINT{}, [&](Card& card) -> Result<UINT> {
        return static_cast<UINT>(card.engine.state().lists.input_end - card.engine.input_pointer());
    });
}
void n_execute_list(UINT CardNo, UINT ListNo) {
    execute(__func__, CardNo, ListNo);
}
void n_execute_list_1(UINT CardNo) {
    execute(__func__, CardNo, 1);
}
void n_execute_list_2(UINT CardNo) {
    execute(__func__, CardNo, 2);
}
void n_execute_list_pos(UINT CardNo, UINT ListNo, UINT Pos) {
    execute(__func__, CardNo, ListNo, Pos);
}
void n_execute_at_pointer(UINT CardNo, UINT Pos) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        return as(busy_or_wrong(card), card.engine.parts().execution.execute_at(Pos));
    });
}
void n_auto_change(UINT CardNo) {
    call(__func__, CardNo, &rtc5::ListExecution::auto_change);
}
void n_start_loop(UINT CardNo) {
    call(__func__, CardNo, &rtc5::ListExecution::start_loop);
}
void n_quit_loop(UINT CardNo) {
    call(__func__, CardNo, &rtc5::ListExecution::quit_loop);
}
void n_pause_list(UINT CardNo) {
    call(__func__, CardNo, &rtc5::Engine::pause_list);
}
void n_restart_list(UINT CardNo) {
    call(__func__, CardNo, &rtc5::Engine::restart_list);
}
void n_stop_execution(UINT CardNo) {
    call(__func__, CardNo, &rtc5::Engine::stop_execution);
}
UINT n_read_status(UINT CardNo) {
    return question(__func__, CardNo, UINT{},
                    [](Card& card) -> Result<UINT> { return card.engine.parts().lists.status(); });
}
void n_goto_xy(UINT CardNo, long X, long Y) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        return as(busy_or_wrong(card), card.engine.goto_xy(static_cast<double>(X), static_cast<double>(Y)));
    });
}

// ---- Settings

void n_set_jump_speed_ctrl(UINT CardNo, double Speed) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(checked(rtc5::Op::set_jump_speed, Speed));
        card.engine.parts().path.set_jump_speed(Speed);
        return {};
    });
}
void n_set_mark_speed_ctrl(UINT CardNo, double Speed) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(checked(rtc5::Op::set_mark_speed, Speed));
        card.engine.parts().path.set_mark_speed(Speed);
        return {};
    });
}
void n_set_matrix(UINT CardNo, UINT HeadNo, double M11, double M12, double M21, double M22, UINT at_once) {
    call(__func__, CardNo, &rtc5::HeadTransforms::set_matrix, small(HeadNo), std::array{M11, M12, M21, M22},
         small(at_once));
}
void n_set_offset(UINT CardNo, UINT HeadNo, long XOffset, long YOffset, UINT at_once) {
    call(__func__, CardNo, &rtc5::HeadTransforms::set_offset, small(HeadNo), point(XOffset, YOffset), small(at_once));
}
void n_set_angle(UINT CardNo, UINT HeadNo, double Angle, UINT at_once) {
    call(__func__, CardNo, &rtc5::HeadTransforms::set_angle, small(HeadNo), Angle, small(at_once));
}
void n_set_scale(UINT CardNo, UINT HeadNo, double Scale, UINT at_once) {
    call(__func__, CardNo, &rtc5::HeadTransforms::set_scale, small(HeadNo), Scale, small(at_once));
}
void n_set_hi(UINT CardNo, UINT HeadNo, double GalvoGainX, double GalvoGainY, long GalvoOffsetX, long GalvoOffsetY) {
    call(__func__, CardNo, &rtc5::HeadTransforms::set_hi, small(HeadNo), rtc5::Point{GalvoGainX, GalvoGainY},
         point(GalvoOffsetX, GalvoOffsetY));
}
void n_set_control_mode(UINT CardNo, UINT Mode) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(checked(rtc5::Op::set_control_mode_list, Mode));
        card.engine.set_control_mode(Mode);
        return {};
    });
}
void n_write_io_port(UINT CardNo, UINT Value) {
    command(__func__, CardNo, [&](Card& card) -> Result<void> {
        MOTIONRACK_CHECK(checked(rtc5::Op::write_io_port_list, Value));
        card.engine.mutable_state().io = Value;
        return {};
    });
}
UINT n_get_io_status(UINT CardNo) {
    return question(__func__, CardNo, UINT{},
                    [&](Card& card) -> Result<UINT> { return static_cast<UINT>(card.engine.state().io); });
}
