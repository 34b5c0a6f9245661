// MCX314 function library, generated from the rows of its declaration: positional or keyword arguments, checked against
// the row, with the row's text as docstring. No function is written by hand.
//
//   FunctionInfo ──► signature and docstring      *args, **kwargs ──► check_call ──► Library::call ──► int or sentence
#include <fmt/format.h>

#include <motionrack/cards/mcx314/library/library.hpp>
#include <python/src/bindings.hpp>
#include <python/src/live_card.hpp>

namespace motionrack::python {

template <>
struct HostOf<mcx314::Library> {
    using type = Host;
};

namespace {

using mcx314::Library;
using Called = BoundDriver<Library>;
using Arguments = std::map<std::string, std::int64_t, std::less<>>;

// ---- arguments

/// Converts any object that Python accepts as an integer; otherwise raises TypeError.
std::int64_t whole(const FunctionInfo& function, const ArgumentInfo* argument, py::handle value) {
    const auto number = py::reinterpret_steal<py::int_>(PyNumber_Index(value.ptr()));
    if (!number) throw py::error_already_set();
    int beyond = 0;
    const long long out = PyLong_AsLongLongAndOverflow(number.ptr(), &beyond);
    if (beyond != 0)
        raise({ErrorKind::invalid_input,
               fmt::format("{}: {} is {}, but must be {}. Nothing was done.", function.name,
                           argument == nullptr ? std::string_view("an argument") : argument->name,
                           py::cast<std::string>(py::str(py::handle(number))),
                           argument == nullptr ? std::string("of its arguments") : range_text(*argument))});
    return out;
}

const ArgumentInfo* argument_named(const FunctionInfo& function, std::string_view name) {
    for (const ArgumentInfo& each : function.arguments)
        if (each.name == name) return &each;
    return nullptr;
}

Arguments arguments_of(const FunctionInfo& function, const py::args& places, const py::kwargs& names) {
    Arguments out;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const ArgumentInfo* const argument = i < function.arguments.size() ? &function.arguments[i] : nullptr;
        // A surplus argument gets its position as name; check_call rejects it and lists the valid names.
        const std::string name = argument == nullptr ? std::to_string(i + 1) : std::string(argument->name);
        out[name] = whole(function, argument, places[i]);
    }
    for (const auto& [key, value] : names) {
        const auto name = py::cast<std::string>(key);
        if (out.count(name) != 0)
            raise({ErrorKind::invalid_input,
                   fmt::format("{}: {} was given twice, by its place and by its name. Nothing was done.", function.name,
                               name)});
        out[name] = whole(function, argument_named(function, name), value);
    }
    return out;
}

/// Returns the timeout argument of the function; never: it has none.
Duration timeout_of(const FunctionInfo& function, const CheckedCall& call) {
    for (std::size_t i = 0; function.waits && i < function.arguments.size(); ++i)
        if (function.arguments[i].unit == "ms") return milliseconds(call.values[i]);
    return never;
}

py::object called(Called& self, std::size_t number, const py::args& places, const py::kwargs& names) {
    const std::span<const FunctionInfo> functions = mcx314::library_functions();
    const FunctionInfo& function = functions[number];
    const CheckedCall call = value_of(check_call(functions, function.name, arguments_of(function, places, names)));
    const CallAnswer answer = run_exclusive(
        *self.world, [&] { return self.driver->call(call.function, call.values); }, timeout_of(function, call));
    if (answer.value) return py::int_(*answer.value);
    return py::str(answer.text);
}

// ---- docstrings

std::string doc_of(const FunctionInfo& function) {
    std::string head = fmt::format("{}(self: motionrack._core.Mcx314Library", function.name), said;
    for (const ArgumentInfo& each : function.arguments) {
        head += fmt::format(", {}: int", each.name);
        said +=
            fmt::format("{}: {}{}{}.\n", each.name, each.meaning, each.meaning.empty() ? "" : "; ", range_text(each));
    }
    const bool number = !function.returns.empty();
    return fmt::format(
        "{}) -> {}\n\n{} {}.\n\n{}{}Errors: {}.", head, number ? "int" : "str", function.meaning,
        function.own ? "The source names it without listing it" : fmt::format("Source: {}", function.group), said,
        number ? fmt::format("Returns: {}.\n", function.returns) : std::string("Returns: a sentence.\n"),
        function.waits ? "InvalidInput, Refused, Timeout or MachineFault where it does not end well, Stopped, "
                         "FileError"
                       : "InvalidInput, Refused, Stopped, FileError");
}

}  // namespace

void bind_library(py::module_& m) {
    py::class_<Called> c(
        m, "Mcx314Library",
        "The 57 functions of the MCX314's source under their names and with their arguments, then those that it names "
        "without listing them; the same on a virtual card and on a real one. Arguments are whole numbers, by place or "
        "by name. `axis` is a mask, X 1, Y 2, Z 4, U 8 and their sums, also where one axis is asked "
        "for.\n\nInvalidInput: "
        "an argument is missing, not known, or out of its range. Refused: the card cannot take it now, such as while "
        "an axis drives, or another thread uses the card. Stopped: a stop came, or holds. MachineFault: a limit, an "
        "alarm or the emergency input stopped an axis. FileError: the computer refuses an access to a real card. "
        "The first two are raised before anything is written.");
    c.def(py::init([](const std::shared_ptr<RackHandle>& world, const std::string& card) {
              const RackLock turn(*world, RackLock::Access::run);
              sim::VirtualPort& port = *card_of_type(*world, card, "mcx314").port();
              return Called{world, std::make_unique<Library>(port, port)};
          }),
          py::arg("world"), py::arg("card"), "Of a virtual card. Not beside another driver of it.");
    c.def_static(
        "of_live_port",
        [](const std::shared_ptr<LiveCard>& card) {
            auto& chip = card->device<LiveMcx314>("function library of the MCX314");
            card->claim("function library");
            return Called{card, std::make_unique<Library>(chip.registers(), chip.interrupt())};
        },
        py::arg("card"), "Of a real card. Refused where it has a driver.");
    py::options options;
    options.disable_function_signatures();
    const std::span<const FunctionInfo> functions = mcx314::library_functions();
    for (std::size_t i = 0; i < functions.size(); ++i)
        c.def(
            std::string(functions[i].name).c_str(),
            [i](Called& self, const py::args& places, const py::kwargs& names) {
                return called(self, i, places, names);
            },
            doc_of(functions[i]).c_str());
}

}  // namespace motionrack::python
