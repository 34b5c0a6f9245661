// Converts errors to the exceptions of motionrack.errors.
#include <python/src/bindings.hpp>
#include <python/src/python_error.hpp>

namespace motionrack::python {

namespace {

const char* class_of(const PythonError& raised) {
    if (raised.timeout) return "Timeout";
    switch (raised.error.kind) {
        case ErrorKind::invalid_input:
            return "InvalidInput";
        case ErrorKind::refused:
            return "Refused";
        case ErrorKind::machine:
            return "MachineFault";
        case ErrorKind::io:
            return "FileError";
        case ErrorKind::stopped:
            return "Stopped";
    }
    return "Error";
}

py::object exception_of(const py::module_& errors, const char* name, const Error& error) {
    return errors.attr(name)(error.message, error.file, error.location.line, error.location.column);
}

}  // namespace

void bind_errors(py::module_&) {
    // NOLINTNEXTLINE(performance-unnecessary-value-param): signature required by pybind11
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const PythonError& raised) {
            const py::module_ errors = py::module_::import("motionrack.errors");
            const py::object one = exception_of(errors, class_of(raised), raised.error);
            py::list problems;
            for (const Error& each : raised.all) problems.append(exception_of(errors, class_of(raised), each));
            if (!raised.all.empty()) one.attr("problems") = problems;
            PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(one.ptr())), one.ptr());
        }
    });
}

}  // namespace motionrack::python
