// MCX314 function library: parameters, drives, waiting, status. Paths and signals: bind_mcx314_paths.cpp.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <motionrack/cards/mcx314/driver/curves.hpp>
#include <motionrack/cards/mcx314/driver/home_series.hpp>
#include <python/src/bind_mcx314.hpp>
#include <python/src/bindings.hpp>
#include <python/src/live_card.hpp>

namespace motionrack::python {

using mcx314::Driver;
using Wide = std::int64_t;

unsigned mask(unsigned axes) {
    if (axes < 1 || axes > mcx314::xyzu)
        refuse(fmt::format(
            "{} is not a mask of axes: it must be 1 to 15, the sum of X 1, Y 2, Z 4 and U 8. Nothing was done.", axes));
    return axes;
}

namespace {

int channel(int axis, const char* who) {
    value_of(Driver::check_channel(axis, who));
    return axis;
}

void bind_parameters(Mcx314Class& c) {
    const auto number = [&](const char* name, Result<void> (Driver::*function)(unsigned, Wide), const char* doc) {
        c.def(name, call<Driver>(function), py::arg("axes"), py::arg("value"), doc);
    };
    c.def("RESET", call<Driver>(&Driver::RESET), "Software reset of the chip; waits its 875 ns.");
    c.def("initialise", call<Driver>(&Driver::initialise), "RESET, then every mode register, AO, LP and EP written 0.");
    c.def("SetPulseMode", call<Driver>(&Driver::SetPulseMode), py::arg("axes"), py::arg("mode"),
          "Pulse output: mode 0 two pulse trains, 1 pulse and direction.");
    number("SetMultiple", &Driver::SetMultiple,
           "The multiple M, 1 to 500: pulses a second = V * M. Writes R = 8,000,000 / M. Not while driving.");
    c.def("SetRange", call<Driver>(static_cast<Result<void> (Driver::*)(unsigned, Wide)>(&Driver::SetRange)),
          py::arg("axes"), py::arg("value"),
          "R, 16,000 to 8,000,000: pulses a second = V * 8,000,000 / R. Not while driving.");
    c.def("SetMaxSpeed", call<Driver>(static_cast<Result<void> (Driver::*)(unsigned, Wide)>(&Driver::SetMaxSpeed)),
          py::arg("axes"), py::arg("value"),
          "The smallest whole multiple with which V <= 8,000 reaches this speed, 1 to 4,000,000 pulses a second.");
    number("SetSV", &Driver::SetSV, "Initial speed, 1 to 8,000 units of the multiple.");
    number("SetV", &Driver::SetV, "Drive speed, 1 to 8,000 units of the multiple; also while driving.");
    number("SetA", &Driver::SetA, "Acceleration, 1 to 8,000 units of 125 * M pulses/s2.");
    number("SetD", &Driver::SetD,
           "Deceleration, 1 to 8,000 units of 125 * M pulses/s2; used where SetAsymmetric is on.");
    number("SetAA", &Driver::SetAA, "K, 1 to 65,535: the jerk is 62.5e6 / K * M pulses/s3.");
    c.def("SetAO", call<Driver>(&Driver::SetAO), py::arg("axes"), py::arg("value"),
          "Pulses reserved for the end at SV, 0 to 65,535; None (default): computed for each drive.");
    number("Pulse", &Driver::Pulse, "Output pulses of a fixed drive, -268,435,455 to 268,435,455.");
    c.def("AutoDec", call<Driver>(&Driver::AutoDec), py::arg("axes") = mcx314::xyzu,
          "Makes the chip compute the deceleration point; not for arcs.");
    number("ManualDec", &Driver::ManualDec, "Sets the pulses after which fixed drives decelerate, 0 to 268,435,455.");
    c.def("SetAsymmetric", call<Driver>(&Driver::SetAsymmetric), py::arg("axes"), py::arg("on"),
          "Decelerations use D instead of A.");
    number("LPS", &Driver::LPS, "Sets the logical position, pulses, 32 bits with sign.");
    number("EPS", &Driver::EPS, "Sets the real (encoder) position, counts, 32 bits with sign.");
    number("SetCompP", &Driver::SetCompP, "COMP+, pulses or counts, 32 bits with sign.");
    number("SetCompM", &Driver::SetCompM, "COMP-, pulses or counts, 32 bits with sign.");
}

void bind_drives(Mcx314Class& c) {
    c.def("TCurve_F", call<Driver>(&Driver::TCurve_F), py::arg("axes"), py::arg("sv"), py::arg("v"), py::arg("a"),
          py::arg("pulses"),
          "Fixed drive with a T-curve: SV, V 1 to 8,000 units of the multiple, A 1 to 8,000 units of 125 * M; pulses "
          "-268,435,455 to 268,435,455, the sign is the direction.");
    c.def("TCurve_C", call<Driver>(&Driver::TCurve_C), py::arg("axes"), py::arg("sv"), py::arg("v"), py::arg("a"),
          py::arg("negative") = false, "Continuous drive with a T-curve, until it is stopped; units as of TCurve_F.");
    c.def("SCurve_F", call<Driver>(&Driver::SCurve_F), py::arg("axes"), py::arg("sv"), py::arg("v"), py::arg("a"),
          py::arg("k"), py::arg("pulses"),
          "Fixed drive with an S-curve: as TCurve_F, and K 1 to 65,535 (jerk 62.5e6 / K * M pulses/s3).");
    c.def("SCurve_C", call<Driver>(&Driver::SCurve_C), py::arg("axes"), py::arg("sv"), py::arg("v"), py::arg("a"),
          py::arg("k"), py::arg("negative") = false,
          "Continuous drive with an S-curve, until it is stopped; units as of SCurve_F.");
    c.def("DriveFixed", call<Driver>(&Driver::DriveFixed), py::arg("axes"),
          "Starts the drives set by Pulse, each axis in its direction, all at the same tick.");
    c.def(
        "stop",
        [](Mcx314& self, unsigned axes, bool quick) {
            run_exclusive(*self.world, [&] {
                return self.driver->stop(axes, quick ? mcx314::StopKind::quick : mcx314::StopKind::slow);
            });
        },
        py::arg("axes"), py::arg("quick") = false,
        "Stops the axes, with everything that is interpolated with them: decelerating to SV, or at once.");
    c.def("change_speed", call<Driver>(&Driver::change_speed), py::arg("axes"), py::arg("v"),
          "Another V, 1 to 8,000, while driving. Refused where it would have no effect.");
    c.def(
        "change_pulses",
        [](Mcx314& self, int axis, Wide pulses, double margin) {
            const Duration time = duration(margin);
            run_exclusive(*self.world,
                          [&] { return self.driver->change_pulses(channel(axis, "change_pulses"), pulses, time); });
        },
        py::arg("axis"), py::arg("pulses"), py::arg("margin") = 1e-3,
        "Another number of pulses for the fixed drive of an axis (0 X to 3 U), counted from its start; margin in s.");
    c.def(
        "wait",
        [](Mcx314& self, unsigned axes, double timeout) {
            const Duration time = duration(timeout);
            run_exclusive(
                *self.world, [&] { return self.driver->wait_until_done(mask(axes), time); }, time);
        },
        py::arg("axes") = mcx314::xyzu, py::arg("timeout") = 60.0,
        "Waits until none of the axes drives. Raises Timeout after timeout s, MachineFault if one was stopped by a "
        "limit, an alarm or the emergency input.");
    using Home = Result<std::vector<mcx314::HomeReport>> (*)(Driver&, unsigned, unsigned, Wide, Wide, Wide);
    int type = 0;
    for (const Home home :
         {Home{mcx314::HomeType1}, Home{mcx314::HomeType2}, Home{mcx314::HomeType3}, Home{mcx314::HomeType4}})
        c.def(
            fmt::format("HomeType{}", ++type).c_str(),
            [home](Mcx314& self, unsigned axes, unsigned wr1, Wide sv, Wide v, Wide a) {
                std::vector<std::string> out;
                for (const mcx314::HomeReport& report :
                     run_exclusive(*self.world, [&] { return home(*self.driver, axes, wr1, sv, v, a); }))
                    out.push_back(report.sentence);
                return out;
            },
            py::arg("axes"), py::arg("WR1Reg"), py::arg("SV"), py::arg("V"), py::arg("A"),
            "Homes all axes of the mask at once, in - direction; WR1Reg: WR1 with the home input enabled at its level. "
            "A sentence for each axis.");
}

/// Plan of one drive, before any motion.
py::dict planned(const mcx314::CurvePlan& plan) {
    py::dict out;
    const auto part = [&](const char* name, const mcx314::CurvePart& it) {
        py::dict one;
        one["duration_s"] = to_seconds(it.time());
        one["pulses"] = it.pulses;
        one["from_hz"] = plan.hz(it.from_v);
        one["to_hz"] = plan.hz(it.to_v);
        one["peak_hz_s"] = plan.peak_acceleration(it);
        out[name] = one;
    };
    part("rise", plan.rise);
    part("cruise", plan.cruise);
    part("fall", plan.fall);
    part("creep", plan.creep);
    out["duration_s"] = to_seconds(plan.time());
    out["pulses"] = plan.pulses;
    out["top_hz"] = plan.top_hz();
    out["end_hz"] = plan.hz(plan.end_v);
    out["reaches_v"] = plan.reaches_v;
    out["jerk_hz_s2"] = plan.jerk();
    return out;
}

}  // namespace

void bind_mcx314_status(Mcx314Class& c) {
    const auto counter = [&](const char* name, std::int32_t (Driver::*function)(int), const char* doc) {
        c.def(
            name,
            [name, function](Mcx314& self, int axis) {
                return run_exclusive(*self.world, [&] { return (self.driver.get()->*function)(channel(axis, name)); });
            },
            py::arg("axis"), doc);
    };
    counter("ReadLPS", &Driver::ReadLPS, "Logical position of a channel (0 X to 3 U), pulses.");
    counter("ReadEPS", &Driver::ReadEPS, "Real position of a channel (0 X to 3 U), encoder counts.");
    counter("ReadCV", &Driver::ReadCV, "Present speed of a channel, units of the multiple; 0 at standstill.");
    counter("ReadCA", &Driver::ReadCA,
            "Present acceleration of a channel, units of 125 * M; at constant speed the last one.");
    c.def(
        "moving",
        [](Mcx314& self, unsigned axes) {
            return run_exclusive(*self.world, [&] { return self.driver->moving(mask(axes)); });
        },
        py::arg("axes") = mcx314::xyzu, "Whether one of the axes drives.");
    c.def(
        "report",
        [](Mcx314& self, int axis) {
            return run_exclusive(*self.world, [&] { return self.driver->report(channel(axis, "report")).text(); });
        },
        py::arg("axis"), "State and position of a channel with the reason, as a sentence.");
    c.def("error_text", call<Driver>(&Driver::error_text), py::arg("axes") = mcx314::xyzu,
          "The reports of the axes that have an error or were stopped by an input; \"\" if none.");
    c.def("axis_speeds", call<Driver>(&Driver::axis_speeds),
          "Speed of every axis, pulses a second, signed, also in interpolations.");
    c.def(
        "multiple", [](const Mcx314& self, int axis) { return self.driver->multiple(channel(axis, "multiple")); },
        py::arg("axis"), "Pulses a second of one V unit of a channel; 0 before R was written.");
    c.def_static(
        "plan",
        [](std::optional<Wide> pulses, Wide r, Wide sv, Wide v, Wide a, std::optional<Wide> d, std::optional<Wide> k,
           std::optional<Wide> ao) {
            const mcx314::CurveData data{.R = r,
                                         .SV = sv,
                                         .V = v,
                                         .A = a,
                                         .D = d.value_or(a),
                                         .K = k.value_or(65'535),
                                         .AO = ao.value_or(0),
                                         .s_curve = k.has_value(),
                                         .asymmetric = d.has_value(),
                                         .dec_point = {},
                                         .pulses = pulses};
            return planned(value_of(mcx314::plan_drive(ao ? data : value_of(mcx314::with_slow_end(data)))));
        },
        py::arg("pulses"), py::arg("R"), py::arg("SV"), py::arg("V"), py::arg("A"), py::arg("D") = py::none(),
        py::arg("K") = py::none(), py::arg("AO") = py::none(),
        "Plans a drive; nothing moves. Exact to the tick: times in s, speeds in pulses/s. K: an S-curve; "
        "D: another deceleration; AO: None, as the library sets it.");
}

void bind_mcx314(py::module_& m) {
    Mcx314Class c(m, "Mcx314",
                  "The MCX314's function library, under its source's names and in its register units. `axes` is a "
                  "mask: X 1, Y 2, Z 4, U 8 and their sums; `axis` is a channel: 0 X, 1 Y, 2 Z, 3 U.");
    c.def(py::init([](const std::shared_ptr<RackHandle>& world, const std::string& card) {
              const RackLock turn(*world, RackLock::Access::run);
              sim::VirtualPort& port = *card_of_type(*world, card, "mcx314").port();
              return Mcx314{world, std::make_unique<Driver>(port, port)};
          }),
          py::arg("world"), py::arg("card"));
    c.def_static(
        "of_live_port",
        [](const std::shared_ptr<LiveCard>& card) {
            auto& chip = card->device<LiveMcx314>("driver of the MCX314");
            card->claim("driver");
            return Mcx314{card, std::make_unique<Driver>(chip.registers(), chip.interrupt())};
        },
        py::arg("card"), "Of a real card. Refused where it has a driver.");
    bind_parameters(c);
    bind_drives(c);
    bind_mcx314_moves(c);
    bind_mcx314_signals(c);
    bind_mcx314_status(c);
}

}  // namespace motionrack::python
