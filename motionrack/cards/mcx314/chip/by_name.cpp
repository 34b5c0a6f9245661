// Finds the value of an axis or of the chip, or the register, that a name denotes.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/cards/mcx314/chip/by_name.hpp>

namespace motionrack::mcx314 {

namespace {

bool is_inspected(std::string_view name, bool per_axis) {
    const std::vector<std::string_view> names = Chip::inspected_names(per_axis);
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

Result<std::int64_t> value_by_name(const Chip& chip, const CardMap& map, std::string_view card, std::string_view name,
                                   std::string_view quoted) {
    const std::size_t axis =
        name.size() > 2 && name[1] == '.' ? std::string_view("xyzu").find(name[0]) : std::string_view::npos;
    if (axis != std::string_view::npos && is_inspected(name.substr(2), true))
        return *chip.inspect(name.substr(2), static_cast<int>(axis));
    if (is_inspected(name, false)) return *chip.inspect(name, 0);
    // Without an axis: the axis whose registers the bus shows.
    for (const RegisterInfo& reg : map.registers)
        if (reg.name == name && reg.access != Access::write) return chip.peek(reg.offset);
    return fail(
        ErrorKind::invalid_input,
        fmt::format("Card {} has no value {}; it has {}, and with x. y. z. or u. in front {}. Nothing was done.", card,
                    quoted, fmt::join(Chip::inspected_names(false), ", "),
                    fmt::join(Chip::inspected_names(true), ", ")));
}

}  // namespace motionrack::mcx314
