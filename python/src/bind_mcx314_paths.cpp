// MCX314 function library: lines, arcs, chains, bit patterns, signals.
#include <pybind11/stl.h>

#include <python/src/bind_mcx314.hpp>

namespace motionrack::python {

using mcx314::Driver;
using mcx314::FourAxes;
using Wide = std::int64_t;

namespace {

void bind_interpolation(Mcx314Class& c) {
    using Line = Result<void> (Driver::*)(const mcx314::LINEDATA&, unsigned);
    const auto line = [&](const char* name, Line function, const char* doc) {
        c.def(
            name,
            [function](Mcx314& self, unsigned axes, const FourAxes& p, Wide v, Wide sv, Wide a, Wide d, Wide k) {
                const mcx314::LINEDATA data{sv, v, a, d, k, p};
                run_exclusive(*self.world, [&] { return (self.driver.get()->*function)(data, axes); });
            },
            py::arg("axes"), py::arg("P"), py::arg("V"), py::arg("SV") = 0, py::arg("A") = 0, py::arg("D") = 0,
            py::arg("K") = 0, doc);
    };
    line("Line2D_C", &Driver::Line2D_C,
         "A line of two axes at constant speed V. P: finish of X, Y, Z, U in pulses from the present place, -8,388,608 "
         "to 8,388,607.");
    line("Line2D_T", &Driver::Line2D_T, "A line of two axes with trapezoid: SV, V, A (D: 0 as A) 1 to 8,000.");
    line("Line2D_S", &Driver::Line2D_S, "A line of two axes with S-curve: and K 1 to 65,535.");
    line("Line3D_C", &Driver::Line3D_C, "A line of three axes at constant speed; see Line2D_C.");
    line("Line3D_T", &Driver::Line3D_T, "A line of three axes with trapezoid; see Line2D_T.");
    line("Line3D_S", &Driver::Line3D_S, "A line of three axes with S-curve; see Line2D_S.");
    using Circle = Result<void> (Driver::*)(const mcx314::CIRCLEDATA&, unsigned);
    const auto circle = [&](const char* name, Circle function, const char* doc) {
        c.def(
            name,
            [function](Mcx314& self, unsigned axes, const FourAxes& p, const FourAxes& centre, Wide v, Wide sv, Wide a,
                       Wide d) {
                const mcx314::CIRCLEDATA data{sv, v, a, d, p, centre};
                run_exclusive(*self.world, [&] { return (self.driver.get()->*function)(data, axes); });
            },
            py::arg("axes"), py::arg("P"), py::arg("C"), py::arg("V"), py::arg("SV") = 0, py::arg("A") = 0,
            py::arg("D") = 0, doc);
    };
    circle("CircleCW_C", &Driver::CircleCW_C,
           "An arc clockwise at constant speed. P finish (0, 0: a full circle), C centre, in pulses from the start.");
    circle("CircleCCW_C", &Driver::CircleCCW_C, "An arc counter-clockwise at constant speed; see CircleCW_C.");
    circle("CircleCW_T", &Driver::CircleCW_T, "An arc clockwise with trapezoid: SV, V, A (D: 0 as A) 1 to 8,000.");
    circle("CircleCCW_T", &Driver::CircleCCW_T, "An arc counter-clockwise with trapezoid; see CircleCW_T.");
    c.def("SetVectorSpeed", call<Driver>(&Driver::SetVectorSpeed), py::arg("axes_count"),
          "Keeps the speed along the path: 1 off, 2 two axes, 3 three axes.");
}

void bind_chain(Mcx314Class& c) {
    c.def(
        "ContStart",
        [](Mcx314& self, Wide v, Wide sv, Wide a, Wide d) {
            run_exclusive(*self.world, [&] { return self.driver->ContStart({sv, v, a, d}); });
        },
        py::arg("V"), py::arg("SV") = 0, py::arg("A") = 0, py::arg("D") = 0,
        "Begins a chain: V 1 to 8,000; A 0: constant speed.");
    c.def(
        "ContLine",
        [](Mcx314& self, unsigned axes, const FourAxes& p, Wide v, double timeout) {
            const Duration time = duration(timeout);
            run_exclusive(
                *self.world, [&] { return self.driver->ContLine(axes, p, v, time); }, time);
        },
        py::arg("axes"), py::arg("P"), py::arg("v") = 0, py::arg("timeout") = 60.0,
        "A line of the chain, P in pulses; v: speed from here on, 0: unchanged; timeout in s.");
    c.def(
        "ContArc",
        [](Mcx314& self, unsigned axes, const FourAxes& p, const FourAxes& centre, bool clockwise, Wide v,
           double timeout) {
            const Duration time = duration(timeout);
            run_exclusive(
                *self.world, [&] { return self.driver->ContArc(axes, p, centre, clockwise, v, time); }, time);
        },
        py::arg("axes"), py::arg("P"), py::arg("C"), py::arg("clockwise"), py::arg("v") = 0, py::arg("timeout") = 60.0,
        "An arc of the chain; see ContLine.");
    c.def(
        "ContEnd",
        [](Mcx314& self, double timeout) {
            const Duration time = duration(timeout);
            const mcx314::ContOutcome out = run_exclusive(
                *self.world, [&] { return self.driver->ContEnd(time); }, time);
            return std::pair(out.segments, out.end_speed);
        },
        py::arg("timeout") = 60.0,
        "Executes the last segment and waits for the end, timeout in s: (segments, V units at the last pulse as "
        "planned).");
    const auto pattern = [&](const char* name, Result<void> (Driver::*function)(const mcx314::BPDATA&, unsigned),
                             const char* doc) {
        c.def(
            name,
            [function](Mcx314& self, unsigned axes, Wide v, Wide sv, Wide a, Wide dec_point) {
                run_exclusive(*self.world, [&] { return (self.driver.get()->*function)({sv, v, a, dec_point}, axes); });
            },
            py::arg("axes"), py::arg("V"), py::arg("SV") = 0, py::arg("A") = 0, py::arg("DecPoint") = 0, doc);
    };
    pattern("BP2D", &Driver::BP2D,
            "Begins a bit pattern of two axes: V steps a second, times the multiple; A 0: constant speed.");
    pattern("BP3D", &Driver::BP3D, "Begins a bit pattern of three axes; see BP2D.");
    c.def(
        "BPStack",
        [](Mcx314& self, const std::array<std::uint16_t, 3>& plus, const std::array<std::uint16_t, 3>& minus,
           double timeout) {
            const Duration time = duration(timeout);
            run_exclusive(
                *self.world,
                [&] {
                    return self.driver->BPStack({plus, minus}, time);
                },
                time);
        },
        py::arg("plus"), py::arg("minus"), py::arg("timeout") = 60.0,
        "Sixteen steps, the lowest bit first, of each axis; in both at once: the drive ends there. timeout in s.");
    c.def("BPStart", call<Driver>(&Driver::BPStart), "Starts the pattern.");
    c.def(
        "BPEnd",
        [](Mcx314& self, double timeout) {
            const Duration time = duration(timeout);
            run_exclusive(
                *self.world, [&] { return self.driver->BPEnd(time); }, time);
        },
        py::arg("timeout") = 60.0, "Releases the registers and waits for the end, timeout in s.");
}

}  // namespace

void bind_mcx314_moves(Mcx314Class& c) {
    bind_interpolation(c);
    bind_chain(c);
}

void bind_mcx314_signals(Mcx314Class& c) {
    const auto turn = [&](const char* name, Result<void> (Driver::*function)(int, unsigned), const char* doc) {
        c.def(name, call<Driver>(function), py::arg("n"), py::arg("axes") = mcx314::xyzu, doc);
    };
    turn("HLMTP", &Driver::HLMTP, "The + limit switch acts at: 0 Low, 1 High.");
    turn("HLMTM", &Driver::HLMTM, "The - limit switch acts at: 0 Low, 1 High.");
    turn("HLMTSig", &Driver::HLMTSig, "Limit switches stop: 0 at once, 1 decelerating.");
    turn("SLMTP", &Driver::SLMTP, "COMP+ as software limit: 0 off, 1 on.");
    turn("SLMTM", &Driver::SLMTM, "COMP- as software limit: 0 off, 1 on.");
    turn("SLMTSig", &Driver::SLMTSig, "COMP+ and COMP- are compared with: 0 LP, 1 EP.");
    turn("EncoderMode", &Driver::EncoderMode, "Encoder input: 0 A/B quadrature, 1 up and down pulses.");
    turn("EncoderCWCCW", &Driver::EncoderCWCCW, "A/B edges counted: 0 all, 1 every second, 2 every fourth.");
    turn("EnableALM", &Driver::EnableALM, "Alarm input: 0 off, 1 on.");
    turn("EnableInPos", &Driver::EnableInPos, "In-position input: 0 off, 1 on.");
    turn("ALMSig", &Driver::ALMSig, "The alarm acts at: 0 Low, 1 High.");
    turn("InPosSig", &Driver::InPosSig, "In-position acts at: 0 Low, 1 High.");
    c.def("SetOutput", call<Driver>(&Driver::SetOutput), py::arg("axes"), py::arg("output"), py::arg("high"),
          "nOUT0 to nOUT7: 4 to 7 while they are not used for the drive's status.");
    c.def("EnableInterrupt", call<Driver>(&Driver::EnableInterrupt), py::arg("axes"), py::arg("causes"),
          "Enables causes of interrupts, bits as in RR3: 1 to 255.");
    c.def("DisableInterrupt", call<Driver>(&Driver::DisableInterrupt), py::arg("axes"),
          py::arg("causes") = mcx314::cause::all, "Disables causes of interrupts.");
    c.def(
        "read_interrupts",
        [](Mcx314& self, int axis) {
            return run_exclusive(*self.world, [&]() -> Result<std::uint16_t> {
                MOTIONRACK_CHECK(Driver::check_channel(axis, "read_interrupts"));
                return self.driver->read_interrupts(axis);
            });
        },
        py::arg("axis"), "Reads and clears what came since the last call, bits as in RR3.");
}

}  // namespace motionrack::python
