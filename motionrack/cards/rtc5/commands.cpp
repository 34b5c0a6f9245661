// Validates the parameters of list commands before loading, and names status bits.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/rtc5/map.hpp>

namespace motionrack::rtc5 {

namespace {

Result<double> checked(const ListCommandInfo& command, const ParamInfo& param, double value) {
    const KindInfo kind = kind_info(param.kind);
    const auto refuse = [&](const std::string& why) {
        return fail(ErrorKind::refused,
                    fmt::format("{}: {} {}; the command was not added to the list", command.name, param.name, why));
    };
    if (!std::isfinite(value)) return refuse(fmt::format("is {}, which is not a number", value));
    const std::string_view blank = kind.unit.empty() ? "" : " ";
    if ((value < kind.min || value > kind.max) && !kind.clipped)
        return refuse(fmt::format("is {}; it must be {} to {}{}{}", value, kind.min, kind.max, blank, kind.unit));
    if (param.kind == Kind::signal && signal_info(static_cast<std::int64_t>(value)) == nullptr)
        return refuse(fmt::format("is {}, and the card has no signal of that number", value));
    if (kind.whole && value != std::floor(value)) return refuse(fmt::format("is {}, but must be whole", value));
    return std::clamp(value, kind.min, kind.max);
}

/// Checks the parameter ranges that depend on the command, beyond those of the parameter's kind.
Result<void> command_ranges(const ListCommandInfo& info, const Command& c) {
    const auto refuse = [&](std::string_view name, double value, std::string_view range) {
        return fail(ErrorKind::refused,
                    fmt::format("{}: {} is {}; it must be {}; the command was not added to the list", info.name, name,
                                value, range));
    };
    const auto up_to = [&](int param, double max) -> Result<void> {
        const double value = c.p[static_cast<std::size_t>(param)];
        if (value <= max) return {};
        return refuse(info.params[static_cast<std::size_t>(param)].name, value, fmt::format("0 to {}", max));
    };
    switch (c.op) {
        case Op::store_encoder:
        case Op::wait_for_mcbsp:
            return up_to(0, 1);
        case Op::set_fly_z:
        case Op::wait_for_encoder:
        case Op::wait_for_encoder_mode:
        case Op::simulate_ext_start:
        case Op::set_ext_start_delay_list:
            return up_to(1, 1);
        case Op::set_encoder_speed:
            if (c.p[2] < 0 || c.p[2] > 1) return refuse("Smooth", c.p[2], "0 to 1");
            return up_to(0, 3);
        case Op::set_mcbsp_in_list:
            if (c.p[0] < 0 || c.p[0] > 3) return refuse("Mode", c.p[0], "0 to 3");
            return {};
        case Op::apply_mcbsp_list:
            return up_to(0, 3);
        case Op::set_laser_delays:
            if (c.p[1] < 0) return refuse("LaserOffDelay", c.p[1], "0 to 65535");
            return {};
        case Op::set_matrix_list:
            MOTIONRACK_CHECK(up_to(0, 1));
            return up_to(1, 1);
        case Op::set_scale_list:
            if (std::abs(c.p[0]) > 16) return refuse("Scale", c.p[0], "-16 to 16");
            return {};
        default:
            return {};
    }
}

}  // namespace

Result<Command> list_command(Op op, std::span<const double> parameters) {
    const auto number = static_cast<std::size_t>(op);
    if (number == 0 || number >= op_count)
        return fail(ErrorKind::refused, fmt::format("unknown list command {}; nothing was added to the list", number));
    const ListCommandInfo& command = info(op);
    const auto wanted = static_cast<std::size_t>(command.param_count());
    if (parameters.size() != wanted)
        return fail(ErrorKind::refused, fmt::format("{} has {} parameters, not {}; it was not added to the list",
                                                    command.name, wanted, parameters.size()));
    Command out;
    out.op = op;
    std::size_t next = 0;
    for (std::size_t i = 0; i < wanted; ++i) {
        MOTIONRACK_TRY(const double value, checked(command, command.params[i], parameters[i]));
        if (command.params[i].kind == Kind::head || next == out.p.size())
            out.head = static_cast<std::int32_t>(value);
        else
            out.p[next++] = value;
    }
    MOTIONRACK_CHECK(command_ranges(command, out));
    return out;
}

Result<void> check_parameter(std::string_view command, std::string_view name, double value, double min, double max,
                             std::string_view unit) {
    if (value >= min && value <= max) return {};
    return fail(ErrorKind::refused,
                fmt::format("{}{}{} is {}; it must be {} to {}{}{}; nothing was changed", command,
                            command.empty() ? "" : ": ", name, value, min, max, unit.empty() ? "" : " ", unit));
}

std::vector<std::string> decoded(std::uint32_t word, std::span<const BitInfo> bits) {
    std::vector<std::string> out;
    for (const BitInfo& bit : bits)
        if (word >> bit.bit & 1) out.push_back(fmt::format("{}: {}", bit.name, bit.meaning));
    return out;
}

}  // namespace motionrack::rtc5
