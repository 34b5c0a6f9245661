// DataBoard 4002 function library: commands, events, moves, slope tables.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <motionrack/cards/databoard4002/driver/driver.hpp>
#include <motionrack/cards/databoard4002/driver/slope.hpp>
#include <motionrack/cards/databoard4002/trim_text.hpp>
#include <python/src/bindings.hpp>
#include <python/src/live_card.hpp>
#include <python/src/rack_lock.hpp>

namespace motionrack::python {

template <>
struct HostOf<databoard4002::Driver> {
    using type = Host;
};

namespace {

namespace db = databoard4002;
using Board = BoundDriver<db::Driver>;
using BoardClass = py::class_<Board>;
using Wide = std::int64_t;

db::Waiting waiting(bool interrupt) {
    return interrupt ? db::Waiting::interrupt : db::Waiting::polling;
}

db::DriverSettings settings_of(double counts_per_mm, int select) {
    if (!(counts_per_mm > 0 && counts_per_mm < 1e9))
        refuse(fmt::format("counts_per_mm is {}; it must be above 0. Nothing was created.", counts_per_mm));
    if (select < 0 || select > 255)
        refuse(fmt::format("The card's number is {}; it must be 0 to 255. Nothing was created.", select));
    db::DriverSettings out;
    out.counts_per_mm = counts_per_mm;
    out.select = static_cast<std::uint8_t>(select);
    return out;
}

void bind_commands(BoardClass& c) {
    c.def("connect", call<db::Driver>(&db::Driver::connect),
          "Checks for the card, clears its reset mark, returns its version. MachineFault if none answers.");
    c.def("reset", call<db::Driver>(&db::Driver::reset), "C3: hardware reset; position, rate and table are lost.");
    c.def(
        "status", [](Board& self) { return run_exclusive(*self.world, [&] { return self.driver->status().word; }); },
        "STAT as a word; its bits: card.STAT.");
    c.def(
        "stops", [](Board& self) { return run_exclusive(*self.world, [&] { return self.driver->status().stops(); }); },
        "\"the right end stop is active\"; \"\" if no stop is.");
    c.def(
        "emergency",
        [](Board& self) { return run_exclusive(*self.world, [&] { return self.driver->status().emergency(); }); },
        "Whether the emergency stop is active.");
    c.def("athome", call<db::Driver>(&db::Driver::athome), "A: the position becomes 0.");
    c.def("set_deviation", call<db::Driver>(&db::Driver::set_deviation), py::arg("counts"),
          "D: deviation allowed by lock, 0 to 8,388,607 counts.");
    c.def("deviation", call<db::Driver>(&db::Driver::deviation), "D: present minus requested, counts.");
    c.def("go", call<db::Driver>(&db::Driver::go), "G: begins a positioning.");
    c.def("initialise", call<db::Driver>(&db::Driver::initialise), "I.");
    c.def("lock", call<db::Driver>(&db::Driver::lock), "L: holds the position.");
    c.def("manual", call<db::Driver>(&db::Driver::manual), "M: releases the position.");
    c.def("set_number", call<db::Driver>(&db::Driver::set_number), py::arg("counts"),
          "N, -8,388,608 to 8,388,607 counts.");
    c.def("on_regulation", call<db::Driver>(&db::Driver::on_regulation), "O.");
    c.def("set_target", call<db::Driver>(&db::Driver::set_target), py::arg("counts"),
          "P, -8,388,608 to 8,388,607 counts.");
    c.def("position", call<db::Driver>(&db::Driver::position), "P: position, counts.");
    c.def("quit", call<db::Driver>(&db::Driver::quit), "Q: ends a positioning.");
    c.def("set_rate", call<db::Driver>(&db::Driver::set_rate), py::arg("rate"),
          "R, 0 to 16383; 0 switches the relay off.");
    c.def("rate", call<db::Driver>(&db::Driver::rate), "R: negative backwards, 0 while standing.");
    c.def("set_slope", call<db::Driver>(&db::Driver::set_slope), py::arg("table"),
          "S: the 48 intervals of acceleration and deceleration.");
    c.def("version", call<db::Driver>(&db::Driver::version), "V.");
    c.def("clear_watch_out", call<db::Driver>(&db::Driver::clear_watch_out), "W.");
}

void bind_events(BoardClass& c) {
    c.def(
        "enable_events",
        [](Board& self, std::uint8_t enables) {
            return run_exclusive(*self.world, [&]() -> Result<int> {
                MOTIONRACK_TRY(const db::Events events, self.driver->enable_events(enables));
                return events.word;
            });
        },
        py::arg("enables"), "C4: enables events and gives the EVENT word that was freed by it.");
    c.def(
        "wait_event",
        [](Board& self, std::uint8_t wanted, double timeout, bool interrupt) {
            const Duration time = duration(timeout);
            return run_exclusive(
                *self.world,
                [&]() -> Result<int> {
                    MOTIONRACK_TRY(const db::Events events, self.driver->wait_event(wanted, time, waiting(interrupt)));
                    return events.word;
                },
                time);
        },
        py::arg("wanted"), py::arg("timeout"), py::arg("interrupt") = false,
        "Waits until one of the events 01h position, 02h zero, 04h reference, 20h stop has happened; the word. Timeout "
        "after timeout s.");
    const auto move = [&](const char* name, Result<void> (db::Driver::*function)(Wide, Duration, db::Waiting),
                          const char* doc) {
        c.def(
            name,
            [function](Board& self, Wide counts, double timeout, bool interrupt) {
                const Duration time = duration(timeout);
                run_exclusive(
                    *self.world, [&] { return (self.driver.get()->*function)(counts, time, waiting(interrupt)); },
                    time);
            },
            py::arg("counts"), py::arg("timeout") = 60.0, py::arg("interrupt") = false, doc);
    };
    move("move_to", &db::Driver::move_to,
         "Moves to a position, counts, with the present rate, mode and table. MachineFault if a stop holds the move, "
         "Timeout after timeout s.");
    move("move_by", &db::Driver::move_by, "Moves by this number of counts; see move_to.");
    c.def(
        "move_to_mm",
        [](Board& self, double mm, double timeout, bool interrupt) {
            const Duration time = duration(timeout);
            run_exclusive(
                *self.world, [&] { return self.driver->move_to_mm(mm, time, waiting(interrupt)); }, time);
        },
        py::arg("mm"), py::arg("timeout") = 60.0, py::arg("interrupt") = false,
        "Moves to a position, mm by counts_per_mm; see move_to.");
    c.def("position_mm", call<db::Driver>(&db::Driver::position_mm), "Position, mm by counts_per_mm.");
    c.def(
        "find_zero",
        [](Board& self, std::uint8_t marks, Wide far, int rate, double timeout, bool interrupt) {
            const Duration time = duration(timeout);
            run_exclusive(
                *self.world, [&] { return self.driver->find_zero(marks, far, rate, time, waiting(interrupt)); }, time);
        },
        py::arg("marks"), py::arg("far"), py::arg("rate"), py::arg("timeout") = 60.0, py::arg("interrupt") = false,
        "Moves slowly (rate) towards far counts until zero (02h), reference (04h) or both (06h) zero the counter.");
}

db::SlopeTable table_of(const std::vector<std::pair<int, Wide>>& entries) {
    if (entries.size() != db::SlopeTable::entries)
        refuse(fmt::format("A slope table has {} intervals, not {}; nothing was created.", db::SlopeTable::entries,
                           entries.size()));
    db::SlopeTable out;
    for (int i = 0; i < db::SlopeTable::entries; ++i) {
        const auto [rate, position] = entries[static_cast<std::size_t>(i)];
        if (rate < 0 || rate > db::max_rate || position < 0 || position > 16'777'215)
            refuse(fmt::format(
                "Interval {} is ({}, {}); rates are 0 to {}, positions 0 to 16777215 counts. Nothing was created.", i,
                rate, position, db::max_rate));
        out.set(i, {rate, position});
    }
    return out;
}

py::dict motion_of(const db::SlopeTable& table, Wide distance, int rate, const db::SpeedScale& scale) {
    const db::SlopeMotion motion = value_of(db::motion_of(table, distance, rate, scale));
    py::list legs;
    for (const db::SlopeLeg& leg : motion.legs)
        legs.append(py::make_tuple(leg.rate, leg.speed, leg.from, leg.to, leg.start_s, leg.duration_s));
    py::dict out;
    out["legs"] = legs;
    out["duration_s"] = motion.duration_s;
    out["top_speed"] = motion.top_speed;
    out["distance"] = motion.distance;
    out["accelerating"] = motion.accelerating;
    out["decelerating"] = motion.decelerating;
    return out;
}

void bind_slopes(py::module_& m) {
    py::class_<db::SpeedScale>(
        m, "SpeedScale",
        "Speed of the machine at a rate: counts per pulse of FOUT, or counts/s per volt. `trim`: the table that "
        "came with the card, rows of V and rate as in the rack file; empty: the printed one.")
        .def(py::init([](std::optional<double> counts_per_pulse, std::optional<double> counts_per_volt,
                         const std::string& trim) {
                 if (counts_per_pulse.has_value() == counts_per_volt.has_value())
                     refuse("A speed scale is counts_per_pulse or counts_per_volt, one of the two.");
                 const double value = counts_per_pulse ? *counts_per_pulse : *counts_per_volt;
                 if (!(value > 0 && value < 1e12))
                     refuse(fmt::format("A speed scale is {}; it must be more than 0. Nothing was created.", value));
                 db::SpeedScale out;
                 out.trim = value_of(db::trim_from_text(trim));
                 out.analog = counts_per_volt.has_value();
                 (out.analog ? out.counts_per_volt : out.counts_per_pulse) = value;
                 return out;
             }),
             py::arg("counts_per_pulse") = py::none(), py::arg("counts_per_volt") = py::none(), py::arg("trim") = "")
        .def(
            "speed",
            [](const db::SpeedScale& scale, int rate) {
                if (rate < 0 || rate > db::max_rate)
                    refuse(fmt::format("The rate is {}; it must be 0 to {}.", rate, db::max_rate));
                return scale.speed(rate);
            },
            py::arg("rate"), "Counts/s at a rate, 0 to 16383.")
        .def("rate_for", &db::SpeedScale::rate_for, py::arg("counts_s"),
             "The highest rate of at most this speed, counts/s.");
    py::class_<db::SlopeTable>(
        m, "SlopeTable",
        "48 intervals (rate 0 to 16383, counts 0 to 16,777,215): deceleration 0 to 23, acceleration 24 to 47.")
        .def(py::init(&table_of), py::arg("entries"))
        .def_static(
            "design",
            [](double top_speed, double acceleration, double deceleration, const db::SpeedScale& scale, double load,
               double creep_speed, double lag_s) {
                return value_of(
                    db::design_slope({top_speed, acceleration, deceleration, load, creep_speed, lag_s}, scale));
            },
            py::arg("top_speed"), py::arg("acceleration"), py::arg("deceleration"), py::arg("scale"),
            py::arg("load") = 0.0, py::arg("creep_speed") = 0.0, py::arg("lag_s") = 0.0,
            "A table for the limits of a machine: counts/s, counts/s2; load in inertias of the empty machine; "
            "creep_speed 0: a 24th of the top speed.")
        .def(
            "entries",
            [](const db::SlopeTable& table) {
                std::vector<std::pair<int, Wide>> out;
                for (int i = 0; i < db::SlopeTable::entries; ++i)
                    out.emplace_back(table.entry(i).rate, table.entry(i).position);
                return out;
            },
            "The 48 intervals: (rate, counts).")
        .def("motion", &motion_of, py::arg("distance"), py::arg("rate"), py::arg("scale"),
             "Computes a move of `distance` counts at `rate` with this table; nothing moves. Returns duration_s, "
             "top_speed (counts/s), legs.");
}

}  // namespace

void bind_databoard4002(py::module_& m) {
    bind_slopes(m);
    BoardClass c(
        m, "Databoard4002",
        "The DataBoard 4002's function library. After the 127 ms in which the card must be Ready: MachineFault.");
    c.def(py::init(
              [](const std::shared_ptr<RackHandle>& world, const std::string& card, double counts_per_mm, int select) {
                  const RackLock turn(*world, RackLock::Access::run);
                  sim::VirtualBytePort& port = *card_of_type(*world, card, "databoard4002").byte_port();
                  return Board{world, std::make_unique<db::Driver>(port, port, settings_of(counts_per_mm, select))};
              }),
          py::arg("world"), py::arg("card"), py::arg("counts_per_mm") = 1000.0, py::arg("select") = 13);
    c.def_static(
        "of_live_port",
        [](const std::shared_ptr<LiveCard>& card, double counts_per_mm) {
            auto& board = card->device<LiveDataboard4002>("driver of the DataBoard 4002");
            db::DriverSettings settings = settings_of(counts_per_mm, board.select());
            card->claim("driver");
            return Board{card, std::make_unique<db::Driver>(board.ports(), board.interrupt(), settings)};
        },
        py::arg("card"), py::arg("counts_per_mm") = 1000.0, "Of a real card. Refused where it has a driver.");
    bind_commands(c);
    bind_events(c);
}

}  // namespace motionrack::python
