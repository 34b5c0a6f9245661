// Parts of the module, each in its own file.
#pragma once

#include <pybind11/pybind11.h>

namespace motionrack::python {

namespace py = pybind11;

void bind_errors(py::module_& m);
void bind_world(py::module_& m);
void bind_job(py::module_& m);
void bind_homing(py::module_& m);
void bind_machine(py::module_& m);
void bind_cards(py::module_& m);
void bind_pictures(py::module_& m);
void bind_mcx314(py::module_& m);
void bind_library(py::module_& m);
void bind_live(py::module_& m);

void bind_databoard4002(py::module_& m);
void bind_ioflex02(py::module_& m);
void bind_grating_bus(py::module_& m);
void bind_rtc5(py::module_& m);

}  // namespace motionrack::python
