// motionrack._core: the C++ modules for the Python package, which adds names and units.
#include <python/src/bindings.hpp>

PYBIND11_MODULE(_core, m) {
    using namespace motionrack::python;
    m.doc() = "The C++ part of the package; use the names of motionrack.";
    bind_errors(m);
    bind_world(m);
    bind_job(m);
    bind_homing(m);
    bind_machine(m);
    bind_cards(m);
    bind_pictures(m);
    bind_live(m);
    bind_mcx314(m);
    bind_library(m);
    bind_databoard4002(m);
    bind_ioflex02(m);
    bind_grating_bus(m);
    bind_rtc5(m);
}
