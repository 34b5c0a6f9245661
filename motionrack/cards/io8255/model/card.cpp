// Wires, accesses and handshakes.
#include <motionrack/cards/io8255/model/card.hpp>
#include <motionrack/sim/held_outputs.hpp>
#include <utility>

namespace motionrack::io8255 {

namespace {

constexpr PortGroup groups[] = {PortGroup::a, PortGroup::b};
constexpr std::uint8_t control_port = offset("MODE_SET");
static_assert(control_port == offset("BIT"));

constexpr std::size_t index_of(PortGroup group) {
    return static_cast<std::size_t>(group);
}
constexpr std::size_t index_of(IoPort port) {
    return static_cast<std::size_t>(port);
}
/// The port of 8 lines that belongs to the group.
constexpr IoPort port_of(PortGroup group) {
    return group == PortGroup::a ? IoPort::a : IoPort::b;
}
/// The group of bus port 0 or 1.
constexpr PortGroup group_at(std::uint8_t port) {
    return port == offset("PORT_A") ? PortGroup::a : PortGroup::b;
}

}  // namespace

Card::Card(sim::Kernel& kernel, const std::string& name)
    : kernel_(kernel), id_(kernel.add(*this, sim::Phase::cards, name)) {
    static_assert(std::size(map::pins) == 2 * line_count + 1);
    for (std::size_t i = 0; i < wires_.size(); ++i) {
        const PinInfo& pin = map::pins[i];
        const int rest = pin.direction == PinDirection::input ? 1 : 0;
        wires_[i] = kernel.add_wire(name + "." + std::string(pin.name), rest);
    }
    // STB and ACK of group B are one line.
    for (const HandshakeLines& lines :
         {handshake_of(PortGroup::a, true), handshake_of(PortGroup::a, false), handshake_of(PortGroup::b, true)})
        kernel.listen(wires_[received(IoPort::c, lines.strobe)], id_, lines.strobe);
}

void Card::report(CardCondition code, std::int64_t a, std::int64_t b) {
    kernel_.report(id_, static_cast<std::uint16_t>(code), a, b);
}

// ---- lines

/// Number of the wire of a receiver.
std::size_t Card::received(IoPort port, int line) const {
    return line_count + index_of(port) * lines_of_port + static_cast<std::size_t>(line);
}

bool Card::is_high(int line_of_c) const {
    return kernel_.level(wires_[received(IoPort::c, line_of_c)]) != 0;
}

unsigned Card::levels(IoPort port) const {
    unsigned out = 0;
    for (int line = 0; line < lines_of_port; ++line)
        out |= unsigned{kernel_.level(wires_[received(port, line)]) != 0} << line;
    return out;
}

/// Level of IBF or OBF, as the group is an input or an output.
bool Card::flag(PortGroup group) const {
    return (state_.full[index_of(group)] != 0) == modes().is_input(group);
}

/// Level of INTR.
bool Card::requests(PortGroup group) const {
    const PortModes now = modes();
    if (!now.is_strobed(group) || state_.enabled[index_of(group)] == 0) return false;
    return flag(group) && is_high(handshake_of(group, now.is_input(group)).strobe);
}

/// Bits of port C that the drivers put out.
unsigned Card::driven_c() const {
    const PortModes now = modes();
    unsigned out = state_.latch[index_of(IoPort::c)] & port_c_lines(now).outputs;
    for (const PortGroup group : groups) {
        if (!now.is_strobed(group)) continue;
        const HandshakeLines lines = handshake_of(group, now.is_input(group));
        out |= unsigned{flag(group)} << lines.flag | unsigned{requests(group)} << lines.request;
    }
    return out;
}

void Card::drive() {
    const PortModes now = modes();
    const unsigned bytes[port_count] = {now.a_input ? 0u : state_.latch[0], now.b_input ? 0u : state_.latch[1],
                                        driven_c()};
    for (std::size_t i = 0; i < line_count; ++i)
        kernel_.set_wire(wires_[i], static_cast<int>(bytes[i / lines_of_port] >> i % lines_of_port & 1));
    kernel_.set_wire(wires_.back(), requests(PortGroup::a) || requests(PortGroup::b));
}

// ---- reading

/// Port A or B as the host reads it.
unsigned Card::byte(PortGroup group) const {
    const PortModes now = modes();
    if (!now.is_input(group)) return state_.latch[index_of(group)];
    if (!now.is_strobed(group) || !is_high(handshake_of(group, true).strobe)) return levels(port_of(group));
    return state_.taken[index_of(group)];
}

/// Port C as the host reads it: INTE in place of STB and ACK.
unsigned Card::port_c() const {
    const PortModes now = modes();
    const PortCLines lines = port_c_lines(now);
    unsigned out = driven_c() | (levels(IoPort::c) & ~(lines.outputs | lines.flags | lines.strobes));
    for (const PortGroup group : groups)
        if (now.is_strobed(group))
            out |= unsigned{state_.enabled[index_of(group)]} << handshake_of(group, now.is_input(group)).strobe;
    return out;
}

std::uint8_t Card::peek(std::uint8_t port) const {
    if (port >= control_port) return no_answer;
    return static_cast<std::uint8_t>(port == offset("PORT_C") ? port_c() : byte(group_at(port)));
}

std::uint8_t Card::in(std::uint8_t port) {
    const std::uint8_t value = peek(port);
    if (port >= control_port) report(CardCondition::no_register, port, -1);
    if (port >= offset("PORT_C")) return value;
    const PortGroup group = group_at(port);
    const PortModes now = modes();
    // A byte whose strobe is still low is not complete, so it stays.
    if (!now.is_strobed(group) || !now.is_input(group) || !is_high(handshake_of(group, true).strobe)) return value;
    state_.full[index_of(group)] = 0;
    state_.reported_lost[index_of(group)] = 0;
    drive();
    return value;
}

// ---- writing

void Card::out(std::uint8_t port, std::uint8_t value) {
    if (port > control_port) return report(CardCondition::no_register, port, value);
    if (port == offset("OUT_C"))
        put(IoPort::c, value, port_c_lines(modes()).writable);
    else if (port < control_port)
        put_byte(group_at(port), value);
    else if (mode::SET.test(value))
        set_modes(value);
    else
        set_bit(value);
    drive();
}

/// The host writes the outputs in `mask`.
void Card::put(IoPort port, unsigned value, unsigned mask) {
    const std::size_t p = index_of(port);
    const sim::MaskedWrite write{static_cast<std::uint16_t>(value), static_cast<std::uint16_t>(mask)};
    const std::uint32_t low = sim::put_unless_held(write, state_.latch[p], state_.held[p]);
    if (low != 0 && std::exchange(state_.reported_held, 1u) == 0)
        report(CardCondition::outputs_held, static_cast<std::int64_t>(p), low);
}

/// The host writes port A or B. A strobed byte goes out whole or not at all.
void Card::put_byte(PortGroup group, unsigned value) {
    const PortModes now = modes();
    if (now.is_input(group)) return;
    if (!now.is_strobed(group)) return put(port_of(group), value, 0xFF);
    const std::size_t g = index_of(group);
    std::uint16_t latch = state_.latch[g];
    const std::uint32_t low = sim::put_unless_held({static_cast<std::uint16_t>(value), 0xFF}, latch, state_.held[g]);
    if (low != 0) return report(CardCondition::byte_refused, static_cast<std::int64_t>(g), low);
    state_.latch[g] = latch;
    if (state_.full[g] != 0 && std::exchange(state_.reported_lost[g], std::uint16_t{1}) == 0)
        report(CardCondition::byte_overwritten, static_cast<std::int64_t>(g));
    state_.full[g] = 1;
}

void Card::set_modes(std::uint8_t word) {
    if (mode::A_MODE.get(word) > 1) return report(CardCondition::both_directions, word);
    state_ = State{.control = word, .held = state_.held, .reported_held = state_.reported_held};
}

void Card::set_bit(std::uint8_t word) {
    const unsigned line = field("BIT", "NUMBER").get(word), bit = 1u << line;
    const bool level = field("BIT", "LEVEL").test(word);
    const PortCLines lines = port_c_lines(modes());
    if ((lines.strobes & bit) != 0)
        state_.enabled[index_of(line < 4 ? PortGroup::b : PortGroup::a)] = level;
    else if ((lines.flags & bit) != 0)
        report(CardCondition::flag_written, line);
    else if ((lines.outputs & bit) != 0)
        put(IoPort::c, level ? bit : 0, bit);
}

void Card::clear_outputs() {
    const PortModes now = modes();
    for (const PortGroup group : groups)
        if (now.is_strobed(group) && !now.is_input(group)) discard_byte(group);
    for (std::size_t port = 0; port < port_count; ++port)
        state_.held[port] |= std::exchange(state_.latch[port], std::uint16_t{0});
    state_.reported_held = 0;
    drive();
}

/// A stop withdraws the byte of a strobed output; the next one goes out whole.
void Card::discard_byte(PortGroup group) {
    const std::size_t g = index_of(group);
    if (std::exchange(state_.full[g], std::uint16_t{0}) != 0)
        report(CardCondition::byte_discarded, static_cast<std::int64_t>(g));
    state_.latch[g] = 0;
    state_.reported_lost[g] = 0;
}

// ---- handshakes

void Card::on_wire(int line, int level, Instant) {
    const PortModes now = modes();
    for (const PortGroup group : groups)
        if (now.is_strobed(group) && handshake_of(group, now.is_input(group)).strobe == line) strobe(group, level != 0);
    drive();
}

/// An edge of STB or ACK.
void Card::strobe(PortGroup group, bool high) {
    const std::size_t g = index_of(group);
    if (!modes().is_input(group)) {
        if (high) return;
        state_.full[g] = 0;
        state_.reported_lost[g] = 0;
    } else if (high) {
        state_.taken[g] = static_cast<std::uint16_t>(levels(port_of(group)));
    } else {
        if (state_.full[g] != 0 && std::exchange(state_.reported_lost[g], std::uint16_t{1}) == 0)
            report(CardCondition::byte_lost, static_cast<std::int64_t>(g));
        state_.full[g] = 1;
    }
}

}  // namespace motionrack::io8255
