// Real cards: opening, stopping, manual register access. motionrack/live.py is the public interface.
#include <python/src/bindings.hpp>
#include <python/src/live_card.hpp>
#include <python/src/map_dict.hpp>

namespace motionrack::python {

void bind_live(py::module_& m) {
    py::class_<LiveCard, std::shared_ptr<LiveCard>>(
        m, "LivePort",
        "A real card behind a live port, with a stop that holds; motionrack.LiveCard has its registers by their names.")
        .def(py::init<const std::string&, const std::string&, int>(), py::arg("place"), py::arg("type"),
             py::arg("select") = 13, "Opens the port; no register is written. InvalidInput, FileError, Refused.")
        .def(
            "map", [](const LiveCard& card) { return map_dict(card.map()); },
            "Declaration of the card: registers, bits, states.")
        .def(
            "now", [](LiveCard& card) { return to_seconds(card.now()); },
            "Seconds of the computer's clock since it was opened. Refused once it was closed.")
        .def("read", &LiveCard::read, py::arg("offset"), "Reads a register at its offset, with all side effects.")
        .def("write", &LiveCard::write, py::arg("offset"), py::arg("value"),
             "Writes a register at its offset, with all side effects; value 0 to 65535, or 0 to 255 at a byte port.")
        .def("view", &LiveCard::view, py::arg("clearing"), "Describes the value of every register.")
        .def(
            "wait_interrupt", [](LiveCard& card, double timeout) { return card.wait_interrupt(duration(timeout)); },
            py::arg("timeout"), "Whether its interrupt came within timeout s.")
        .def("quick_stop", &LiveCard::quick_stop, "All axes stop, and nothing is written until reset_stop.")
        .def("reset_stop", &LiveCard::reset_stop, "Releases the stop; nothing moves by that.")
        .def("stopped", &LiveCard::stopped, "Whether a stop is active.")
        .def("close", &LiveCard::close, "Stops all axes and closes the card.")
        .def("closed", &LiveCard::closed, "Whether the card was closed.");
}

}  // namespace motionrack::python
