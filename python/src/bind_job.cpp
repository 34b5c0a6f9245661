// A part program on a rack, and its outcome.
#include <fmt/format.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <motionrack/rack/job_report.hpp>
#include <motionrack/trace/csv_writer.hpp>
#include <motionrack/trace/report.hpp>
#include <motionrack/trace/svg.hpp>
#include <python/src/bindings.hpp>
#include <python/src/rack_lock.hpp>

namespace motionrack::python {

namespace {

/// An executed program with its rack, which holds the samples until its next run.
struct Ran {
    std::shared_ptr<RackHandle> world;
    rack::JobOutcome outcome;
    std::optional<trace::ReportData> kept = {};

    trace::ReportData report() const {
        if (kept) return *kept;
        return rack::report_of(world->running(), *world->job(), outcome, world->program(), world->program_name());
    }
};

template <class T, class Get>
py::array_t<T> series(const std::vector<rack::MonitorSample>& samples, Get get) {
    py::array_t<T> out(static_cast<py::ssize_t>(samples.size()));
    T* at = out.mutable_data();
    for (const rack::MonitorSample& sample : samples) *at++ = static_cast<T>(get(sample));
    return out;
}

std::string letter_of(int index) {
    return std::string(1, control::axis_letters[static_cast<std::size_t>(index)]);
}

/// Returns (ticks, {signal: values}) recorded by the monitor.
py::tuple samples_of(const Ran& ran) {
    const rack::Monitor& monitor = ran.world->job()->monitor();
    const std::vector<rack::MonitorSample>& samples = monitor.samples();
    py::dict signals;
    const auto add = [&](int index, const char* what, auto get) {
        signals[py::str(letter_of(index) + "." + what)] = series<double>(samples, get);
    };
    for (const rack::AxisOutcome& axis : ran.outcome.axes) {
        const auto i = static_cast<std::size_t>(axis.index);
        add(axis.index, "position", [i](const rack::MonitorSample& sample) { return sample.position[i]; });
        add(axis.index, "velocity", [i](const rack::MonitorSample& sample) { return sample.velocity[i]; });
        add(axis.index, "accel", [i](const rack::MonitorSample& sample) { return sample.accel[i]; });
        if (axis.servo) add(axis.index, "volts", [i](const rack::MonitorSample& sample) { return sample.volts[i]; });
    }
    signals["deviation"] =
        py::array_t<double>(static_cast<py::ssize_t>(monitor.deviations().size()), monitor.deviations().data());
    return py::make_tuple(
        series<std::int64_t>(samples, [](const rack::MonitorSample& sample) { return sample.at.count(); }), signals);
}

py::dict dict_of(const rack::AxisOutcome& axis) {
    py::dict out;
    out["axis"] = letter_of(axis.index);
    out["unit"] = axis.unit;
    out["servo"] = axis.servo;
    out["min_position"] = axis.limits.min_position;
    out["max_position"] = axis.limits.max_position;
    out["max_velocity"] = axis.limits.max_velocity;
    out["max_accel"] = axis.limits.max_accel;
    out["pulses_sent"] = axis.pulses_sent;
    out["pulses_net"] = axis.pulses_net;
    out["pulse_position"] = axis.pulse_position;
    out["pulse_start"] = axis.pulse_start;
    out["encoder_counts"] = axis.encoder_counts;
    out["expected_counts"] = axis.expected_counts;
    out["lost_pulses"] = axis.lost_pulses;
    out["planned_end"] = axis.planned_end;
    out["actual_end"] = axis.actual_end;
    out["peak_velocity"] = axis.top.peak_velocity;
    out["peak_accel"] = axis.top.peak_accel;
    out["peak_velocity_step"] = axis.top.peak_velocity_step;
    return out;
}

py::list blocks_of(const rack::Monitor& monitor) {
    static constexpr const char* kinds[] = {"rapid", "feed", "arc", "dwell"};
    py::list out;
    for (const rack::ExecutedMove& block : monitor.blocks()) {
        py::dict one;
        one["move"] = block.block;
        one["line"] = block.line;
        one["kind"] = kinds[static_cast<std::size_t>(block.kind)];
        one["length"] = block.length;
        one["entry_velocity"] = block.entry_velocity;
        one["cruise_velocity"] = block.cruise_velocity;
        one["exit_velocity"] = block.exit_velocity;
        one["start"] = to_seconds(block.start);
        one["end"] = to_seconds(block.end);
        one["deviation_mm"] = block.deviation_mm;
        out.append(one);
    }
    return out;
}

void add_plan(py::dict& out, const rack::JobOutcome& outcome) {
    out["planned_duration_s"] = outcome.run.plan.seconds;
    out["moves"] = outcome.run.plan.moves;
    out["dwells"] = outcome.run.plan.dwells;
    out["stops"] = outcome.run.plan.stops;
    out["peak_path_velocity"] = outcome.run.plan.peak_velocity;
    out["lines"] = outcome.run.lines;
    out["moves_read"] = outcome.run.moves;
    out["program_ended"] = outcome.run.ended;
    py::list events;
    for (const control::ProgramEvent& event : outcome.run.events)
        events.append(py::make_tuple(event.line, event.after_move, event.text));
    out["program_events"] = events;
    out["program_events_left_out"] = outcome.run.events_left_out;
}

/// Returns all fields of JobOutcome.
py::dict dict_of(const Ran& ran) {
    const rack::JobOutcome& outcome = ran.outcome;
    py::dict out;
    add_plan(out, outcome);
    out["ticks"] = outcome.time.count();
    out["path_mm"] = outcome.path_mm;
    py::list axes, warnings;
    for (const rack::AxisOutcome& axis : outcome.axes) axes.append(dict_of(axis));
    out["axes"] = axes;
    out["max_deviation_mm"] = outcome.max_deviation.mm;
    out["max_deviation_ticks"] = outcome.max_deviation.at.count();
    out["max_deviation_line"] = outcome.max_deviation.line;
    out["max_deviation_position"] = py::make_tuple(outcome.max_deviation.position[0], outcome.max_deviation.position[1],
                                                   outcome.max_deviation.position[2]);
    out["tolerance_mm"] = outcome.tolerance_mm;
    for (const rack::JobWarning& warning : outcome.warnings)
        warnings.append(py::make_tuple(warning.at.count(), warning.line, warning.text));
    out["warnings"] = warnings;
    out["chip_segments"] = outcome.chip_segments;
    out["events"] = outcome.events;
    out["trace_hash"] = fmt::format("{:016x}", outcome.trace_hash);
    out["rest_axis"] =
        outcome.rest_axis < 0 ? py::object(py::none()) : py::object(py::str(letter_of(outcome.rest_axis)));
    out["rest_off"] = outcome.rest_off;
    out["position_valid"] = outcome.position_valid;
    out["executed_moves"] = blocks_of(ran.world->job()->monitor());
    out["executed_moves_left_out"] = ran.world->job()->monitor().blocks_left_out();
    return out;
}

void write_file(const Ran& ran, const std::string& path,
                Result<void> (*writer)(const trace::ReportData&, const std::string&)) {
    inspect_rack(*ran.world, [&] { value_of(writer(ran.report(), path)); });
}

void attend_progress(RackHandle& world, const py::object& progress) {
    if (progress.is_none()) return world.on_progress({});
    world.on_progress([&world, progress](const rack::JobProgress& p) {
        const py::gil_scoped_acquire lock;
        try {
            progress(p.seconds, p.line, p.lines);
        } catch (py::error_already_set& error) {
            abort_run(world, error);
        }
    });
}

/// Releases the GIL, because program loops may take one or two seconds.
control::gcode::Settings check_program(const RackHandle& world, const ProgramInput& program) {
    const py::gil_scoped_release free;
    return world.check(program);
}

std::shared_ptr<Ran> run(const std::shared_ptr<RackHandle>& world, const ProgramInput& program,
                         std::int64_t sample_ticks, const std::optional<std::string>& profile,
                         const std::vector<std::string>& faults, const py::object& progress) {
    control::gcode::Settings reading;
    {
        const RackLock turn(*world, RackLock::Access::run);
        reading = check_program(*world, program);
        value_of(world->plan_faults(faults));
        value_of(world->set_sample_period(ticks(sample_ticks)));
        if (profile) value_of(world->set_profile(*profile));
        attend_progress(*world, progress);
    }
    struct Unheard {
        RackHandle& world;
        ~Unheard() { world.on_progress({}); }
    } unheard{*world};
    // A Python exception stops the run and propagates; a machine stop is part of the outcome.
    auto out = std::make_shared<Ran>(Ran{world, {}});
    const auto superseded = [last = std::weak_ptr<Ran>(out)] {
        if (const std::shared_ptr<Ran> ran = last.lock()) ran->kept = ran->report();
    };
    out->outcome = run_exclusive(*world, [&] { return world->run(program, std::move(reading), superseded); });
    return out;
}

}  // namespace

void bind_job(py::module_& m) {
    py::class_<Ran, std::shared_ptr<Ran>>(m, "Ran", "Result of a program run; programs use motionrack.Outcome.")
        .def("error",
             [](const Ran& ran) -> py::object {
                 if (ran.outcome.ended) return py::none();
                 const Error& error = ran.outcome.ended.error();
                 static constexpr const char* names[] = {"InvalidInput", "Refused", "MachineFault", "FileError",
                                                         "Stopped"};
                 return py::module_::import("motionrack.errors")
                     .attr(names[static_cast<std::size_t>(error.kind)])(error.message, error.file, error.location.line,
                                                                        error.location.column);
             })
        .def("data", [](const Ran& ran) { return inspect_rack(*ran.world, [&] { return dict_of(ran); }); })
        .def("samples", [](const Ran& ran) { return inspect_rack(*ran.world, [&] { return samples_of(ran); }); })
        .def("summary", [](const Ran& ran) { return rack::summary_of(ran.world->config(), ran.outcome); })
        .def("json", [](const Ran& ran) { return rack::summary_json(ran.world->config(), ran.outcome); })
        .def(
            "svg",
            [](const Ran& ran, bool perspective) {
                return inspect_rack(*ran.world, [&] {
                    return trace::svg_path(ran.report(),
                                           perspective ? trace::PathView::perspective : trace::PathView::plan,
                                           {.standalone = true});
                });
            },
            py::arg("perspective"))
        .def(
            "write_report", [](const Ran& ran, const std::string& path) { write_file(ran, path, trace::write_report); },
            py::arg("path"))
        .def(
            "write_csv", [](const Ran& ran, const std::string& path) { write_file(ran, path, trace::write_csv); },
            py::arg("path"))
        .def(
            "write_events",
            [](const Ran& ran, const std::string& path) { write_file(ran, path, trace::write_events_csv); },
            py::arg("path"));
    py::class_<ProgramInput>(m, "Program", "A part program's text and what goes with it.")
        .def(py::init<std::string, std::string, std::string, std::string, std::string, bool>(), py::arg("text"),
             py::arg("name"), py::arg("folder"), py::arg("tools"), py::arg("tools_name"), py::arg("block_delete"));
    m.def("run", &run, py::arg("world"), py::arg("program"), py::arg("sample_ticks"), py::arg("profile"),
          py::arg("faults"), py::arg("progress"));
    m.def(
        "check",
        [](RackHandle& world, const ProgramInput& program) {
            inspect_rack(world, [&] { static_cast<void>(check_program(world, program)); });
        },
        py::arg("world"), py::arg("program"));
}

}  // namespace motionrack::python
