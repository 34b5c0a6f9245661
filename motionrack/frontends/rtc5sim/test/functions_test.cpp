// Calls every command once: the library and the card must give the same result.
#include <gmock/gmock.h>

#include <functional>
#include <motionrack/cards/rtc5/model/engine.hpp>
#include <motionrack/frontends/rtc5sim/test/session.hpp>
#include <set>

namespace motionrack::rtc5sim_test {
namespace {

using rtc5::Engine;
using rtc5::Op;

struct Row {
    const char* name;
    void (*library)();
    std::function<void(Engine&)> card;
};

void put(Engine& card, Op op, std::initializer_list<double> parameters) {
    const auto command = rtc5::list_command(op, parameters);
    ASSERT_TRUE(command) << command.error().message;
    ASSERT_TRUE(card.put(*command));
}

/// Makes a row of the comparison for a list command with its parameters.
Row listed(Op op, void (*library)(), std::initializer_list<double> p = {}) {
    return {rtc5::info(op).name.data(), library, [op, all = std::vector<double>(p)](Engine& card) {
                const auto command = rtc5::list_command(op, all);
                ASSERT_TRUE(command) << command.error().message;
                ASSERT_TRUE(card.put(*command));
            }};
}

const Row list_rows[] = {
    listed(Op::set_end_of_list, [] { set_end_of_list(); }),
    listed(Op::list_nop, [] { list_nop(); }),
    listed(Op::long_delay, [] { long_delay(7); }, {7}),
    listed(Op::jump_abs, [] { jump_abs(100, -200); }, {100, -200}),
    listed(Op::jump_rel, [] { jump_rel(-1100, 200); }, {-1100, 200}),
    listed(Op::mark_abs, [] { mark_abs(1100, -2200); }, {1100, -2200}),
    listed(Op::mark_rel, [] { mark_rel(10'000'000'000, -200); }, {10'000'000'000, -200}),
    listed(Op::arc_abs, [] { arc_abs(1100, 2200, 90.5); }, {1100, 2200, 90.5}),
    listed(Op::arc_rel, [] { arc_rel(-1100, 2200, -90.5); }, {-1100, 2200, -90.5}),
    listed(Op::timed_jump_abs, [] { timed_jump_abs(1100, 2200, 77.7); }, {1100, 2200, 77.7}),
    listed(Op::timed_jump_rel, [] { timed_jump_rel(1100, -2200, 177.7); }, {1100, -2200, 177.7}),
    listed(Op::timed_mark_abs, [] { timed_mark_abs(1100, 2200, 277.7); }, {1100, 2200, 277.7}),
    listed(Op::timed_mark_rel, [] { timed_mark_rel(-1100, 2200, 377.7); }, {-1100, 2200, 377.7}),
    listed(Op::micro_vector_abs, [] { micro_vector_abs(11, 22, 3, 17); }, {11, 22, 3, 17}),
    listed(Op::micro_vector_rel, [] { micro_vector_rel(-11, 22, 4, 18); }, {-11, 22, 4, 18}),
    listed(Op::set_jump_speed, [] { set_jump_speed(33'000.5); }, {33'000.5}),
    listed(Op::set_mark_speed, [] { set_mark_speed(44'000.5); }, {44'000.5}),
    listed(Op::set_scanner_delays, [] { set_scanner_delays(11, 22, 33); }, {11, 22, 33}),
    listed(Op::set_laser_delays, [] { set_laser_delays(-55, 77); }, {-55, 77}),
    listed(Op::laser_on_list, [] { laser_on_list(5); }, {5}),
    listed(Op::laser_signal_on_list, [] { laser_signal_on_list(); }),
    listed(Op::laser_signal_off_list, [] { laser_signal_off_list(); }),
    listed(Op::write_io_port_list, [] { write_io_port_list(0xA5); }, {0xA5}),
    listed(Op::set_fly_x, [] { set_fly_x(1.5); }, {1.5}),
    listed(Op::set_fly_y, [] { set_fly_y(-1.5); }, {-1.5}),
    listed(Op::set_fly_z, [] { set_fly_z(2.5, 1); }, {2.5, 1}),
    listed(Op::set_fly_rot, [] { set_fly_rot(54'321); }, {54'321}),
    listed(Op::set_fly_2d, [] { set_fly_2d(1.5, 2.5); }, {1.5, 2.5}),
    listed(Op::set_fly_x_pos, [] { set_fly_x_pos(1.5); }, {1.5}),
    listed(Op::set_fly_y_pos, [] { set_fly_y_pos(2.5); }, {2.5}),
    listed(Op::set_fly_rot_pos, [] { set_fly_rot_pos(54'321); }, {54'321}),
    listed(Op::activate_fly_xy, [] { activate_fly_xy(1.25, -2.25); }, {1.25, -2.25}),
    listed(Op::activate_fly_2d, [] { activate_fly_2d(1.25, -2.25); }, {1.25, -2.25}),
    listed(Op::fly_return, [] { fly_return(100, -200); }, {100, -200}),
    listed(Op::fly_return_z, [] { fly_return_z(100, -200, 300); }, {100, -200, 300}),
    listed(Op::set_rot_center_list, [] { set_rot_center_list(5000, -6000); }, {5000, -6000}),
    listed(Op::store_encoder, [] { store_encoder(1); }, {1}),
    listed(Op::wait_for_encoder, [] { wait_for_encoder(1111, 1); }, {1111, 1}),
    listed(Op::wait_for_encoder_mode, [] { wait_for_encoder_mode(2222, 0, 1); }, {2222, 0, 1}),
    listed(Op::wait_for_encoder_in_range, [] { wait_for_encoder_in_range(500, 900, 400, 800); }, {500, 900, 400, 800}),
    listed(Op::wait_for_mcbsp, [] { wait_for_mcbsp(1, -2, 1); }, {1, -2, 1}),
    listed(Op::set_fly_limits, [] { set_fly_limits(-100, 200, -300, 400); }, {-100, 200, -300, 400}),
    listed(Op::set_fly_limits_z, [] { set_fly_limits_z(-10, 20); }, {-10, 20}),
    listed(Op::if_fly_x_overflow, [] { if_fly_x_overflow(1); }, {1}),
    listed(Op::if_fly_y_overflow, [] { if_fly_y_overflow(1); }, {1}),
    listed(Op::if_fly_z_overflow, [] { if_fly_z_overflow(1); }, {1}),
    listed(Op::if_not_fly_x_overflow, [] { if_not_fly_x_overflow(-1); }, {-1}),
    listed(Op::if_not_fly_y_overflow, [] { if_not_fly_y_overflow(-1); }, {-1}),
    listed(Op::if_not_fly_z_overflow, [] { if_not_fly_z_overflow(-1); }, {-1}),
    listed(Op::clear_fly_overflow, [] { clear_fly_overflow(2); }, {2}),
    listed(Op::park_position, [] { park_position(0, 700, 800); }, {0, 700, 800}),
    listed(Op::park_return, [] { park_return(1, 700, -800); }, {1, 700, -800}),
    listed(Op::set_ext_start_delay_list, [] { set_ext_start_delay_list(6000, 1); }, {6000, 1}),
    listed(Op::simulate_ext_start, [] { simulate_ext_start(5000, 1); }, {5000, 1}),
    listed(Op::set_control_mode_list, [] { set_control_mode_list(513); }, {513}),
    listed(Op::set_encoder_speed, [] { set_encoder_speed(1, 900.5, 0.25); }, {1, 900.5, 0.25}),
    listed(Op::set_mcbsp_in_list, [] { set_mcbsp_in_list(2, 1.5); }, {2, 1.5}),
    listed(Op::set_multi_mcbsp_in_list, [] { set_multi_mcbsp_in_list(1, 2, 0); }, {1, 2, 0}),
    listed(Op::get_mcbsp_list, [] { get_mcbsp_list(); }),
    listed(Op::set_mcbsp_x_list, [] { set_mcbsp_x_list(1.5); }, {1.5}),
    listed(Op::set_mcbsp_y_list, [] { set_mcbsp_y_list(-2.5); }, {-2.5}),
    listed(Op::set_mcbsp_rot_list, [] { set_mcbsp_rot_list(4321); }, {4321}),
    listed(Op::set_mcbsp_matrix_list, [] { set_mcbsp_matrix_list(); }),
    listed(Op::apply_mcbsp_list, [] { apply_mcbsp_list(3, 2); }, {3, 2}),
    listed(Op::set_trigger, [] { set_trigger(2, 7, 44); }, {2, 7, 44}),
    listed(Op::set_trigger4, [] { set_trigger4(3, 0, 8, 20, 43); }, {3, 0, 8, 20, 43}),
    listed(Op::set_matrix_list, [] { set_matrix_list(1, 0, 1, 0.75, 1); }, {1, 0, 1, 0.75, 1}),
    listed(Op::set_offset_list, [] { set_offset_list(4, 70, -80, 2); }, {4, 70, -80, 2}),
    listed(Op::set_angle_list, [] { set_angle_list(1, 33.5, 1); }, {1, 33.5, 1}),
    listed(Op::set_scale_list, [] { set_scale_list(1, 0.5, 2); }, {1, 0.5, 2}),
    listed(Op::set_wobbel, [] { set_wobbel(500, 300, 1234.5); }, {500, 300, 1234.5}),
    listed(Op::list_call, [] { list_call(30); }, {30}),
    listed(Op::sub_call, [] { sub_call(9); }, {9}),
    listed(Op::list_return, [] { list_return(); }),
};

const Row control_rows[] = {
    {"set_jump_speed_ctrl", [] { set_jump_speed_ctrl(7777); }, [](Engine& c) { c.parts().path.set_jump_speed(7777); }},
    {"set_mark_speed_ctrl", [] { set_mark_speed_ctrl(8888); }, [](Engine& c) { c.parts().path.set_mark_speed(8888); }},
    {"set_delay_mode", [] { set_delay_mode(1, 0, 40, 2, 900'000); },
     [](Engine& c) {
         rtc5::Delays d = c.state().path.delays;
         d.variable_polygon = 1, d.edge_level = 40, d.min_jump = 2, d.jump_limit = 900'000;
         ASSERT_TRUE(c.parts().path.set_delays(d));
     }},
    {"set_matrix", [] { set_matrix(1, 0.5, -0.25, 0.125, 0.75, 1); },
     [](Engine& c) {
         ASSERT_TRUE(c.parts().heads.set_matrix(1, {0.5, -0.25, 0.125, 0.75}, 1));
     }},
    {"set_offset", [] { set_offset(4, 123, -456, 1); },
     [](Engine& c) {
         ASSERT_TRUE(c.parts().heads.set_offset(4, {123, -456}, 1));
     }},
    {"set_angle", [] { set_angle(1, 12.5, 2); }, [](Engine& c) { ASSERT_TRUE(c.parts().heads.set_angle(1, 12.5, 2)); }},
    {"set_scale", [] { set_scale(3, 0.25, 0); }, [](Engine& c) { ASSERT_TRUE(c.parts().heads.set_scale(3, 0.25, 0)); }},
    {"set_hi", [] { set_hi(1, 0.5, 2, 30, -40); },
     [](Engine& c) {
         ASSERT_TRUE(c.parts().heads.set_hi(1, {0.5, 2}, {30, -40}));
     }},
    {"write_io_port", [] { write_io_port(77); }, [](Engine& c) { c.mutable_state().io = 77; }},
    {"simulate_encoder", [] { simulate_encoder(2); }, [](Engine& c) { ASSERT_TRUE(c.parts().encoders.simulate(2)); }},
    {"set_rot_center", [] { set_rot_center(9000, -8000); },
     [](Engine& c) {
         ASSERT_TRUE(c.parts().fly.set_rot_center({9000, -8000}));
     }},
    {"set_fly_tracking_error", [] { set_fly_tracking_error(15, 7); },
     [](Engine& c) { c.parts().encoders.set_tracking_error(15, 7); }},
    {"init_fly_2d", [] { init_fly_2d(400, -500); }, [](Engine& c) { c.parts().fly.zero_2d(400, -500); }},
    {"set_encoder_speed_ctrl", [] { set_encoder_speed_ctrl(2, 500, 0.5); },
     [](Engine& c) { ASSERT_TRUE(c.parts().encoders.watch_speed(2, 500, 0.5)); }},
    {"set_control_mode", [] { set_control_mode(512); }, [](Engine& c) { c.set_control_mode(512); }},
    {"set_mcbsp_in", [] { set_mcbsp_in(1, 2.5); }, [](Engine& c) { ASSERT_TRUE(c.parts().fly.set_mcbsp_in(1, 2.5)); }},
    {"set_multi_mcbsp_in", [] { set_multi_mcbsp_in(1, 2, 0); },
     [](Engine& c) { ASSERT_TRUE(c.parts().fly.set_multi_mcbsp_in(1, 2, 0)); }},
    {"set_mcbsp_x, set_mcbsp_y, apply_mcbsp",
     [] { set_mcbsp_x(2), set_mcbsp_y(3), rtc5sim_receive(1, 0x00050007), rtc5sim_advance_us(20), apply_mcbsp(1, 1); },
     [](Engine& c) {
         ASSERT_TRUE(c.parts().fly.set_mcbsp_online(2, 3, 0));
         c.parts().mcbsp.receive(0x00050007), c.run_until(c.tick() + 2);
         ASSERT_TRUE(c.apply_mcbsp(1, 1));
     }},
    {"set_mcbsp_rot",
     [] { set_mcbsp_rot(3600), rtc5sim_receive(1, 0x80000384), rtc5sim_advance_us(20), apply_mcbsp(1, 1); },
     [](Engine& c) {
         ASSERT_TRUE(c.parts().fly.set_mcbsp_online(0, 0, 3600));
         c.parts().mcbsp.receive(0x80000384), c.run_until(c.tick() + 2);
         ASSERT_TRUE(c.apply_mcbsp(1, 1));
     }},
    {"set_mcbsp_matrix",
     [] { set_mcbsp_matrix(), rtc5sim_receive(1, 0x02000001), rtc5sim_advance_us(20), apply_mcbsp(1, 1); },
     [](Engine& c) {
         c.parts().fly.set_mcbsp_matrix();
         c.parts().mcbsp.receive(0x02000001), c.run_until(c.tick() + 2);
         ASSERT_TRUE(c.apply_mcbsp(1, 1));
     }},
    {"goto_xy", [] { goto_xy(3000, 4000), rtc5sim_run(1'000'000); },
     [](Engine& c) {
         ASSERT_TRUE(c.goto_xy(3000, 4000));
         ASSERT_TRUE(c.run_to_rest(100'000));
     }},
    {"config_list", [] { config_list(50, 60), set_start_list(2); },
     [](Engine& c) {
         ASSERT_TRUE(c.parts().lists.configure(50, 60));
         ASSERT_TRUE(c.set_start_list(2));
     }},
    {"get_mcbsp", [] { get_mcbsp(); },
     [](Engine& c) {
         c.run_until(c.tick() + 1);
         ASSERT_TRUE(c.parts().mcbsp.store_now());
     }},
    {"disable_laser", [] { disable_laser(); }, [](Engine& c) { c.parts().laser.disable(); }},
    {"enable_laser", [] { disable_laser(), enable_laser(); },
     [](Engine& c) { c.parts().laser.disable(), c.parts().laser.enable(); }},
    {"set_mcbsp_out", [] { set_mcbsp_out(7, 43); },
     [](Engine& c) {
         ASSERT_TRUE(c.parts().recorder.send(std::array<std::uint32_t, 2>{7, 43}));
     }},
    {"set_start_list_pos", [] { set_start_list_pos(2, 7); }, [](Engine& c) { ASSERT_TRUE(c.set_start_list(2, 7)); }},
    {"load_sub", [] { load_sub(9), mark_rel(50, 60), list_return(), set_start_list(1), sub_call(9); },
     [](Engine& c) {
         ASSERT_TRUE(c.parts().lists.load_sub(9));
         put(c, Op::mark_rel, {50, 60}), put(c, Op::list_return, {});
         ASSERT_TRUE(c.set_start_list(1));
         put(c, Op::sub_call, {9});
     }},
    {"load_list", [] { rtc5sim_question_us(0), load_list(0, 9), rtc5sim_question_us(10); },
     [](Engine& c) { ASSERT_TRUE(c.parts().lists.load_list(0, 9)); }},
    {"select_cor_table", [] { load_correction_file(nullptr, 3, 2), select_cor_table(3, 0); },
     [](Engine& c) {
         ASSERT_TRUE(c.parts().heads.load_table(rtc5::table_of(rtc5::one_to_one()), 3));
         ASSERT_TRUE(c.parts().heads.select_tables(3, 0));
     }},
    {"load_program_file", [] { set_offset(1, 5, 6, 1), load_program_file(nullptr); },
     [](Engine& c) { c.load_program_file(); }},
};

struct Did {
    Trace trace;
    std::vector<std::int64_t> answers;
    bool operator==(const Did&) const = default;
};

struct Kept final : rtc5::Sink {
    Trace trace;
    void samples(const rtc5::Samples& b) override {
        trace.x.insert(trace.x.end(), b.x.begin(), b.x.end());
        trace.y.insert(trace.y.end(), b.y.begin(), b.y.end());
        trace.laser.insert(trace.laser.end(), b.laser.begin(), b.laser.end());
    }
};

constexpr int ticks = 1500;

Did by_library(const Row* control, const Row* in_list) {
    Session session;
    simulate_encoder(3);
    rtc5sim_receive(1, 0x00010001);
    if (control != nullptr) control->library();
    session.card[0] = {};
    const UINT begin = get_input_pointer();
    set_mark_speed(20'000), set_jump_speed(50'000), set_scanner_delays(3, 4, 2);
    activate_fly_xy(0.5, 0.25);
    list_nop();
    if (in_list != nullptr) in_list->library();
    jump_abs(1000, 2000), mark_abs(30'000, -20'000), mark_abs(0, 5000), set_end_of_list();
    execute_at_pointer(begin);
    rtc5sim_advance_us(ticks * 10);
    EXPECT_STREQ(rtc5sim_last_error(), "");
    EXPECT_EQ(get_error(), 0u);
    Did did{session.card[0], {}};
    rtc5sim_question_us(0);
    UINT status = 0, position = 0;
    get_status(&status, &position);
    long e[6] = {};
    get_encoder(&e[0], &e[1]);
    read_encoder(&e[2], &e[3], &e[4], &e[5]);
    did.answers = {status, position, get_marking_info(), get_startstop_info(), get_io_status()};
    did.answers.insert(did.answers.end(), std::begin(e), std::end(e));
    for (UINT i = 0; i < 4; ++i) did.answers.push_back(read_mcbsp(i));
    for (UINT i = 0; i < 8; ++i) did.answers.push_back(read_multi_mcbsp(i));
    get_fly_2d_offset(&e[0], &e[1]);
    did.answers.insert(did.answers.end(), {e[0], e[1], get_list_space(), read_status()});
    for (const rtc5::SignalInfo& signal : rtc5::map::signals) did.answers.push_back(get_value(signal.number));
    UINT count = 0;
    measurement_status(&status, &count);
    did.answers.insert(did.answers.end(), {status, count});
    if (++count > 0) {
        std::vector<std::int32_t> samples(count);
        get_waveform(2, count, reinterpret_cast<ULONG_PTR>(samples.data()));
        did.answers.insert(did.answers.end(), samples.begin(), samples.end());
    }
    std::int32_t sent = 0;
    EXPECT_EQ(rtc5sim_sent(1, &sent), 0);
    did.answers.push_back(sent);
    return did;
}

Did by_card(const Row* control, const Row* in_list) {
    Engine card;
    EXPECT_TRUE(card.parts().encoders.simulate(3));
    card.parts().mcbsp.receive(0x00010001);
    if (control != nullptr) control->card(card);
    const std::int64_t begin = card.input_pointer();
    put(card, Op::set_mark_speed, {20'000}), put(card, Op::set_jump_speed, {50'000});
    put(card, Op::set_scanner_delays, {3, 4, 2}), put(card, Op::activate_fly_xy, {0.5, 0.25}),
        put(card, Op::list_nop, {});
    if (in_list != nullptr) in_list->card(card);
    put(card, Op::jump_abs, {1000, 2000}), put(card, Op::mark_abs, {30'000, -20'000});
    put(card, Op::mark_abs, {0, 5000}), put(card, Op::set_end_of_list, {});
    EXPECT_TRUE(card.parts().execution.execute_at(begin));
    Kept kept;
    card.run_until(card.tick() + ticks, &kept);
    Did did{kept.trace, {}};
    did.answers = {card.status(),
                   card.parts().execution.position(),
                   card.parts().flags.take_marking_info(),
                   card.get_startstop_info(),
                   card.state().io,
                   card.encoder(0),
                   card.encoder(1),
                   card.parts().encoders.stored(0)[0],
                   card.parts().encoders.stored(0)[1],
                   card.parts().encoders.stored(1)[0],
                   card.parts().encoders.stored(1)[1]};
    for (int i = 0; i < 4; ++i) did.answers.push_back(card.parts().mcbsp.read(i).value_or(0));
    for (int i = 0; i < 8; ++i) did.answers.push_back(card.parts().mcbsp.typed(i));
    did.answers.push_back(static_cast<std::int64_t>(card.state().fly.offset_2d.x));
    did.answers.push_back(static_cast<std::int64_t>(card.state().fly.offset_2d.y));
    did.answers.push_back(card.state().lists.input_end - card.input_pointer());
    did.answers.push_back(card.parts().lists.status());
    for (const rtc5::SignalInfo& signal : rtc5::map::signals)
        did.answers.push_back(card.parts().recorder.value(signal.number).value());
    did.answers.push_back(card.parts().recorder.recording().period != 0);
    did.answers.push_back(static_cast<UINT>(card.parts().recorder.recording().count) - 1);
    for (std::int64_t i = 0; i < card.parts().recorder.recording().count; ++i)
        did.answers.push_back(card.parts().recorder.recorded(1, i));
    did.answers.push_back(card.parts().recorder.sent());
    return did;
}

TEST(Rtc5simCommands, EveryListCommandHasTheEffectOfTheCardsCommand) {
    std::set<std::string> seen;
    for (const Row& row : list_rows) {
        SCOPED_TRACE(row.name);
        const Did library = by_library(nullptr, &row), card = by_card(nullptr, &row);
        EXPECT_EQ(library.trace.x.size(), std::size_t{ticks});
        EXPECT_EQ(library.answers, card.answers);
        EXPECT_TRUE(library.trace == card.trace);
        seen.insert(row.name);
    }
    EXPECT_EQ(seen.size(), rtc5::op_count - 1) << "all but the empty place";
}

TEST(Rtc5simCommands, EveryControlCommandHasTheEffectOfTheCardsCommand) {
    for (const Row& row : control_rows) {
        SCOPED_TRACE(row.name);
        const Did library = by_library(&row, nullptr), card = by_card(&row, nullptr);
        EXPECT_EQ(library.answers, card.answers);
        EXPECT_TRUE(library.trace == card.trace);
    }
}

TEST(Rtc5simCommands, TheTestedCommandsChangeTheOutputOfTheCard) {
    // The comparison must detect an exchanged or missing parameter.
    const Did without = by_card(nullptr, nullptr);
    for (const Row& row : list_rows)
        for (const std::string_view name : {"arc_abs", "micro_vector_rel", "set_fly_rot", "set_matrix_list"})
            EXPECT_TRUE(row.name != name || !(by_card(nullptr, &row) == without)) << name;
}

}  // namespace
}  // namespace motionrack::rtc5sim_test
