// Homing of the axes of a rack, and its results.
#include <pybind11/stl.h>

#include <motionrack/rack/homing.hpp>
#include <python/src/bindings.hpp>
#include <python/src/rack_lock.hpp>

namespace motionrack::python {

namespace {

/// Returns (error or None, text, JSON, {axis: SVG}).
py::tuple reported(const rack::HomingOutcome& outcome) {
    py::object error = py::none();
    if (!outcome.ended) {
        const Error& why = outcome.ended.error();
        const char* name = why.kind == ErrorKind::stopped   ? "Stopped"
                           : why.kind == ErrorKind::machine ? "MachineFault"
                                                            : "Refused";
        error = py::module_::import("motionrack.errors")
                    .attr(name)(why.message, why.file, why.location.line, why.location.column);
    }
    py::dict pictures;
    for (const rack::HomedAxis& axis : outcome.axes)
        if (axis.begun) pictures[py::str(std::string(1, axis.letter))] = rack::homing_picture(axis);
    return py::make_tuple(error, rack::homing_text(outcome), rack::homing_json(outcome), pictures);
}

}  // namespace

void bind_homing(py::module_& m) {
    m.def(
        "home",
        [](RackHandle& world, const std::string& axes, std::optional<int> type, std::int64_t timeout) {
            if (type && (*type < 1 || *type > 4))
                refuse("The homing method is " + std::to_string(*type) + "; it must be 1 to 4. Nothing was moved.");
            rack::HomingSettings settings;
            settings.axes = axes;
            settings.method = type;
            settings.timeout = timeout_of(timeout);
            return reported(run_exclusive(world, [&] { return world.home(settings); }));
        },
        py::arg("world"), py::arg("axes"), py::arg("type"), py::arg("ticks"));
}

}  // namespace motionrack::python
