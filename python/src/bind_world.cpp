// Rack: opening, time, wires, quantities, faults, samples, copies.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/mcx314_card.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/reported_condition.hpp>
#include <motionrack/rack/template.hpp>
#include <python/src/bindings.hpp>
#include <python/src/rack_lock.hpp>

namespace motionrack::python {

namespace {

using Shared = std::shared_ptr<RackHandle>;

Shared opened(const rack::RackReading& reading) {
    if (!reading.config) {
        PythonError raised{reading.errors.front(), false, reading.errors};
        throw raised;
    }
    Shared world = std::make_shared<RackHandle>(*reading.config);
    poll_python(*world);
    return world;
}

std::vector<std::string> warnings_of(const rack::RackReading& reading) {
    std::vector<std::string> out;
    for (const Error& warning : reading.warnings) out.push_back(warning.text());
    return out;
}

std::string hash_text(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

template <class T>
py::array_t<T> array_of(const std::vector<T>& values) {
    return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::tuple samples_of(const SampleTable& table) {
    py::dict signals, units;
    for (const SampleTable::Column& column : table.columns()) {
        const py::str name(column.channel.name);
        signals[name] = column.is_whole() ? py::object(array_of(column.counts)) : py::object(array_of(column.values));
        units[name] = py::str(std::string(column.channel.unit));
    }
    return py::make_tuple(array_of(table.ticks()), signals, units);
}

/// Returns the quantities of the whole rack: {part: {name: meaning}}.
py::dict quantities_of(RackHandle& world) {
    py::dict out;
    for (const rack::QuantitiesOfPart& of : rack::quantities_of(world.rack())) {
        py::dict meanings;
        for (const rack::Quantity& one : of.quantities) meanings[py::str(one.name)] = py::str(std::string(one.doc));
        out[py::str(of.part)] = meanings;
    }
    return out;
}

py::dict wires_of(RackHandle& world) {
    py::dict out;
    for (const rack::WireAccess::Named& wire : world.context().names())
        out[py::str(std::string(wire.name))] = py::bool_(wire.drivable);
    return out;
}

py::dict faults_of(RackHandle& world) {
    py::dict out;
    for (const rack::FaultTarget& target : rack::fault_targets(world.rack())) {
        py::list names;
        for (const std::string_view name : target.faults) names.append(py::str(std::string(name)));
        out[py::str(target.name)] = names;
    }
    return out;
}

py::list conditions_of(RackHandle& world) {
    py::list out;
    for (const rack::ReportedCondition& one : rack::reported_conditions(world.running()))
        out.append(py::make_tuple(one.number, one.at.count(), one.source, one.code, one.sentence));
    return out;
}

/// Returns the axes driven by channels of original MCX314s, each with its counter and its velocity limit in pulses/s.
/// Omits those of an MCX314As, which may set its counters by itself.
py::dict channels_of(const rack::RackConfig& config) {
    py::dict out;
    for (const rack::PulseLink& link : config.pulse_links) {
        const rack::RackCard& card = config.cards[static_cast<std::size_t>(link.card)];
        const rack::RackAxis& axis = config.axes[static_cast<std::size_t>(link.axis)];
        if (card.type == "mcx314" && rack::mcx314_in(card).variant == rack::Mcx314Variant::mcx314 && !axis.servo)
            out[py::str(std::string(1, axis.letter))] =
                py::make_tuple(card.name, fmt::format("{}.LP", "xyzu"[link.channel]), axis.max_pulse_hz());
    }
    return out;
}

py::dict config_of_world(RackHandle& world) {
    py::dict out;
    out["name"] = world.config().name;
    out["channels"] = channels_of(world.config());
    py::dict cards, axes;
    for (const rack::RackCard& card : world.config().cards) cards[py::str(card.name)] = card.type;
    for (const rack::RackAxis& axis : world.config().axes)
        axes[py::str(std::string(1, axis.letter))] = std::string(axis.unit());
    out["cards"] = cards;
    out["axes"] = axes;
    return out;
}

void bind_looking(py::class_<RackHandle, Shared>& world) {
    world.def("config", [](RackHandle& w) { return inspect_rack(w, [&] { return config_of_world(w); }); })
        .def("closed", &RackHandle::closed)
        .def("started", &RackHandle::started)
        .def("ticks", [](RackHandle& w) { return inspect_rack(w, [&] { return w.now().count(); }); })
        .def("events", [](RackHandle& w) { return inspect_rack(w, [&] { return w.rack().kernel().events(); }); })
        .def(
            "trace_hash",
            [](RackHandle& w) { return inspect_rack(w, [&] { return hash_text(w.running().kernel().trace_hash()); }); })
        .def(
            "state_hash",
            [](RackHandle& w) { return inspect_rack(w, [&] { return hash_text(w.running().kernel().state_hash()); }); })
        .def("conditions", [](RackHandle& w) { return inspect_rack(w, [&] { return conditions_of(w); }); })
        .def(
            "wire",
            [](RackHandle& w, const std::string& name) {
                return inspect_rack(w, [&] { return value_of(w.context().get(name)); });
            },
            py::arg("name"))
        .def("wires", [](RackHandle& w) { return inspect_rack(w, [&] { return wires_of(w); }); })
        .def(
            "quantity",
            [](RackHandle& w, const std::string& name) {
                return inspect_rack(w, [&] { return value_of(rack::get_quantity(w.running(), name)); });
            },
            py::arg("name"))
        .def("quantities", [](RackHandle& w) { return inspect_rack(w, [&] { return quantities_of(w); }); })
        .def("fault_targets", [](RackHandle& w) { return inspect_rack(w, [&] { return faults_of(w); }); })
        .def("not_done", [](RackHandle& w) { return inspect_rack(w, [&] { return w.not_done(); }); });
}

void bind_moving(py::class_<RackHandle, Shared>& world) {
    world
        .def("close",
             [](RackHandle& w) {
                 const RackLock turn(w, RackLock::Access::run);
                 value_of(w.close());
             })
        .def("start", [](RackHandle& w) { run_exclusive(w, [&] { w.running(); }); })
        .def(
            "advance",
            [](RackHandle& w, std::int64_t time) { run_exclusive(w, [&] { return w.advance(ticks(time)); }); },
            py::arg("ticks"))
        .def(
            "wait_wire",
            [](RackHandle& w, const std::string& name, int level, std::int64_t timeout) {
                return run_exclusive(w, [&] { return w.wait_wire(name, level, ticks(timeout)); });
            },
            py::arg("name"), py::arg("level"), py::arg("ticks"))
        .def(
            "set_wire",
            [](RackHandle& w, const std::string& name, double value) {
                run_exclusive(w, [&] { return w.set_wire(name, value); });
            },
            py::arg("name"), py::arg("value"))
        .def(
            "release_wire",
            [](RackHandle& w, const std::string& name) {
                run_exclusive(w, [&] { return w.set_wire(name, std::numeric_limits<double>::quiet_NaN()); });
            },
            py::arg("name"))
        .def(
            "set_quantity",
            [](RackHandle& w, const std::string& name, double value) {
                run_exclusive(w, [&] { return rack::set_quantity(w.running(), name, value); });
            },
            py::arg("name"), py::arg("value"))
        .def(
            "fault",
            [](RackHandle& w, const std::string& fault, const std::string& target) {
                run_exclusive(w, [&] { return rack::inject_fault(w.running(), fault, target); });
            },
            py::arg("fault"), py::arg("target"))
        .def(
            "plan_faults",
            [](RackHandle& w, const std::vector<std::string>& texts) {
                const RackLock turn(w, RackLock::Access::run);
                value_of(w.plan_faults(texts));
            },
            py::arg("texts"))
        .def(
            "set_card",
            [](RackHandle& w, const std::string& card, const std::string& key, double value) {
                const RackLock turn(w, RackLock::Access::run);
                value_of(w.set_card(card, key, value));
            },
            py::arg("card"), py::arg("key"), py::arg("value"))
        .def(
            "begin_samples",
            [](RackHandle& w, const std::vector<std::string>& names, std::int64_t period, std::size_t max_samples) {
                run_exclusive(w, [&] { return w.begin_samples(names, ticks(period), max_samples); });
            },
            py::arg("names"), py::arg("period"), py::arg("max_samples"))
        .def("end_samples",
             [](RackHandle& w) {
                 const RackLock turn(w, RackLock::Access::run);
                 return samples_of(*value_of(w.end_samples()));
             })
        .def(
            "begin_waves",
            [](RackHandle& w, const std::string& path, const std::vector<std::string>& signals) {
                run_exclusive(w, [&] { return w.begin_waves(path, signals); });
            },
            py::arg("path"), py::arg("signals"))
        .def("end_waves", [](RackHandle& w) { run_exclusive(w, [&] { return w.end_waves(); }); })
        .def("copy",
             [](RackHandle& w) {
                 Shared out = run_exclusive(w, [&] { return w.copy(); });
                 poll_python(*out);
                 return out;
             })
        .def("new_instance",
             [](RackHandle& w) {
                 Shared out = inspect_rack(w, [&] { return std::make_shared<RackHandle>(w.config()); });
                 poll_python(*out);
                 return out;
             })
        .def(
            "copy_from",
            [](RackHandle& w, RackHandle& other) {
                if (&w == &other) return;
                const RackLock turn(other, RackLock::Access::run);
                run_exclusive(w, [&] { w.copy_from(other); });
            },
            py::arg("other"));
}

}  // namespace

void bind_world(py::module_& m) {
    py::class_<RackHandle, Shared> world(m, "RackHandle", "A rack; use motionrack.Rack.");
    bind_looking(world);
    bind_moving(world);
    m.def(
        "open_file",
        [](const std::string& path) {
            const rack::RackReading reading = rack::read_rack_file(path);
            return py::make_tuple(opened(reading), warnings_of(reading));
        },
        py::arg("path"));
    m.def(
        "open_text",
        [](const std::string& text, const std::string& name) {
            const rack::RackReading reading = rack::read_rack_text(text, name);
            return py::make_tuple(opened(reading), warnings_of(reading));
        },
        py::arg("text"), py::arg("name"));
    m.def(
        "template_text", [](const std::string& name) { return value_of(rack::rack_template(name)); }, py::arg("name"));
    m.def("template_names", [] {
        std::vector<std::string> out;
        for (const rack::TemplateVariant& variant : rack::template_variants()) out.emplace_back(variant.name);
        return out;
    });
}

}  // namespace motionrack::python
