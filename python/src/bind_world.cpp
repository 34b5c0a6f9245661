// A rack: opening, time, wires, quantities, faults, samples, copies.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/template.hpp>
#include <python/src/bindings.hpp>
#include <python/src/turn.hpp>

namespace motionrack::python {

namespace {

using Shared = std::shared_ptr<World>;

Shared opened(const rack::RackReading& reading) {
    if (!reading.config) {
        Raised raised{reading.errors.front(), false, reading.errors};
        throw raised;
    }
    Shared world = std::make_shared<World>(*reading.config);
    attend(*world);
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

py::tuple samples_of(const Sampler& sampler) {
    py::dict signals;
    for (const Channel& channel : sampler.channels())
        signals[py::str(channel.name)] =
            channel.whole ? py::object(array_of(channel.counts)) : py::object(array_of(channel.values));
    return py::make_tuple(array_of(sampler.ticks()), signals);
}

/// Quantities of everything in the rack: {part: {name: meaning}}.
py::dict quantities_of(World& world) {
    py::dict out;
    for (const rack::QuantitiesOfPart& of : rack::quantities_of(world.rack())) {
        py::dict meanings;
        for (const rack::Quantity& one : of.quantities) meanings[py::str(one.name)] = py::str(std::string(one.doc));
        out[py::str(of.part)] = meanings;
    }
    return out;
}

py::dict wires_of(World& world) {
    py::dict out;
    for (const rack::WireAccess::Named& wire : world.desk().names())
        out[py::str(std::string(wire.name))] = py::bool_(wire.drivable);
    return out;
}

py::dict faults_of(World& world) {
    py::dict out;
    for (const rack::FaultTarget& target : rack::fault_targets(world.rack())) {
        py::list names;
        for (const std::string_view name : target.faults) names.append(py::str(std::string(name)));
        out[py::str(target.name)] = names;
    }
    return out;
}

py::list conditions_of(World& world) {
    py::list out;
    rack::Rack& rack = world.running();
    for (const sim::Condition& condition : rack.kernel().conditions())
        out.append(py::make_tuple(condition.at.count(), rack.describe(condition)));
    return out;
}

py::dict config_of_world(World& world) {
    py::dict out;
    out["name"] = world.config().name;
    py::dict cards, axes;
    for (const rack::RackCard& card : world.config().cards) cards[py::str(card.name)] = card.type;
    for (const rack::RackAxis& axis : world.config().axes)
        axes[py::str(std::string(1, axis.letter))] = std::string(axis.unit());
    out["cards"] = cards;
    out["axes"] = axes;
    return out;
}

void bind_looking(py::class_<World, Shared>& world) {
    world.def("config", [](World& w) { return looking(w, [&] { return config_of_world(w); }); })
        .def("closed", &World::closed)
        .def("started", &World::started)
        .def("ticks", [](World& w) { return looking(w, [&] { return w.now().count(); }); })
        .def("events", [](World& w) { return looking(w, [&] { return w.rack().kernel().events(); }); })
        .def("trace_hash",
             [](World& w) { return looking(w, [&] { return hash_text(w.running().kernel().trace_hash()); }); })
        .def("state_hash",
             [](World& w) { return looking(w, [&] { return hash_text(w.running().kernel().state_hash()); }); })
        .def("conditions", [](World& w) { return looking(w, [&] { return conditions_of(w); }); })
        .def(
            "wire",
            [](World& w, const std::string& name) { return looking(w, [&] { return value_of(w.desk().get(name)); }); },
            py::arg("name"))
        .def("wires", [](World& w) { return looking(w, [&] { return wires_of(w); }); })
        .def(
            "quantity",
            [](World& w, const std::string& name) {
                return looking(w, [&] { return value_of(rack::get_quantity(w.running(), name)); });
            },
            py::arg("name"))
        .def("quantities", [](World& w) { return looking(w, [&] { return quantities_of(w); }); })
        .def("fault_targets", [](World& w) { return looking(w, [&] { return faults_of(w); }); })
        .def("not_done", [](World& w) { return looking(w, [&] { return w.not_done(); }); });
}

void bind_moving(py::class_<World, Shared>& world) {
    world
        .def("close",
             [](World& w) {
                 const Turn turn(w, Turn::For::moving);
                 w.close();
             })
        .def("start", [](World& w) { alone(w, [&] { w.running(); }); })
        .def(
            "advance", [](World& w, std::int64_t time) { alone(w, [&] { return w.advance(ticks(time)); }); },
            py::arg("ticks"))
        .def(
            "wait_wire",
            [](World& w, const std::string& name, int level, std::int64_t timeout) {
                return alone(w, [&] { return w.wait_wire(name, level, ticks(timeout)); });
            },
            py::arg("name"), py::arg("level"), py::arg("ticks"))
        .def(
            "set_wire",
            [](World& w, const std::string& name, double value) { alone(w, [&] { return w.set_wire(name, value); }); },
            py::arg("name"), py::arg("value"))
        .def(
            "release_wire",
            [](World& w, const std::string& name) {
                alone(w, [&] { return w.set_wire(name, std::numeric_limits<double>::quiet_NaN()); });
            },
            py::arg("name"))
        .def(
            "set_quantity",
            [](World& w, const std::string& name, double value) {
                alone(w, [&] { return rack::set_quantity(w.running(), name, value); });
            },
            py::arg("name"), py::arg("value"))
        .def(
            "fault",
            [](World& w, const std::string& fault, const std::string& target) {
                alone(w, [&] { return rack::inject_fault(w.running(), fault, target); });
            },
            py::arg("fault"), py::arg("target"))
        .def(
            "plan_faults",
            [](World& w, const std::vector<std::string>& texts) {
                const Turn turn(w, Turn::For::moving);
                value_of(w.plan_faults(texts));
            },
            py::arg("texts"))
        .def(
            "set_card",
            [](World& w, const std::string& card, const std::string& key, double value) {
                const Turn turn(w, Turn::For::moving);
                value_of(w.set_card(card, key, value));
            },
            py::arg("card"), py::arg("key"), py::arg("value"))
        .def(
            "begin_samples",
            [](World& w, const std::vector<std::string>& names, std::int64_t period, std::size_t most) {
                alone(w, [&] { return w.begin_samples(names, ticks(period), most); });
            },
            py::arg("names"), py::arg("period"), py::arg("most"))
        .def("end_samples",
             [](World& w) {
                 const Turn turn(w, Turn::For::moving);
                 return samples_of(value_of(w.end_samples()));
             })
        .def(
            "begin_waves",
            [](World& w, const std::string& path, const std::vector<std::string>& signals) {
                alone(w, [&] { return w.begin_waves(path, signals); });
            },
            py::arg("path"), py::arg("signals"))
        .def("end_waves", [](World& w) { alone(w, [&] { return w.end_waves(); }); })
        .def("copy",
             [](World& w) {
                 Shared out = alone(w, [&] { return w.copy(); });
                 attend(*out);
                 return out;
             })
        .def("fresh",
             [](World& w) {
                 Shared out = looking(w, [&] { return std::make_shared<World>(w.config()); });
                 attend(*out);
                 return out;
             })
        .def(
            "copy_from",
            [](World& w, World& other) {
                if (&w == &other) return;
                const Turn turn(other, Turn::For::moving);
                alone(w, [&] { w.copy_from(other); });
            },
            py::arg("other"));
}

}  // namespace

void bind_world(py::module_& m) {
    py::class_<World, Shared> world(m, "World", "A rack; motionrack.Rack is what people use.");
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
