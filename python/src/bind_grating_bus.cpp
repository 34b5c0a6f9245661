// Motion card of a grating bus: its function library, and observations of the rack's bus.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <motionrack/cards/grating_bus/driver/grating_card.hpp>
#include <motionrack/rack/frame_monitor.hpp>
#include <motionrack/rack/grating_card.hpp>
#include <python/src/bindings.hpp>
#include <python/src/rack_lock.hpp>

namespace motionrack::python {

namespace {

namespace gb = grating_bus;
using Grating = BoundDriver<gb::GratingCard>;

/// Returns (sequence, ticks of simulated time, counts).
std::tuple<std::uint32_t, std::int64_t, py::array_t<std::int64_t>> reported(const gb::Reading& reading) {
    const auto counts = reading.counts();
    return {reading.frame.sequence, reading.frame.time,
            py::array_t<std::int64_t>(static_cast<py::ssize_t>(counts.size()), counts.data())};
}

py::dict reported(const gb::CardInfo& info) {
    py::dict out;
    out["host"] = info.host;
    out["checks"] = info.checks;
    out["wrong_direction"] = info.wrong_direction;
    out["scales"] = info.scales;
    out["first"] = info.first;
    out["addresses"] = std::vector<int>(info.addresses().begin(), info.addresses().end());
    out["period"] = to_seconds(info.period);
    return out;
}

py::dict reported(const gb::CardErrors& errors) {
    py::dict out;
    out["broken"] = errors.broken;
    out["missed_words"] = errors.missed_words;
    out["alien"] = errors.alien;
    out["lines"] = errors.lines;
    out["missed_edges"] = errors.missed_edges;
    out["overrun"] = errors.overrun;
    return out;
}

gb::Card& model(RackHandle& world, const std::string& card) {
    gb::Card* found = rack::grating_card_of(world.running(), card);
    if (found == nullptr) refuse("The rack has no card " + card + " on a grating bus.");
    return *found;
}

void bind_card(py::module_& m) {
    py::class_<Grating>(m, "GratingCard",
                        "The function library of a motion card on a grating bus: the positions of one instant.")
        .def(py::init([](const std::shared_ptr<RackHandle>& world, const std::string& card) {
                 const RackLock turn(*world, RackLock::Access::run);
                 sim::VirtualPort& port = *card_of_type(*world, card, "grating_bus").port();
                 return Grating{world, std::make_unique<gb::GratingCard>(port, port)};
             }),
             py::arg("world"), py::arg("card"))
        .def(
            "open",
            [](Grating& self) { return reported(run_exclusive(*self.world, [&] { return self.driver->open(); })); },
            "Checks for the card and returns its settings, with the addresses of its own list; period in s.")
        .def(
            "read",
            [](Grating& self) { return reported(run_exclusive(*self.world, [&] { return self.driver->read(); })); },
            "The last published frame: (sequence, ticks of 100 ps, counts of 64 bits). Refused if there is none, if it "
            "is stale, or its CRC is wrong.")
        .def(
            "wait",
            [](Grating& self, double timeout) {
                const Duration time = duration(timeout);
                const Instant began = self.world->now();
                try {
                    return reported(run_exclusive(*self.world, [&] { return self.driver->wait(time); }));
                } catch (PythonError& raised) {
                    raised.timeout = raised.error.kind == ErrorKind::refused && self.world->now() - began >= time;
                    throw;
                }
            },
            py::arg("timeout"), "Waits for a frame that was not read yet, and reads it; Timeout after timeout s.")
        .def(
            "addresses",
            [](Grating& self) {
                const auto addresses = self.driver->addresses();
                return std::vector<int>(addresses.begin(), addresses.end());
            },
            "Scales of the last frame read: the address of each word, as set by the host; empty before the first.")
        .def("stale", call<gb::GratingCard>(&gb::GratingCard::stale),
             "Whether the last published frame is two periods old.")
        .def(
            "errors",
            [](Grating& self) { return reported(run_exclusive(*self.world, [&] { return self.driver->errors(); })); },
            "Errors on the bus since the last clear_errors, each at most 65,535.")
        .def("clear_errors", call<gb::GratingCard>(&gb::GratingCard::clear_errors), "Clears those counters.")
        .def(
            "set_position",
            [](Grating& self, int scale, std::int64_t count) {
                if (scale < 0 || scale >= static_cast<int>(gb::max_scales))
                    refuse("The scale must be 0 to 127. Nothing was done.");
                self.driver->set_position(scale, count);
            },
            py::arg("scale"), py::arg("count"),
            "Sets the 64-bit count of the scale with that address, 0 to 127, near count; the next reading gives its "
            "low 32 bits.");
}

void bind_bus(py::module_& m) {
    m.def(
        "bus_conflicts",
        [](RackHandle& world) {
            return inspect_rack(world, [&] {
                const gb::Bus* bus = rack::grating_bus_of(world.running());
                if (bus == nullptr) refuse("The rack has no grating bus.");
                return bus->lines().all_conflicts();
            });
        },
        py::arg("world"), "Conflicts on all lines of the grating bus so far.");
    m.def(
        "refused_frames",
        [](RackHandle& world, const std::string& card) {
            return inspect_rack(world, [&] { return model(world, card).counter(gb::Card::broken); });
        },
        py::arg("world"), py::arg("card"), "Frames that the card did not publish since the start.");
    m.def(
        "frame_picture",
        [](RackHandle& world, int frame) {
            return inspect_rack(world, [&] { return value_of(rack::frame_picture(world.config(), frame)); });
        },
        py::arg("world"), py::arg("frame"), "One frame of the rack as waves (SVG); a rack of its own is run for it.");
}

}  // namespace

void bind_grating_bus(py::module_& m) {
    bind_card(m);
    bind_bus(m);
}

}  // namespace motionrack::python
