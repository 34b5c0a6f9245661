// RTC5 commands in Python for the process, error bits and files, and those with many parameters or results.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <motionrack/base/read_whole_file.hpp>
#include <optional>
#include <python/src/rtc5.hpp>

namespace motionrack::python {

namespace {

using rtc5::Engine;
using Name = std::optional<std::string>;

constexpr ReadLimit correction_limit{std::size_t{4} << 20, "a correction file"},
    fly_table_limit{std::size_t{64} << 20, "a compensation table"};

std::vector<rtc5::Card*> cards_of(RackHandle& world) {
    std::vector<rtc5::Card*> out;
    for (const rack::RackCard& each : world.config().cards)
        if (rtc5::Card* const card = rack::rtc5_card_of(world.running(), each.name)) out.push_back(card);
    return out;
}

std::uint32_t select_rtc(Rtc5& self, std::uint32_t number) {
    const RackLock turn(*self.world, RackLock::Access::run);
    const std::vector<rtc5::Card*> cards = cards_of(*self.world);
    if (number < 1 || number > cards.size())
        refuse(fmt::format("select_rtc: unknown card {}; the rack has {} of type rtc5. Nothing was done.", number,
                           cards.size()));
    self.card = cards[number - 1];
    return number;
}

/// Loads the table of a file; nullptr: 1:1.
Result<std::shared_ptr<const rtc5::Table>> table_of_file(const Name& name) {
    if (!name) return nullptr;
    MOTIONRACK_TRY(const std::string bytes, read_whole_file(*name, correction_limit));
    const auto* const begin = reinterpret_cast<const std::uint8_t*>(bytes.data());
    MOTIONRACK_TRY(const rtc5::CorrectionFile file, rtc5::read_ct5({begin, bytes.size()}, *name));
    return rtc5::table_of(file);
}

int load_correction_file(Rtc5& self, const Name& name, int number, int dim) {
    std::string note;
    order(self, [&](Engine& engine) -> Result<void> {
        MOTIONRACK_CHECK(rtc5::check_parameter("load_correction_file", "No", number, 1, rtc5::table_count));
        MOTIONRACK_CHECK(rtc5::check_parameter("load_correction_file", "Dim", dim, 2, 3));
        MOTIONRACK_TRY(std::shared_ptr<const rtc5::Table> table, table_of_file(name));
        if (table != nullptr) note = table->note;
        return engine.parts().heads.load_table(std::move(table), number);
    });
    if (!note.empty() && PyErr_WarnEx(PyExc_UserWarning, note.c_str(), 1) != 0) throw py::error_already_set();
    return 0;
}

int load_fly_2d_table(Rtc5& self, const Name& name, std::uint32_t number) {
    order(self, [&](Engine& engine) -> Result<void> {
        if (!name) {
            engine.parts().fly.load_table(nullptr);
            return {};
        }
        MOTIONRACK_TRY(const std::string text, read_whole_file(*name, fly_table_limit));
        MOTIONRACK_TRY(rtc5::FlyTable table, rtc5::FlyTable::read(text, number, *name));
        engine.parts().fly.load_table(std::make_shared<const rtc5::FlyTable>(std::move(table)));
        return {};
    });
    return 0;
}

std::string table_note(Rtc5& self, int number) {
    return order(self, [&](Engine& engine) -> Result<std::string> {
        MOTIONRACK_CHECK(rtc5::check_parameter("table_note", "TableNo", number, 1, rtc5::table_count));
        const rtc5::Table* const table = engine.parts().heads.table(number);
        return table == nullptr ? "" : table->note;
    });
}

py::array_t<std::int32_t> get_waveform(Rtc5& self, int channel, std::int64_t count) {
    const std::vector<std::int32_t> samples = order(self, [&](Engine& engine) -> Result<std::vector<std::int32_t>> {
        const rtc5::Recording& r = engine.parts().recorder.recording();
        if (r.count == 0)
            return fail(
                ErrorKind::refused,
                "get_waveform: nothing was recorded. No samples were returned. Record signals with set_trigger first.");
        MOTIONRACK_CHECK(rtc5::check_parameter("get_waveform", "Channel", channel, 1, static_cast<double>(r.channels)));
        MOTIONRACK_CHECK(rtc5::check_parameter("get_waveform", "Number", static_cast<double>(count), 1,
                                               static_cast<double>(r.count)));
        std::vector<std::int32_t> out(static_cast<std::size_t>(count));
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = engine.parts().recorder.recorded(channel - 1, static_cast<std::int64_t>(i));
        return out;
    });
    return py::array_t<std::int32_t>(static_cast<py::ssize_t>(samples.size()), samples.data());
}

void bind_cards(Rtc5Class& c) {
    c.def(
        "init_rtc5_dll", [](Rtc5&) { return 0; },
        "Returns 0: nothing has to be loaded. Source: the maker's header of the RTC5 of 2013.");
    c.def(
        "rtc5_count_cards",
        [](Rtc5& self) {
            const RackLock turn(*self.world, RackLock::Access::run);
            return cards_of(*self.world).size();
        },
        "Cards of type rtc5 in the rack. Source: the maker's header of the RTC5 of 2013.");
    c.def(
        "select_rtc", &select_rtc, py::arg("CardNo"),
        "Directs the commands of this object to the rack's card CardNo of type rtc5 from here on, 1 is the first in "
        "the rack file; returns CardNo. Refused if it does not exist. Source: the maker's header of the RTC5 of 2013.");
    c.def(
        "free_rtc5_dll", [](Rtc5& self) { self.card = nullptr; },
        "Releases the card: commands of this object are refused until select_rtc. Source: the maker's header of the "
        "RTC5 of 2013.");
}

void bind_errors_of_cards(Rtc5Class& c) {
    c.def(
        "get_last_error", [](Rtc5& self) { return self.last_error; },
        "Error bits of the last command of this object that was done or refused, 0: none; its sentence is that of the "
        "exception. 2 unknown card, 16 a parameter is wrong, 32 a list is running or the card moves, 64 the list is "
        "full, none is open, or nothing can be read. See error_text. Source: the maker's header of the RTC5 of "
        "2013.");
    c.def(
        "get_error", [](Rtc5& self) { return self.errors; },
        "The error bits of all commands since reset_error. Source: the maker's header of the RTC5 of 2013.");
    c.def(
        "reset_error", [](Rtc5& self, std::uint32_t code) { self.errors &= ~code; }, py::arg("Code"),
        "Clears these bits of get_error. Code 0 to 4294967295. Source: the maker's header of the RTC5 of 2013.");
    c.def_static(
        "error_text", [](std::uint32_t bits) { return rtc5::decoded(bits, rtc5::map::error_bits); }, py::arg("bits"),
        "A sentence for each of the bits 0 to 6 of get_last_error.");
}

}  // namespace

void bind_rtc5_files(Rtc5Class& c) {
    bind_cards(c);
    bind_errors_of_cards(c);
    c.def(
        "load_program_file",
        [](Rtc5& self, const Name&) {
            order(self, [](Engine& engine) { engine.load_program_file(); });
            return 0;
        },
        py::arg("Path") = py::none(),
        "Resets the card to power-up, except McBSP location 0, which continues; the name is ignored. Returns 0. "
        "Source: the RTC5 manual 1.10 d (German), page 198.");
    c.def("load_correction_file", &load_correction_file, py::arg("Name"), py::arg("No"), py::arg("Dim") = 2,
          "Loads a .ct5 file as table No 1 to 4, None: a 1:1 table; Dim 2 or 3 (3D parts of a file are not used). "
          "Returns 0. InvalidInput where it is damaged (its checksum does not fit, K is 0 although one is known, the "
          "table cannot be inverted), FileError where it cannot be read; the table is then as before. A UserWarning "
          "where "
          "it is of a "
          "program before version 4.0, whose checksum is not known. Source: the RTC5 manual 1.9 e, pages 124 and 125.");
    c.def("table_note", &table_note, py::arg("TableNo"),
          "Note on the file of table TableNo 1 to 4: its checksum is not known; \"\": no note.");
    c.def("load_fly_2d_table", &load_fly_2d_table, py::arg("Name"), py::arg("No"),
          "Loads the section [Fly2DTableNo] of a text file: lines of counts Enc0 Enc1 dEnc0 dEnc1; None: no table. "
          "Returns 0. No 0 to 4294967295. InvalidInput with the line where it is wrong, FileError where it cannot be "
          "read; the table is then as before. Source: the RTC5 manual 1.9 e, page 185.");
    c.def(
        "set_mcbsp_out_ptr",
        [](Rtc5& self, const std::vector<std::uint32_t>& signals) {
            order(self, [&](Engine& engine) { return engine.parts().recorder.send(signals); });
        },
        py::arg("SignalPtr"),
        "Sends these signals of get_value in turn, one word in 10 us; at most 8, none: sending ends. Refused: a signal "
        "that is not there. Source: the maker's header of the RTC5 of 2013.");
    c.def("get_waveform", &get_waveform, py::arg("Channel"), py::arg("Number"),
          "The first Number samples of Channel 1 to 4 of a recording (set_trigger). Refused if fewer are available. "
          "Source: the maker's header of the RTC5 of 2013.");
}

}  // namespace motionrack::python
