// Prints register programs in readable form.
#include <fmt/format.h>

#include <cstdio>
#include <motionrack/cards/mcx314/test/program.hpp>

namespace motionrack::mcx314::twin {

namespace {

const char* name_of_command(int code) {
    static constexpr const char* data[] = {"R",  "K", "A",  "D",  "SV",    "V",     "P",
                                           "DP", "C", "LP", "EP", "COMP+", "COMP-", "AO"};
    if (code <= 0x0D) return data[code];
    switch (code) {
        case 0x0E:
            return "L";
        case 0x14:
            return "read BR";
        case 0x60:
            return "EM";
        case 0x61:
            return "HV";
        case 0x62:
            return "home search";
        case 0x63:
            return "clear pulse";
        case 0x64:
            return "SM";
        case 0x65:
            return "act";
        case 0x0F:
            return "select";
        case 0x10:
            return "read LP";
        case 0x11:
            return "read EP";
        case 0x12:
            return "read CV";
        case 0x13:
            return "read CA";
        case 0x20:
            return "+ fixed";
        case 0x21:
            return "- fixed";
        case 0x22:
            return "+ continuous";
        case 0x23:
            return "- continuous";
        case 0x24:
            return "hold";
        case 0x25:
            return "free";
        case 0x26:
            return "decelerating stop";
        case 0x27:
            return "immediate stop";
        case 0x30:
            return "2-axis line";
        case 0x31:
            return "3-axis line";
        case 0x32:
            return "CW arc";
        case 0x33:
            return "CCW arc";
        case 0x34:
            return "2-axis pattern";
        case 0x35:
            return "3-axis pattern";
        case 0x36:
            return "pattern registers on";
        case 0x37:
            return "pattern registers off";
        case 0x38:
            return "stack the pattern";
        case 0x39:
            return "clear the pattern";
        case 0x3A:
            return "step";
        case 0x3B:
            return "deceleration on";
        case 0x3C:
            return "deceleration off";
        case 0x3D:
            return "clear interrupt";
        default:
            return "?";
    }
}

}  // namespace

std::string text_of(const Program& program) {
    static constexpr const char* pins[] = {"IN0",  "IN1",   "IN2",   "IN3",  "EXPP",
                                           "EXPM", "INPOS", "ALARM", "LMTP", "LMTM"};
    const ChipOptions& options = program.options;
    const Way& way = program.way;
    std::string out = fmt::format("{}{}{}{}{}{}AO {}, slices {}, saved after op {}, seed {}, program {}, {} ticks\n",
                                  program.extended() ? "MCX314As, " : "",
                                  options.slow_drive == SlowDrive::at_sv ? "slow drives at SV, " : "",
                                  options.software_limit == SoftwareLimit::at ? "limits at COMP+, " : "",
                                  way.listen ? "" : "nobody listens to edges, ", way.watch ? "counts watched, " : "",
                                  way.follow ? "pins followed, " : "", options.offset_after_reset, way.slices,
                                  program.snapshot_at, program.seed, program.number, program.ticks);
    unsigned wr6 = 0, wr7 = 0;
    for (const Op& op : program.ops) {
        char line[160];
        int n = std::snprintf(line, sizeof line, "%5zu tick %8lld%s ", static_cast<std::size_t>(&op - &program.ops[0]),
                              static_cast<long long>(op.tick), op.between ? ".5" : "  ");
        const auto rest = [&] { return sizeof line - static_cast<std::size_t>(n); };
        if (op.kind == Op::Kind::input) {
            n +=
                std::snprintf(line + n, rest(), "%c%s = %d", "XYZU"[op.axis], pins[static_cast<int>(op.pin)], op.value);
        } else if (op.kind == Op::Kind::emergency) {
            n += std::snprintf(line + n, rest(), "EMGN = %d", op.value);
        } else if (op.kind == Op::Kind::encoder) {
            n += std::snprintf(line + n, rest(), "%cEC%c = %d", "XYZU"[op.axis], op.offset == 0 ? 'A' : 'B', op.value);
        } else if (op.kind == Op::Kind::step) {
            n += std::snprintf(line + n, rest(), "EXPLSN = %d", op.value);
        } else if (op.kind == Op::Kind::write_byte) {
            n += std::snprintf(line + n, rest(), "WR%d%c = %02X", op.offset / 2, op.offset % 2 != 0 ? 'H' : 'L',
                               op.value);
        } else if (op.kind == Op::Kind::read_byte) {
            n += std::snprintf(line + n, rest(), "read RR%d%c", op.offset / 2, op.offset % 2 != 0 ? 'H' : 'L');
        } else if (op.kind == Op::Kind::read) {
            n += std::snprintf(line + n, rest(), "read RR%d", op.offset / 2);
        } else {
            n += std::snprintf(line + n, rest(), "WR%d = %04X", op.offset / 2, op.value);
            if (op.offset == 12) wr6 = op.value;
            if (op.offset == 14) wr7 = op.value;
            if (op.offset == 0) {
                n += std::snprintf(line + n, rest(), "  %s%s%s%s %s", op.value & 0x100 ? "X" : "",
                                   op.value & 0x200 ? "Y" : "", op.value & 0x400 ? "Z" : "",
                                   op.value & 0x800 ? "U" : "", name_of_command(op.value & 0xFF));
                if (const int code = op.value & 0xFF; code == 0x60 || code == 0x64)
                    n += std::snprintf(line + n, rest(), " = %04X %04X", wr7, wr6);
                else if (code <= 0x0E || code == 0x61)
                    n += std::snprintf(line + n, rest(), " = %d", static_cast<std::int32_t>(wr7 << 16 | wr6));
            }
        }
        out += line;
        out += '\n';
    }
    return out;
}

}  // namespace motionrack::mcx314::twin
