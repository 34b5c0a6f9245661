#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/rtc5_card.hpp>
#include <motionrack/rack/stop_reactions.hpp>
#include <tests/random_program.hpp>
#include <tests/swarm/order.hpp>

namespace motionrack::swarm {

namespace {

using operate::Machine;
using Order = test::Invariants::Order;

const operate::AxisStatus& some_axis(Machine& machine, Draws& draws) {
    const auto& axes = machine.status().axes;
    return axes[static_cast<std::size_t>(draws.pick(static_cast<int>(axes.size())))];
}

char some_letter(Machine& machine, Draws& draws) {
    return machine.status().axes.empty() ? 'X' : some_axis(machine, draws).letter;
}

std::string some_line(Machine& machine, Draws& draws) {
    const char letter = some_letter(machine, draws);
    switch (draws.pick(7)) {
        case 0:
            return fmt::format("G0 {}{:.3f}", letter, draws.number(-5, 60));
        case 1:
            return fmt::format("G1 {}{:.3f} F{:.0f}", letter, draws.number(0, 20), draws.number(50, 6000));
        case 2:
            return fmt::format("G2 X{:.3f} Y{:.3f} R{:.3f} F1200", draws.number(0, 20), draws.number(0, 20),
                               draws.number(10, 40));
        case 3:
            return fmt::format("G4 P{:.3f}", draws.number(0, 0.1));
        case 4:
            return std::array{"M3 S8000", "M5", "M8", "M9", "G91", "G90", "G64 P0.05", "G61"}[draws.pick(8)];
        case 5:
            return std::array{"G999", "X", "G1 X1e9 F100", "%", "G10 L2 P1 X1", "O1 sub"}[draws.pick(6)];
        default:
            return fmt::format("G91 G0 {}{:.3f}", letter, draws.number(-3, 3));
    }
}

std::string some_program(Machine& machine, Draws& draws) {
    if (draws.one_in(3) && machine.status().axes.size() >= 3)
        return test::ProgramMaker(draws.raw(), draws.one_in(2) ? test::ProgramSize::mixed : test::ProgramSize::tiny)
            .make()
            .text;
    std::string out;
    for (int lines = 1 + draws.pick(12); lines > 0; --lines) out += some_line(machine, draws) + "\n";
    return out + (draws.one_in(4) ? "M0\nG0 X10\nM2\n" : "M2\n");
}

double some_speed(Draws& draws) {
    const double speed = draws.one_in(12) ? draws.number(100, 1e6) : draws.number(1, 100);
    return draws.one_in(2) ? speed : -speed;
}

operate::StopOrigin somebody(Draws& draws, const char* kind) {
    return {std::array{"anna", "bert", ""}[draws.pick(3)], fmt::format("10.0.0.{}", 1 + draws.pick(3)), kind};
}

// ---- clients: pages with a session each, whose jogs are numbered

std::string some_session(Draws& draws) {
    return fmt::format("w{}", 1 + draws.pick(3));
}
/// Half of the jogs come from a page. Some of these overtake each other, and some renew a jog that has ended.
operate::JogOrigin some_origin(Machine& machine, Draws& draws) {
    if (draws.one_in(2)) return {};
    std::string session = some_session(draws);
    const std::int64_t sequence = machine.status().sequence + 3 - draws.pick(3);
    return {std::move(session), sequence, draws.one_in(3)};
}
Result<void> end_session(Machine& machine, Draws& draws) {
    const std::string session = some_session(draws);
    machine.manual().jogs().end_of(session);
    machine.service().end_of(session);
    return {};
}

Result<void> jog(Machine& machine, Draws& draws) {
    const char letter = some_letter(machine, draws);
    const double speed = draws.one_in(5) ? 0 : some_speed(draws);
    return machine.manual().jog(letter, speed, some_origin(machine, draws));
}
Result<void> jog_by(Machine& machine, Draws& draws) {
    const char letter = some_letter(machine, draws);
    const double distance = draws.number(-30, 30);
    return machine.manual().jog_by(letter, distance, std::abs(some_speed(draws)));
}
Result<void> jog_to(Machine& machine, Draws& draws) {
    control::Point target = {};
    for (std::size_t i = 0; i < 3; ++i) target[i] = draws.number(0, 50);
    return machine.manual().jog_to(target, draws.number(1, 100));
}
Result<void> begin_program(Machine& machine, Draws& draws) {
    return machine.begin_program(some_program(machine, draws), "swarm.ngc");
}
Result<void> line(Machine& machine, Draws& draws) {
    const auto taken = machine.line(some_line(machine, draws), 1);
    return taken ? Result<void>() : Result<void>(tl::unexpected<Error>(taken.error()));
}
Result<void> hold(Machine& machine, Draws&) {
    return machine.hold();
}
Result<void> resume(Machine& machine, Draws&) {
    return machine.resume();
}
Result<void> stop(Machine& machine, Draws& draws) {
    machine.stop(somebody(draws, "STOP"));
    return {};
}
Result<void> cancel(Machine& machine, Draws& draws) {
    machine.cancel(somebody(draws, "^X"));
    return {};
}
Result<void> reset(Machine& machine, Draws& draws) {
    machine.reset(somebody(draws, "Reset"));
    return {};
}
Result<void> enable(Machine& machine, Draws& draws) {
    const bool on = !draws.one_in(4);
    return machine.enable(on, draws.one_in(3) ? std::string(1, some_letter(machine, draws)) : std::string());
}
Result<void> home(Machine& machine, Draws& draws) {
    return machine.manual().home(draws.one_in(2) ? std::string(1, some_letter(machine, draws)) : std::string());
}
/// Sets the position correctly: to the true position at this instant.
Result<void> declare(Machine& machine, Draws& draws) {
    const char letter = some_axis(machine, draws).letter;
    for (const rack::RunningAxis& axis : machine.rack().axes())
        if (axis.config.letter == letter)
            return machine.manual().set_position(letter, axis.machine->position(machine.now()));
    return {};
}
Result<void> set_overrides(Machine& machine, Draws& draws) {
    machine.programs().set_overrides(draws.number(0.01, 2), draws.number(0.01, 1));
    return {};
}
Result<void> single_block(Machine& machine, Draws& draws) {
    machine.programs().set_single_block(draws.one_in(2));
    return {};
}
Result<void> coolant(Machine& machine, Draws& draws) {
    machine.set_coolant(draws.one_in(2), draws.one_in(2));
    return {};
}
Result<void> acknowledge(Machine& machine, Draws& draws) {
    machine.acknowledge_alarm(1 + draws.pick(5));
    return {};
}
Result<void> touch_off(Machine& machine, Draws& draws) {
    return operate::touch_off(machine, some_letter(machine, draws), draws.number(-20, 20));
}

/// A card of the machine: every rack has one with motion and a library.
const std::string& some_card(Machine& machine, Draws& draws) {
    const auto& cards = machine.rack().cards();
    return cards[static_cast<std::size_t>(draws.pick(static_cast<int>(cards.size())))]->name();
}
Result<void> service(Machine& machine, Draws& draws) {
    if (draws.one_in(3)) return machine.service().end([](const Result<std::string>&) {});
    const std::string& card = some_card(machine, draws);
    const operate::StopOrigin who = somebody(draws, "Service");
    return machine.service().begin(card, who, draws.one_in(3) ? some_session(draws) : "swarm",
                                   [](const Result<std::string>&) {});
}
/// Reads a register of a card, or writes the general outputs of an MCX314: its axes lose their positions and do not
/// move.
Result<void> access(Machine& machine, Draws& draws) {
    constexpr std::uint32_t registers = 8, wr4 = 8;
    operate::ManualAccess::BusAccess made;
    made.card = some_card(machine, draws);
    made.address = 2 * static_cast<std::uint32_t>(draws.pick(registers));
    if (draws.one_in(2)) {
        made.address = wr4;
        made.value = static_cast<std::uint32_t>(draws.raw() & 0xFFFF);
    }
    return machine.manual_access().request(made, [](const Result<std::uint32_t>&) {});
}

// ---- a belt and a laser, of racks that have them

Result<void> start_part(Machine& machine, Draws&) {
    MOTIONRACK_CHECK(machine.conditions().may_begin("Nothing was started"));
    return rack::start_part(machine.rack(), "line");
}
Result<void> mark(Machine& machine, Draws& draws) {
    MOTIONRACK_CHECK(machine.conditions().may_begin("Nothing was marked"));
    auto* const card = rack::rtc5_card_of(machine.rack(), "scan");
    if (card == nullptr) return fail(ErrorKind::refused, "The rack has no laser.");
    rtc5::Engine& laser = card->engine();
    const double to = 1'000.0 * (1 + draws.pick(200));
    const bool begun = laser.set_start_list(1) && laser.put(*rtc5::list_command(rtc5::Op::set_mark_speed, {25})) &&
                       laser.put(*rtc5::list_command(rtc5::Op::mark_abs, {to, 0})) &&
                       laser.put(*rtc5::list_command(rtc5::Op::set_end_of_list, {})) && laser.execute_list(1);
    return begun ? Result<void>() : fail(ErrorKind::refused, "The laser is at work.");
}

/// Mostly the initial values of a form, so that axes move; some anywhere in their range or beyond.
std::int64_t some_value(const ArgumentInfo& argument, Draws& draws) {
    if (!argument.values.empty())
        return argument.values[static_cast<std::size_t>(draws.pick(static_cast<int>(argument.values.size())))].value;
    if (draws.one_in(30)) return argument.max + 1;
    if (!draws.one_in(4)) return argument.start;
    return std::llround(draws.number(static_cast<double>(argument.min), static_cast<double>(argument.max)));
}

/// Functions that set drive parameters, drive, wait for drives and stop them.
Result<void> call(Machine& machine, Draws& draws) {
    static constexpr std::array called = {"SetRange", "SetMultiple", "SetV",      "TCurve_F", "TCurve_C",
                                          "SCurve_F", "SCurve_C",    "Line2D_T",  "Line3D_S", "CircleCW_C",
                                          "HLMTSig",  "HomeType1",   "HomeType2", "LPS",      "ReadLPS",
                                          "RESET",    "stop",        "stop_now",  "wait"};
    operate::Service::FunctionCall made;
    made.card = some_card(machine, draws);
    made.function = called[static_cast<std::size_t>(draws.pick(static_cast<int>(called.size())))];
    const auto functions = operate::library_of(machine.rack(), made.card);
    if (!functions) return tl::unexpected<Error>(functions.error());
    for (const FunctionInfo& function : *functions)
        for (const ArgumentInfo& argument : function.arguments)
            if (function.name == made.function)
                made.arguments[std::string(argument.name)] = some_value(argument, draws);
    return machine.service().call(std::move(made), somebody(draws, "Call"), "swarm", [](const Result<CallAnswer>&) {});
}

constexpr std::array orders = {DrawnOrder{"begin_program", 14, Order::motion, begin_program},
                               DrawnOrder{"line", 20, Order::motion, line},
                               DrawnOrder{"jog", 14, Order::motion, jog},
                               DrawnOrder{"jog_by", 6, Order::motion, jog_by},
                               DrawnOrder{"jog_to", 5, Order::motion, jog_to},
                               DrawnOrder{"home", 5, Order::motion, home},
                               DrawnOrder{"hold", 6, {}, hold},
                               DrawnOrder{"resume", 8, Order::motion, resume},
                               DrawnOrder{"stop", 5, Order::stop, stop},
                               DrawnOrder{"cancel", 3, {}, cancel},
                               DrawnOrder{"reset", 10, Order::reset, reset},
                               DrawnOrder{"enable", 8, Order::enable, enable},
                               DrawnOrder{"set_position", 8, Order::position, declare},
                               DrawnOrder{"set_overrides", 5, {}, set_overrides},
                               DrawnOrder{"set_single_block", 3, {}, single_block},
                               DrawnOrder{"set_coolant", 1, {}, coolant},
                               DrawnOrder{"acknowledge_alarm", 3, {}, acknowledge},
                               DrawnOrder{"touch_off", 2, {}, touch_off},
                               DrawnOrder{"end_session", 4, {}, end_session},
                               DrawnOrder{"access_register", 4, {}, access},
                               DrawnOrder{"start_part", 4, Order::part, start_part},
                               DrawnOrder{"mark", 4, {}, mark},
                               DrawnOrder{"service", 6, Order::motion, service},
                               DrawnOrder{"call", 14, Order::motion, call}};

constexpr double released = std::numeric_limits<double>::quiet_NaN();
constexpr std::array ends = {"limit_plus", "limit_minus", "home"};
constexpr std::array contacts = {"estop", "estop1", "estop2", "door"};

/// A contact of the operator that the rack has.
std::string some_contact(Machine& machine, Draws& draws) {
    const std::string wire = contacts[static_cast<std::size_t>(draws.pick(4))];
    return machine.wires().knows(wire) ? wire : "estop";
}

std::string wire_of(char letter, const char* end) {
    return fmt::format("{}.{}", letter, end);
}

}  // namespace

std::span<const DrawnOrder> all_orders() {
    return orders;
}

const DrawnOrder& draw_order(Draws& draws) {
    int all = 0;
    for (const DrawnOrder& order : orders) all += order.weight;
    int place = draws.pick(all);
    for (const DrawnOrder& order : orders) {
        if (place < order.weight) return order;
        place -= order.weight;
    }
    return orders.front();
}

DrawnFault draw_fault(Machine& machine, Draws& draws) {
    const char letter = some_letter(machine, draws);
    if (draws.one_in(3)) {
        const bool contact = draws.one_in(2);
        const std::string wire =
            contact ? some_contact(machine, draws) : wire_of(letter, ends[static_cast<std::size_t>(draws.pick(3))]);
        const double value = draws.one_in(3) ? released : draws.pick(2);
        if (!machine.wires().knows(wire) || !machine.wires().force(wire, value)) return {};
        return {fmt::format("{}={}", wire, value)};
    }
    const auto targets = rack::fault_targets(machine.rack());
    const auto& target = targets[static_cast<std::size_t>(draws.pick(static_cast<int>(targets.size())))];
    if (target.faults.empty()) return {};
    const std::string_view fault =
        target.faults[static_cast<std::size_t>(draws.pick(static_cast<int>(target.faults.size())))];
    // Without its encoder, a servo's position is uncertain up to its following error limit.
    const bool servo = machine.rack().axes().front().servo != nullptr;
    if (servo && fault.starts_with("encoder.")) return {};
    if (fault.starts_with("drive.")) return {};  // the speed of a belt is an order to it
    const double value = draws.one_in(3) ? 0 : draws.one_in(2) ? 1 : draws.number(1, 200);
    const std::string text = fmt::format("{}={:.3g}", fault, value);
    if (!rack::inject_fault(machine.rack(), text, target.name)) return {};
    return {fmt::format("{}.{}", target.name, text), true};
}

void mend_all(Machine& machine) {
    for (const auto& target : rack::fault_targets(machine.rack()))
        for (const std::string_view fault : target.faults)
            (void)rack::inject_fault(machine.rack(), fmt::format("{}=0", fault), target.name);
    for (const rack::WireAccess::Named& wire : machine.wires().names())
        if (wire.drivable) (void)machine.wires().force(wire.name, released);
}

}  // namespace motionrack::swarm
