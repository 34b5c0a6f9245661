// Prints register programs in readable form.
#include <fmt/format.h>

#include <iterator>
#include <motionrack/cards/mcx314/test/program.hpp>

namespace motionrack::mcx314::twin {

namespace {

const char* name_of_command(int code) {
    static constexpr const char* from_00[] = {"R",  "K",      "A",       "D",       "SV",      "V",       "P",
                                              "DP", "C",      "LP",      "EP",      "COMP+",   "COMP-",   "AO",
                                              "L",  "select", "read LP", "read EP", "read CV", "read CA", "read BR"};
    static constexpr const char* from_20[] = {"+ fixed", "- fixed", "+ continuous",      "- continuous",
                                              "hold",    "free",    "decelerating stop", "immediate stop"};
    static constexpr const char* from_30[] = {"2-axis line",
                                              "3-axis line",
                                              "CW arc",
                                              "CCW arc",
                                              "2-axis pattern",
                                              "3-axis pattern",
                                              "pattern registers on",
                                              "pattern registers off",
                                              "stack the pattern",
                                              "clear the pattern",
                                              "step",
                                              "deceleration on",
                                              "deceleration off",
                                              "clear interrupt"};
    static constexpr const char* from_60[] = {"EM", "HV", "home search", "clear pulse", "SM", "act"};
    const auto name = [&](const auto& names, int first) -> const char* {
        return code >= first && code < first + static_cast<int>(std::size(names)) ? names[code - first] : nullptr;
    };
    for (const char* found : {name(from_00, 0x00), name(from_20, 0x20), name(from_30, 0x30), name(from_60, 0x60)})
        if (found) return found;
    return "?";
}

std::string text_of_op(const Op& op) {
    static constexpr const char* pins[] = {"IN0",  "IN1",   "IN2",   "IN3",  "EXPP",
                                           "EXPM", "INPOS", "ALARM", "LMTP", "LMTM"};
    const char axis = "XYZU"[op.axis], half = op.offset % 2 != 0 ? 'H' : 'L';
    const int number = op.offset / 2;
    if (op.kind == Op::Kind::input) return fmt::format("{}{} = {}", axis, pins[static_cast<int>(op.pin)], op.value);
    if (op.kind == Op::Kind::emergency) return fmt::format("EMGN = {}", op.value);
    if (op.kind == Op::Kind::encoder) return fmt::format("{}EC{} = {}", axis, op.offset == 0 ? 'A' : 'B', op.value);
    if (op.kind == Op::Kind::step) return fmt::format("EXPLSN = {}", op.value);
    if (op.kind == Op::Kind::write_byte) return fmt::format("WR{}{} = {:02X}", number, half, op.value);
    if (op.kind == Op::Kind::read_byte) return fmt::format("read RR{}{}", number, half);
    if (op.kind == Op::Kind::read) return fmt::format("read RR{}", number);
    return fmt::format("WR{} = {:04X}", number, op.value);
}

/// Returns a command as text. `wr6`, `wr7`: the data that the command uses.
std::string text_of_command(unsigned value, unsigned wr6, unsigned wr7) {
    const int code = value & 0xFF;
    std::string out = "  ";
    for (unsigned a = 0; a < 4; ++a)
        if (value >> (8 + a) & 1) out += "XYZU"[a];
    out.append(" ").append(name_of_command(code));
    if (code == 0x60 || code == 0x64) return out + fmt::format(" = {:04X} {:04X}", wr7, wr6);
    return code <= 0x0E || code == 0x61 ? out + fmt::format(" = {}", static_cast<std::int32_t>(wr7 << 16 | wr6)) : out;
}

}  // namespace

std::string listing_of(const Program& program) {
    const ChipOptions& options = program.options;
    const Way& way = program.way;
    std::string out = fmt::format("{}{}{}{}{}{}AO {}, slices {}, seed {}, program {}, {} ticks\n",
                                  program.extended() ? "MCX314As, " : "",
                                  options.slow_drive == SlowDrive::at_sv ? "slow drives at SV, " : "",
                                  options.software_limit == SoftwareLimit::at ? "limits at COMP+, " : "",
                                  way.listen ? "" : "nobody listens to edges, ", way.watch ? "counts watched, " : "",
                                  way.follow ? "pins followed, " : "", options.offset_after_reset, way.slices,
                                  program.seed, program.number, program.ticks);
    unsigned registers[8] = {};
    for (std::size_t i = 0; i < program.ops.size(); ++i) {
        const Op& op = program.ops[i];
        const bool write = op.kind == Op::Kind::write;
        out += fmt::format("{:5} tick {:8}{} {}", i, op.tick, op.between ? ".5" : "  ", text_of_op(op));
        if (write) registers[op.offset / 2 % 8] = op.value;
        if (write && op.offset == 0) out += text_of_command(op.value, registers[6], registers[7]);
        out += '\n';
    }
    return out;
}

}  // namespace motionrack::mcx314::twin
