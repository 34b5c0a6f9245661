// Reads and writes of the registers, and the common instant of STROBE.
#include <algorithm>
#include <motionrack/cards/ioflex02/model/card.hpp>

namespace motionrack::ioflex02 {

namespace {

constexpr std::uint32_t project_from = offset("IDENT");

bool declared_at(std::uint32_t at, bool write) {
    for (const RegisterInfo& reg : map::registers)
        if (reg.offset == at && (reg.access == Access::write) == write) return true;
    return false;
}

/// The register at `at` of a 24-bit value whose register _L, or that of its first axis, is at `low`.
std::uint16_t half(std::uint32_t value, std::uint32_t at, std::uint32_t low) {
    return static_cast<std::uint16_t>((at - low) % 4 == 0 ? value : value >> 16);
}

}  // namespace

// ---- reading

std::uint16_t Card::word(const State& state, std::uint32_t at) const {
    const Configuration& c = state.configuration;
    unsigned status = 0;
    switch (at) {
        case offset("SIGNATURE"):
            return signature;
        case offset("SERIAL"):
            return settings_.serial;
        case offset("SERIAL_N"):
            return static_cast<std::uint16_t>(~settings_.serial);
        case offset("STATUS"):
            if (c.array != ArrayState::empty) status = 1u << (static_cast<unsigned>(c.array) - 1);
            for (unsigned i = 0; i < axis_count; ++i) status |= unsigned{state.axes[i].illegal != 0} << (4 + i);
            return static_cast<std::uint16_t>(status);
        case offset("CFG_ERROR"):
            return static_cast<std::uint16_t>(c.error);
        default:
            break;
    }
    if (c.array != ArrayState::running || (!c.known && at != offset("IDENT")) || !declared_at(at, false))
        return no_answer;
    return project_word(state, at);
}

std::uint16_t Card::project_word(const State& state, std::uint32_t at) const {
    const auto axes_below = [at](std::uint32_t from) { return at >= from && at < from + 4 * axis_count; };
    const Captured& all = state.captured;
    const auto of = [&all, at](std::uint32_t from) -> const CapturedAxis& { return all.axes[(at - from) / 4]; };
    if (axes_below(offset("POS0_L"))) return half(of(offset("POS0_L")).position, at, offset("POS0_L"));
    if (axes_below(offset("RAW0_L"))) return half(of(offset("RAW0_L")).raw, at, offset("RAW0_L"));
    if (axes_below(offset("AGE0_L"))) return half(of(offset("AGE0_L")).age, at, offset("AGE0_L"));
    const CapturedAxis& axis = all.axes[state.axis];
    unsigned bits = 0;
    switch (at) {
        case offset("IDENT"):
            return state.configuration.header.ident();
        case offset("STS"):
            for (unsigned i = 0; i < axis_count; ++i) bits |= unsigned{status_of(state.axes[i].cal)} << i;
            return static_cast<std::uint16_t>(bits);
        case offset("IN"):
            for (unsigned i = 0; i < input_pins; ++i) bits |= unsigned{kernel_.level(wires_[line_pins + i]) != 0} << i;
            return static_cast<std::uint16_t>(bits);
        case offset("TIME_L"):
        case offset("TIME_H"):
            return half(all.time, at, offset("TIME_L"));
        case offset("DOWN"):
            for (unsigned i = 0; i < axis_count; ++i) bits |= unsigned{all.axes[i].down} << i;
            return static_cast<std::uint16_t>(bits);
        case offset("LINES"):
            return axis.lines;
        case offset("EDGES_A"):
            return axis.edges_a;
        case offset("EDGES_B"):
            return axis.edges_b;
        case offset("INDEXES"):
            return axis.indexes;
        case offset("INDEX_AT_L"):
        case offset("INDEX_AT_H"):
            return half(axis.index_at, at, offset("INDEX_AT_L"));
        case offset("ILLEGAL"):
            return axis.illegal;
        case offset("ILLEGAL_AT_L"):
        case offset("ILLEGAL_AT_H"):
            return half(axis.illegal_at, at, offset("ILLEGAL_AT_L"));
        case offset("MODE_NOW"):
            return state.axes[state.axis].mode;
        default:
            return no_answer;
    }
}

std::uint16_t Card::peek(std::uint32_t at) const {
    return word(seen(), at);
}

std::uint16_t Card::read(std::uint32_t at) {
    begin();
    catch_up(kernel_.now(), true);
    if (!declared_at(at, false)) {
        report(CardCondition::no_register, at, -1);
    } else if (at >= project_from && !has_project() && at != offset("IDENT") && !state_.reported_no_project) {
        state_.reported_no_project = 1;
        report(CardCondition::no_project, at);
    }
    return word(state_, at);
}

// ---- writing

void Card::write(std::uint32_t at, std::uint16_t value) {
    begin();
    catch_up(kernel_.now(), true);
    if (!declared_at(at, true)) return report(CardCondition::no_register, at, value);
    if (at == offset("CONTROL")) return control(value);
    if (at == offset("DATA")) return take_word(value);
    if (has_project()) return write_project(at, value);
    if (state_.reported_no_project) return;
    state_.reported_no_project = 1;
    report(CardCondition::no_project, at);
}

void Card::write_project(std::uint32_t at, std::uint16_t value) {
    switch (at) {
        case offset("STROBE"):
            return strobe(value);
        case offset("CMD"):
            for (std::size_t i = 0; i < axis_count; ++i)
                if ((field("CMD", "KEEP").get(value) >> i & 1) == 0)
                    command_axis(state_.axes[i], static_cast<tIOFlexCmd>(value >> (2 * i) & 3));
            return;
        case offset("OUTL"):
            return put_out(value, 0x00FF);
        case offset("OUTH"):
            return put_out(static_cast<std::uint16_t>(value << 8), 0xFF00);
        case offset("AXIS"):
            state_.axis = value & field("AXIS", "NUMBER").mask;
            return;
        case offset("MODE"):
            state_.axes[state_.axis].mode = value & mode::all;
            return;
        default:
            return;
    }
}

void Card::strobe(std::uint16_t word) {
    const std::int64_t ticks = ticks_at(state_, kernel_.now());
    if (field("STROBE", "CAPTURE").test(word)) {
        state_.captured.time = static_cast<std::uint32_t>(ticks - state_.cleared) & mask_24;
        for (std::size_t i = 0; i < axis_count; ++i) {
            const EncoderAxisState& axis = state_.axes[i];
            CapturedAxis& out = state_.captured.axes[i];
            const std::int64_t age =
                axis.edge == no_sample ? mask_24 : ticks - ticks_at(state_, sample_time * axis.edge);
            out.position = static_cast<std::uint32_t>(axis.position) & mask_24;
            out.raw = static_cast<std::uint32_t>(axis.raw) & mask_24;
            out.age = static_cast<std::uint32_t>(std::min<std::int64_t>(age, mask_24));
            out.index_at = static_cast<std::uint32_t>(axis.index_at) & mask_24;
            out.illegal_at = static_cast<std::uint32_t>(axis.illegal_at) & mask_24;
            out.lines = lines_word(axis);
            out.edges_a = axis.edges_a;
            out.edges_b = axis.edges_b;
            out.indexes = axis.indexes;
            out.illegal = axis.illegal;
            out.down = axis.down;
        }
    }
    if (field("STROBE", "CLEAR_TIME").test(word)) state_.cleared = ticks;
}

}  // namespace motionrack::ioflex02
