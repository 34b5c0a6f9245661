// IOFLEX02 function library: the source's object tIOFlexPos, and one layer above.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <motionrack/cards/ioflex02/driver/flex2pos.hpp>
#include <motionrack/cards/ioflex02/driver/speed.hpp>
#include <motionrack/rack/ioflex02_card.hpp>
#include <python/src/bindings.hpp>
#include <python/src/rack_lock.hpp>

namespace motionrack::python {

namespace {

namespace io = ioflex02;
using io::Flex2Pos;
using Flex = BoundDriver<Flex2Pos>;
using FlexClass = py::class_<Flex>;

int axis_in_range(int axis) {
    if (axis < 0 || axis >= static_cast<int>(io::axis_count))
        refuse(fmt::format("Axis {} must be 0 to 3. Nothing was done.", axis));
    return axis;
}

io::tIOFlexCmd command_of(int number) {
    if (number < io::cNop || number > io::cResNmSig)
        refuse(fmt::format("Calibration command {} must be 0 to 3. Nothing was written.", number));
    return static_cast<io::tIOFlexCmd>(number);
}

std::vector<std::uint8_t> bytes_of(const py::bytes& bytes) {
    const std::string_view view = bytes;
    return {view.begin(), view.end()};
}

void bind_source(FlexClass& c) {
    c.def(
        "Init",
        [](Flex& self, int address) {
            if (address < 0 || address > 0xFFFF)
                refuse(fmt::format("The base address is {}; it must be 0 to 65535. Nothing was done.", address));
            return run_exclusive(*self.world, [&] {
                self.driver->use_image(
                    rack::ioflex02_image_at(self.world->config(), static_cast<std::uint32_t>(address)));
                return self.driver->Init(static_cast<std::uint16_t>(address)), self.driver->Result;
            });
        },
        py::arg("Addr"),
        "Sets the base address, checks that one card answers there, and loads the array with the image that the rack "
        "file gives the card, or else the built-in one; takes seconds of the rack's time. 0: done, else see why.");
    c.def_property_readonly(
        "Result", [](const Flex& self) { return self.driver->Result; },
        "0 ok, 1 configuration failed, 2 no card or two, 3 another project.");
    c.def_property_readonly(
        "why", [](const Flex& self) { return self.driver->why(); },
        "Message for the code in Result; empty if Result is 0.");
    c.def("GetIdent", call<Flex2Pos>(&Flex2Pos::GetIdent), "Version of the project in the array.");
    c.def("ReadTime", call<Flex2Pos>(&Flex2Pos::ReadTime), "Time in ticks of 1.2 us, 0 to 16,777,215.");
    c.def("ReadTimeClr", call<Flex2Pos>(&Flex2Pos::ReadTimeClr),
          "The same, and the counter is cleared in the same access.");
    using Read = std::int32_t (Flex2Pos::*)();
    int number = 0;
    for (const Read read : {Read{&Flex2Pos::ReadPosition0}, Read{&Flex2Pos::ReadPosition1},
                            Read{&Flex2Pos::ReadPosition2}, Read{&Flex2Pos::ReadPosition3}})
        c.def(fmt::format("ReadPosition{}", number++).c_str(), call<Flex2Pos>(read),
              "Position in counts since the calibration, -8,388,608 to 8,388,607.");
    c.def(
        "ReadTimeClrPosition",
        [](Flex& self) {
            std::int32_t time = 0;
            std::array<std::int32_t, 4> at{};
            run_exclusive(*self.world, [&] { self.driver->ReadTimeClrPosition(time, at[0], at[1], at[2], at[3]); });
            return std::tuple(time, at[0], at[1], at[2], at[3]);
        },
        "Time (1.2 us, cleared) and the four positions (counts) of one instant.");
}

void bind_calibration(FlexClass& c) {
    c.def(
        "WriteCmd",
        [](Flex& self, int a, int b, int d, int e) {
            const std::array<io::tIOFlexCmd, 4> all = {command_of(a), command_of(b), command_of(d), command_of(e)};
            run_exclusive(*self.world, [&] { self.driver->WriteCmd(all[0], all[1], all[2], all[3]); });
        },
        py::arg("Cmd0"), py::arg("Cmd1"), py::arg("Cmd2"), py::arg("Cmd3"),
        "A calibration command for each axis: 0 cNop, 1 cRes, 2 cResNm, 3 cResNmSig.");
    c.def(
        "WriteCmdAxis",
        [](Flex& self, int axis, int command) {
            const io::tIOFlexCmd cmd = command_of(command);
            run_exclusive(*self.world, [&] { self.driver->WriteCmdAxis(axis_in_range(axis), cmd); });
        },
        py::arg("axis"), py::arg("Cmd"),
        "A command for one axis 0 to 3; the others stay armed, while WriteCmd would end or restart them.");
    c.def(
        "ReadSts",
        [](Flex& self) {
            const auto all = run_exclusive(*self.world, [&] { return self.driver->statuses(); });
            const auto calibrated = [&](std::size_t axis) { return all[axis] == io::sCal; };
            return std::tuple(calibrated(0), calibrated(1), calibrated(2), calibrated(3));
        },
        "Whether each axis is calibrated (sCal).");
}

void bind_inputs_and_outputs(FlexClass& c) {
    c.def("WriteOutL", call<Flex2Pos>(&Flex2Pos::WriteOutL), py::arg("Data"), "Low 8 outputs of X5.");
    c.def("WriteOutH", call<Flex2Pos>(&Flex2Pos::WriteOutH), py::arg("Data"), "High 8 outputs of X5.");
    c.def("ReadInL", call<Flex2Pos>(&Flex2Pos::ReadInL),
          "Low 8 of the 16 inputs: from bit 0 on A, B, Z, Cal of axes 0 and 1.");
    c.def("ReadInH", call<Flex2Pos>(&Flex2Pos::ReadInH), "High 8 of the 16 inputs: A, B, Z, Cal of axes 2 and 3.");
}

void bind_layer(FlexClass& c) {
    c.def(
        "read",
        [](Flex& self) {
            const io::Reading reading = run_exclusive(*self.world, [&] { return self.driver->read(); });
            std::vector<py::dict> axes;
            for (const io::AxisReading& axis : reading.axes) {
                py::dict one;
                one["position"] = axis.position;
                one["raw"] = axis.raw;
                one["age"] = axis.age;
                one["down"] = axis.down;
                axes.push_back(one);
            }
            return std::pair(reading.ticks, axes);
        },
        "All values of one instant: time since Init (ticks of 1.2 us, carried on), and of each axis position, raw "
        "(counts), age of the last count (1.2 us), down.");
    c.def(
        "set_mode",
        [](Flex& self, int axis, bool reversed, int edges, bool index_low, int filter) {
            run_exclusive(*self.world, [&] {
                return self.driver->set_mode(axis_in_range(axis), {reversed, edges, index_low, filter});
            });
        },
        py::arg("axis"), py::arg("reversed") = false, py::arg("edges") = 4, py::arg("index_low") = false,
        py::arg("filter") = 0,
        "Sets how an axis (0 to 3) counts: edges 4, 2 or 1 a line; filter 0 to 15: a level counts after filter + 1 "
        "samples of 100 ns.");
    c.def(
        "wait_calibrated",
        [](Flex& self, int axis, double timeout) {
            const Duration time = duration(timeout);
            run_exclusive(
                *self.world, [&] { return self.driver->wait_calibrated(axis_in_range(axis), time); }, time);
        },
        py::arg("axis"), py::arg("timeout") = 60.0, "Waits until the axis is calibrated; Timeout after timeout s.");
    c.def("clear_errors", call<Flex2Pos>(&Flex2Pos::clear_errors), "Clears the counters of errors.");
    c.def("reset", call<Flex2Pos>(&Flex2Pos::reset), "Positions and the card's time begin at 0.");
}

// ---- images

py::bytes make_image(const std::string& project, int ident, const std::array<int, 4>& modes, const py::bytes& bits) {
    if (ident < 0 || ident > 255)
        refuse(fmt::format("The version is {}; it must be 0 to 255. No image was created.", ident));
    io::ImageContent content;
    content.project = project;
    content.ident = static_cast<std::uint8_t>(ident);
    for (std::size_t i = 0; i < modes.size(); ++i) {
        if (modes[i] < 0 || modes[i] > 0xFF)
            refuse(fmt::format("The mode of axis {} is {}; it must be 0 to 255. No image was created.", i, modes[i]));
        content.payload[2 * i] = static_cast<std::uint8_t>(modes[i]);
    }
    const std::vector<std::uint8_t> more = bytes_of(bits);
    content.payload.insert(content.payload.end(), more.begin(), more.end());
    const std::vector<std::uint8_t> image = io::compressed(value_of(io::raw_image(content)));
    return {reinterpret_cast<const char*>(image.data()), image.size()};
}

py::dict image_info(const py::bytes& image) {
    const io::ImageInfo info = value_of(io::inspect(value_of(io::unpacked(bytes_of(image)))));
    py::dict out;
    out["project"] = py::bytes(info.project).attr("decode")("latin-1");
    out["ident"] = info.ident;
    out["payload"] = info.payload;
    out["modes"] = info.position() ? py::cast(info.modes) : py::none();
    out["fits"] = io::check_project(info).has_value();
    return out;
}

void bind_images(FlexClass& c) {
    c.def(
        "Configure",
        [](Flex& self, const py::bytes& image, std::optional<int> address) {
            const std::vector<std::uint8_t> file = bytes_of(image);
            const int base = address.value_or(self.driver->base_address());
            if (base < 0 || base > 0xFFFF)
                refuse(fmt::format("The base address is {}; it must be 0 to 65535. Nothing was done.", base));
            return run_exclusive(*self.world, [&] {
                if (address) self.driver->Flex02::Init(static_cast<std::uint16_t>(base));
                self.driver->Configure(file);
                return self.driver->Result;
            });
        },
        py::arg("image"), py::arg("Addr") = py::none(),
        "Loads the array with a custom image (bytes, of make_image or motionrack image make), at a "
        "base address, or at the one before. 0, or 1 if the image is damaged, 3 if it is of another project or "
        "version.");
    c.def_static("make_image", &make_image, py::arg("project") = std::string(io::position_project),
                 py::arg("ident") = static_cast<int>(io::position_ident), py::arg("modes") = std::array<int, 4>{},
                 py::arg("bits") = py::bytes(""),
                 "Returns a custom configuration image: the project's name, its version, the value of register MODE "
                 "of each axis, and further bytes, which the gate array stores without using them.");
    c.def_static("image_info", &image_info, py::arg("image"),
                 "Show the header of an image: project, ident, payload (bytes), modes, and whether Init would take it "
                 "(fits). InvalidInput for one that the card would refuse.");
}

std::optional<std::pair<double, double>> estimate(const io::SpeedEstimate& it) {
    if (!it.known) return {};
    return std::pair(it.counts_s, it.error);
}

void bind_speed(py::module_& m) {
    py::class_<io::SpeedMeter>(m, "SpeedMeter",
                               "Speed of an axis from readings of an Ioflex02, with the error that it cannot exceed.")
        .def(py::init<double>(), py::arg("edge_error") = 0.0,
             "edge_error: maximum position error of an edge of the encoder, counts.")
        .def(
            "update",
            [](io::SpeedMeter& meter, std::int64_t raw, std::int64_t age, std::int64_t ticks) {
                io::AxisReading axis;
                axis.raw = raw;
                axis.age = age;
                return estimate(meter.update(axis, ticks).best());
            },
            py::arg("raw"), py::arg("age"), py::arg("ticks"),
            "A reading (counts, and 1.2 us ticks); (counts/s, error) or None before the second one.")
        .def("restart", &io::SpeedMeter::restart, "Discards earlier samples.");
}

}  // namespace

void bind_ioflex02(py::module_& m) {
    bind_speed(m);
    FlexClass c(m, "Ioflex02",
                "The IOFLEX02's unit uFlex2Pos under its source's names, and one layer up. Before Init has succeeded "
                "every read gives 0.");
    c.def(py::init([](const std::shared_ptr<RackHandle>& world, const std::string& card) {
              const RackLock turn(*world, RackLock::Access::run);
              sim::VirtualPort& port = *card_of_type(*world, card, "ioflex02").port();
              return Flex{world, std::make_unique<Flex2Pos>(port, port)};
          }),
          py::arg("world"), py::arg("card"));
    c.attr("cVerNo") = io::cVerNo;
    c.attr("cVer") = io::cVer;
    c.attr("cNop") = static_cast<int>(io::cNop);
    c.attr("cRes") = static_cast<int>(io::cRes);
    c.attr("cResNm") = static_cast<int>(io::cResNm);
    c.attr("cResNmSig") = static_cast<int>(io::cResNmSig);
    bind_source(c);
    bind_calibration(c);
    bind_inputs_and_outputs(c);
    bind_layer(c);
    bind_images(c);
}

}  // namespace motionrack::python
