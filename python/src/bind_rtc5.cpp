// RTC5 commands on a card of a rack. The list commands come from the card's map: one row, one method.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <python/src/rtc5.hpp>

namespace motionrack::python {

namespace {

using rtc5::Engine;

/// Rejects a parameter that the equivalent list command would reject.
Result<void> check_parameter(rtc5::Op op, double parameter) {
    MOTIONRACK_CHECK(rtc5::list_command(op, {parameter}));
    return {};
}

std::string doc_of(const rtc5::ListCommandInfo& command) {
    std::vector<std::string> parameters;
    std::string ranges;
    for (int i = 0; i < command.param_count(); ++i) {
        const rtc5::ParamInfo& param = command.params[static_cast<std::size_t>(i)];
        const rtc5::KindInfo kind = rtc5::kind_info(param.kind);
        parameters.push_back(fmt::format("{}: float", param.name));
        ranges += fmt::format(" {} {:.10g} to {:.10g}{}{}.", param.name, kind.min, kind.max,
                              kind.unit.empty() ? "" : " ", kind.unit);
    }
    return fmt::format("{}\n\nList command: {}.{}", signature(command.name, parameters, "None"), command.meaning,
                       ranges);
}

/// Binds the list commands of the card's map: one row, one method.
void bind_list_commands(Rtc5Class& c) {
    py::options options;
    options.disable_function_signatures();
    for (const rtc5::ListCommandInfo& command : rtc5::map::list_commands) {
        if (command.op == rtc5::Op::none) continue;
        std::vector<std::string_view> names;
        for (int i = 0; i < command.param_count(); ++i)
            names.push_back(command.params[static_cast<std::size_t>(i)].name);
        c.def(
            std::string(command.name).c_str(),
            [&command, names](Rtc5& self, const py::args& by_place, const py::kwargs& by_name) {
                const std::vector<double> given = numbers_given(command.name, names, by_place, by_name);
                rtc5::Refusal refusal = rtc5::Refusal::parameter;
                order(
                    self,
                    [&](Engine& engine) -> Result<void> {
                        MOTIONRACK_TRY(const rtc5::Command made, rtc5::list_command(command.op, given));
                        refusal = rtc5::Refusal::rejected;
                        return engine.put(made);
                    },
                    refusal);
            },
            doc_of(command).c_str());
    }
}

void bind_lists(Rtc5Class& c) {
    c.def(
        "set_start_list",
        [](Rtc5& self, std::uint32_t list, std::int64_t position) {
            order(self, [&](Engine& engine) { return engine.set_start_list(list, position); });
        },
        py::arg("ListNo"), py::arg("Pos") = 0, "List commands go to list 1 or 2 from here on, from that position.");
    c.def(
        "load_list",
        [](Rtc5& self, std::uint32_t list, std::int64_t position) {
            return ask(self, [&](Engine& engine) { return engine.parts().lists.load_list(list, position); });
        },
        py::arg("ListNo"), py::arg("Pos") = 0,
        "As set_start_list, for a list that is not running: 1, 2, 0 (the free one) or 3 (free and run to its end); "
        "returns the opened list, or 0.");
    c.def(
        "load_sub",
        [](Rtc5& self, std::uint32_t index) {
            order(self, [&](Engine& engine) { return engine.parts().lists.load_sub(index); });
        },
        py::arg("index"), "The commands up to list_return become subroutine 0 to 1023.");
    c.def(
        "config_list",
        [](Rtc5& self, std::int64_t list1, std::int64_t list2) {
            order(
                self, [&](Engine& engine) { return engine.parts().lists.configure(list1, list2); },
                rtc5::Refusal::busy);
        },
        py::arg("list1"), py::arg("list2"), "Positions of list 1 and list 2; -1: the rest.");
    c.def(
        "execute_list",
        [](Rtc5& self, std::uint32_t list, std::int64_t position) {
            order(
                self, [&](Engine& engine) { return engine.execute_list(list, position); }, rtc5::Refusal::busy);
        },
        py::arg("ListNo"), py::arg("Pos") = 0, "Starts list 1 or 2.");
}

/// Binds the commands without parameters.
void bind_plain(Rtc5Class& c) {
    const auto plain = [&](const char* name, void (*function)(Engine&), const char* doc) {
        c.def(
            name, [function](Rtc5& self) { order(self, [&](Engine& engine) { function(engine); }); }, doc);
    };
    plain(
        "auto_change", [](Engine& engine) { engine.parts().execution.auto_change(); },
        "The other list starts when this one ends.");
    plain(
        "start_loop", [](Engine& engine) { engine.parts().execution.start_loop(); }, "Lists 1 and 2 run in turn.");
    plain(
        "quit_loop", [](Engine& engine) { engine.parts().execution.quit_loop(); },
        "Ends the alternation of the lists.");
    plain(
        "pause_list", [](Engine& engine) { engine.pause_list(); }, "Holds the list.");
    plain(
        "restart_list", [](Engine& engine) { engine.restart_list(); }, "Continues the list after pause_list.");
    plain(
        "stop_execution", [](Engine& engine) { engine.stop_execution(); }, "Ends the list at once.");
    plain(
        "external_start", [](Engine& engine) { engine.parts().starts.trigger(); }, "Simulates a start signal.");
    plain(
        "external_stop", [](Engine& engine) { engine.external_stop(); }, "Simulates a stop signal.");
    plain(
        "enable_laser", [](Engine& engine) { engine.parts().laser.enable(); }, "Enables the laser's signals.");
    plain(
        "disable_laser", [](Engine& engine) { engine.parts().laser.disable(); }, "Disables the laser's signals.");
}

void bind_settings(Rtc5Class& c) {
    c.def(
        "goto_xy",
        [](Rtc5& self, double x, double y) {
            order(
                self, [&](Engine& engine) { return engine.goto_xy(x, y); }, rtc5::Refusal::busy);
        },
        py::arg("x"), py::arg("y"), "Jumps to X and Y, bits, while no list runs.");
    const auto speed = [&](const char* name, rtc5::Op op, void (rtc5::PathGenerator::*function)(double),
                           const char* doc) {
        c.def(
            name,
            [op, function](Rtc5& self, double bits_ms) {
                order(self, [&](Engine& engine) -> Result<void> {
                    MOTIONRACK_CHECK(check_parameter(op, bits_ms));
                    (engine.parts().path.*function)(bits_ms);
                    return {};
                });
            },
            py::arg("bits_ms"), doc);
    };
    speed("set_jump_speed_ctrl", rtc5::Op::set_jump_speed, &rtc5::PathGenerator::set_jump_speed,
          "Jump speed, 1.6 to 800,000 bits/ms.");
    speed("set_mark_speed_ctrl", rtc5::Op::set_mark_speed, &rtc5::PathGenerator::set_mark_speed,
          "Mark speed, 1.6 to 800,000 bits/ms.");
    c.def(
        "set_control_mode",
        [](Rtc5& self, std::uint32_t mode) {
            order(self, [&](Engine& engine) -> Result<void> {
                MOTIONRACK_CHECK(check_parameter(rtc5::Op::set_control_mode_list, mode));
                engine.set_control_mode(mode);
                return {};
            });
        },
        py::arg("mode"), "Bit 0: the start line starts a list.");
    c.def(
        "set_matrix",
        [](Rtc5& self, int head, std::array<double, 4> matrix, int at_once) {
            order(self, [&](Engine& engine) { return engine.parts().heads.set_matrix(head, matrix, at_once); });
        },
        py::arg("head"), py::arg("matrix"), py::arg("at_once") = 1, "Matrix m11, m12, m21, m22 of a head, 1 to 4.");
    c.def(
        "set_offset",
        [](Rtc5& self, int head, double x, double y, int at_once) {
            order(self, [&](Engine& engine) { return engine.parts().heads.set_offset(head, {x, y}, at_once); });
        },
        py::arg("head"), py::arg("x"), py::arg("y"), py::arg("at_once") = 1, "Offset of a head, bits.");
    c.def(
        "set_angle",
        [](Rtc5& self, int head, double degrees, int at_once) {
            order(self, [&](Engine& engine) { return engine.parts().heads.set_angle(head, degrees, at_once); });
        },
        py::arg("head"), py::arg("degrees"), py::arg("at_once") = 1, "Rotation of a head, degrees.");
    c.def(
        "set_scale",
        [](Rtc5& self, int head, double scale, int at_once) {
            order(self, [&](Engine& engine) { return engine.parts().heads.set_scale(head, scale, at_once); });
        },
        py::arg("head"), py::arg("scale"), py::arg("at_once") = 1, "Scale of a head.");
}

void bind_answers(Rtc5Class& c) {
    c.def(
        "read_status",
        [](Rtc5& self) {
            return ask(self, [](Engine& engine) -> Result<std::uint32_t> { return engine.parts().lists.status(); });
        },
        "Status of the lists, as read_status.");
    c.def(
        "get_status",
        [](Rtc5& self) {
            return ask(self, [](Engine& engine) -> Result<std::pair<std::uint32_t, std::int64_t>> {
                return std::pair(engine.status(), engine.parts().execution.position());
            });
        },
        "(status, position in the list).");
    c.def(
        "get_marking_info",
        [](Rtc5& self) {
            return ask(self, [](Engine& e) -> Result<std::uint32_t> { return e.parts().flags.take_marking_info(); });
        },
        "Errors of marking, bits; reading clears them. See marking_info_text.");
    c.def_static(
        "marking_info_text", [](std::uint32_t bits) { return rtc5::decoded(bits, rtc5::map::marking_info_bits); },
        py::arg("bits"), "A sentence for each bit.");
    c.def(
        "get_startstop_info",
        [](Rtc5& self) {
            return ask(self, [](Engine& engine) -> Result<std::uint32_t> { return engine.get_startstop_info(); });
        },
        "Events of the start and stop lines, bits.");
    c.def(
        "get_value",
        [](Rtc5& self, std::uint32_t signal) {
            return ask(self, [&](Engine& engine) { return engine.parts().recorder.value(signal); });
        },
        py::arg("signal"), "A signal by its number, 0 to 255.");
    c.def(
        "get_encoder",
        [](Rtc5& self) {
            return ask(self, [](Engine& engine) -> Result<std::pair<int, int>> {
                return std::pair(engine.encoder(0), engine.encoder(1));
            });
        },
        "(encoder 0, encoder 1), counts.");
    c.def(
        "list_space",
        [](Rtc5& self) {
            return order(self, [](Engine& engine) { return engine.state().lists.input_end - engine.input_pointer(); });
        },
        "Free positions of the open list.");
    c.def(
        "busy", [](Rtc5& self) { return order(self, [](Engine& engine) { return engine.busy(); }); },
        "Whether a list runs; takes no time.");
    c.def(
        "output",
        [](Rtc5& self) {
            return order(self, [](Engine& engine) {
                return std::tuple(engine.output().a[0], engine.output().a[1], engine.state().laser.on != 0);
            });
        },
        "Position of head A (bits), and whether its laser is on; takes no time.");
    c.def(
        "wait",
        [](Rtc5& self, double timeout) {
            const Duration time = duration(timeout);
            run_exclusive(
                *self.world,
                [&]() -> Result<void> {
                    const Instant end = later(self.world->now(), time);
                    while (!self.engine().at_rest()) {
                        if (self.world->now() >= end)
                            return fail(ErrorKind::machine,
                                        fmt::format("The card did not stop within {:.6g} s; its list continues.",
                                                    to_seconds(time)));
                        MOTIONRACK_CHECK(
                            self.world->advance(std::min(Duration(microseconds(100)), end - self.world->now())));
                    }
                    return {};
                },
                time);
        },
        py::arg("timeout") = 60.0, "Waits for standstill of the card; Timeout after timeout s.");
    c.def_property(
        "question_seconds", [](const Rtc5& self) { return to_seconds(self.question_time); },
        [](Rtc5& self, double seconds) {
            const Duration time = duration(seconds);
            if (time > whole_seconds(1000)) refuse("The duration of a query must be 0 to 1000 s.");
            self.question_time = time;
        },
        "Duration of a query, s; initially 10 us.");
}

}  // namespace

void bind_rtc5(py::module_& m) {
    Rtc5Class c(
        m, "Rtc5",
        "The RTC5's commands under their documented names, in bits, bits/ms and 10 us: every one of rtc5sim.h. "
        "List commands go to the list that set_start_list has opened. A call that is out of range, or not possible "
        "now, is refused: nothing is changed, Refused has the sentence and get_last_error the board's bits. "
        "Source of the list commands: the maker's header of the RTC5 of 2013, and of those with position words "
        "the RTC5 manual 1.10 d (German), page 198.");
    c.def(py::init([](const std::shared_ptr<RackHandle>& world, const std::string& card) {
              const RackLock turn(*world, RackLock::Access::run);
              card_of_type(*world, card, "rtc5");
              return Rtc5{world, rack::rtc5_card_of(world->running(), card)};
          }),
          py::arg("world"), py::arg("card"));
    bind_list_commands(c);
    bind_lists(c);
    bind_plain(c);
    bind_settings(c);
    bind_answers(c);
    bind_rtc5_controls(c);
    bind_rtc5_files(c);
}

}  // namespace motionrack::python
