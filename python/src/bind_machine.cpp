// A machine operated step by step: programs with feed hold and resume, jogging, homing, alarms.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <limits>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/homing.hpp>
#include <motionrack/rack/quantities.hpp>
#include <python/src/bindings.hpp>
#include <python/src/rack_lock.hpp>
#include <python/src/stepped_machine.hpp>

namespace motionrack::python {

namespace {

using operate::Machine;
using Class = py::class_<SteppedMachine>;
using Done = Result<void>;

/// Executes a command without the GIL.
template <class Work>
auto ordered(SteppedMachine& self, Work work) {
    auto result = [&] {
        const py::gil_scoped_release free;
        return self.execute(work);
    }();
    return value_of(std::move(result));
}

char only_letter(const std::string& axis) {
    if (axis.size() != 1)
        refuse(fmt::format("An axis is one letter, X to Z or A to C, not \"{}\". Nothing was done.", axis));
    return axis[0];
}

void advance(SteppedMachine& self, std::int64_t time) {
    if (time < 0) refuse("Time cannot run backwards; nothing was run.");
    std::optional<py::error_already_set> raised;
    {
        const py::gil_scoped_release free;
        self.advance(ticks(time), [&] {
            const py::gil_scoped_acquire lock;
            if (!raised && PyErr_CheckSignals() != 0) raised.emplace();
            return raised.has_value();
        });
    }
    if (raised) throw py::error_already_set(*raised);
}

py::dict dict_of(const operate::AxisStatus& axis) {
    py::dict out;
    out["unit"] = axis.rotary ? "deg" : "mm";
    out["position_valid"] = axis.position_valid;
    out["enabled"] = axis.enabled;
    out["commanded"] = axis.commanded;
    out["actual"] = axis.actual;
    out["true_position"] = axis.true_position;
    out["velocity"] = axis.velocity;
    out["pulses"] = axis.pulses;
    out["counts"] = axis.counts;
    return out;
}

py::dict dict_of(const operate::Status& status) {
    py::dict out, axes;
    for (const operate::AxisStatus& axis : status.axes) axes[py::str(std::string(1, axis.letter))] = dict_of(axis);
    py::list alarms;
    for (const operate::Alarm& alarm : status.alarms)
        alarms.append(py::make_tuple(alarm.number, to_seconds(alarm.at), alarm.source, alarm.text, alarm.active,
                                     alarm.acknowledged));
    out["seconds"] = to_seconds(status.at);
    out["ticks"] = status.at.count();
    out["state"] = std::string(operate::name_of(status.state));
    out["reason"] = status.reason;
    out["axes"] = axes;
    out["program"] = status.program;
    out["line"] = status.line;
    out["lines"] = status.lines;
    out["program_runs"] = status.program_runs;
    out["feed_override"] = status.feed_override;
    out["rapid_override"] = status.rapid_override;
    out["homing"] = rack::homing_states_text(status.homing);
    out["alarms"] = alarms;
    return out;
}

void bind_manual_operation(Class& c) {
    c.def(
        "home",
        [](SteppedMachine& self, const std::string& axes) {
            ordered(self, [&](Machine& machine) { return machine.manual().home(axes); });
        },
        py::arg("axes"));
    c.def(
        "jog",
        [](SteppedMachine& self, const std::string& axis, double speed) {
            ordered(self,
                    [&, which = only_letter(axis)](Machine& machine) { return machine.manual().jog(which, speed); });
        },
        py::arg("axis"), py::arg("speed"));
    c.def(
        "jog_by",
        [](SteppedMachine& self, const std::string& axis, double distance, double speed) {
            ordered(self, [&, which = only_letter(axis)](Machine& machine) {
                return machine.manual().jog_by(which, distance, speed);
            });
        },
        py::arg("axis"), py::arg("distance"), py::arg("speed"));
    c.def(
        "set_position",
        [](SteppedMachine& self, const std::string& axis, double position) {
            ordered(self, [&, which = only_letter(axis)](Machine& machine) {
                return machine.manual().set_position(which, position);
            });
        },
        py::arg("axis"), py::arg("position"));
}

void bind_orders(Class& c) {
    const auto plain = [&](const char* name, auto command) {
        c.def(name, [command](SteppedMachine& self) {
            ordered(self, [command](Machine& machine) -> Done { return command(machine); });
        });
    };
    plain("hold", [](Machine& machine) { return machine.hold(); });
    plain("resume", [](Machine& machine) { return machine.resume(); });
    plain("stop", [](Machine& machine) { return machine.stop({"a program in Python", "", "STOP"}), Done(); });
    plain("reset", [](Machine& machine) { return machine.reset(), Done(); });
    c.def(
        "enable",
        [](SteppedMachine& self, bool on, const std::string& axes) {
            ordered(self, [&](Machine& machine) { return machine.enable(on, axes); });
        },
        py::arg("on"), py::arg("axes"));
    c.def(
        "start_program",
        [](SteppedMachine& self, const std::string& program, const std::string& name) {
            ordered(self, [&](Machine& machine) { return machine.begin_program(program, name); });
        },
        py::arg("program"), py::arg("name"));
    c.def(
        "set_overrides",
        [](SteppedMachine& self, double feed, double rapid) {
            if (!(feed > 0 && feed <= 2 && rapid > 0 && rapid <= 1))
                refuse(fmt::format(
                    "The overrides are {} and {}; feed is more than 0 up to 2, rapid up to 1. Nothing was changed.",
                    feed, rapid));
            ordered(self, [&](Machine& machine) { return machine.programs().set_overrides(feed, rapid), Done(); });
        },
        py::arg("feed"), py::arg("rapid"));
    c.def(
        "acknowledge_alarm",
        [](SteppedMachine& self, std::int64_t alarm) {
            return ordered(self, [&](Machine& machine) { return Result<bool>(machine.acknowledge_alarm(alarm)); });
        },
        py::arg("alarm"));
}

void bind_rest(Class& c) {
    c.def("advance", &advance, py::arg("ticks"));
    c.def("status", [](SteppedMachine& self) {
        ordered(self, [](Machine&) { return Done(); });  // the loop publishes a status after it has processed its inbox
        return dict_of(ordered(self, [](Machine& machine) { return Result<operate::Status>(machine.status()); }));
    });
    c.def("trace_hash", [](SteppedMachine& self) {
        return ordered(self, [](Machine& machine) {
            return Result<std::string>(fmt::format("{:016x}", machine.rack().kernel().trace_hash()));
        });
    });
    c.def(
        "wire",
        [](SteppedMachine& self, const std::string& name) {
            return ordered(self, [&](Machine& machine) { return machine.wires().get(name); });
        },
        py::arg("name"));
    c.def(
        "set_wire",
        [](SteppedMachine& self, const std::string& name, std::optional<double> value) {
            ordered(self, [&](Machine& machine) {
                return machine.wires().force(name, value.value_or(std::numeric_limits<double>::quiet_NaN()));
            });
        },
        py::arg("name"), py::arg("value"));
    c.def(
        "quantity",
        [](SteppedMachine& self, const std::string& name) {
            return ordered(self, [&](Machine& machine) { return rack::get_quantity(machine.rack(), name); });
        },
        py::arg("name"));
    c.def(
        "fault",
        [](SteppedMachine& self, const std::string& fault, const std::string& target) {
            ordered(self, [&](Machine& machine) { return rack::inject_fault(machine.rack(), fault, target); });
        },
        py::arg("fault"), py::arg("target"));
}

}  // namespace

void bind_machine(py::module_& m) {
    Class c(m, "SteppedMachine", "A machine; use motionrack.Machine.");
    c.def(py::init([](RackHandle& world) {
              const RackLock turn(world, RackLock::Access::run);
              return value_of(SteppedMachine::make(world.config()));
          }),
          py::arg("world"));
    bind_orders(c);
    bind_manual_operation(c);
    bind_rest(c);
}

}  // namespace motionrack::python
