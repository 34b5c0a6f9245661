// Accesses to registers of 16 bits.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/live/card_port.hpp>

namespace motionrack::live {

namespace {

constexpr std::uint16_t empty_slot = 0xFFFF;  ///< a bus on which no card answers reads so

}  // namespace

Result<void> CardPort::check(const PortSpec& spec) {
    if (spec.stride % 2 != 0)
        return fail(ErrorKind::invalid_input,
                    fmt::format("stride is {}, but registers of 16 bits are an even number of bytes apart. Nothing was "
                                "opened.",
                                spec.stride));
    if (spec.width == 16 && spec.offset % 2 != 0)
        return fail(ErrorKind::invalid_input,
                    fmt::format("offset is {}, but registers of 16 bits are at even addresses. Nothing was opened.",
                                spec.offset));
    return {};
}

Result<std::unique_ptr<CardPort>> CardPort::open(const PortSpec& spec, const CardMap& map,
                                                 std::unique_ptr<Clock> clock) {
    std::uint32_t last = 0;
    for (const RegisterInfo& reg : map.registers) {
        if (reg.width != 16 || reg.offset % 2 != 0)
            return fail(
                ErrorKind::refused,
                fmt::format("The {} has registers that are not words of 16 bits, which live ports do not reach. "
                            "Nothing was opened.",
                            map.name));
        last = std::max(last, reg.offset);
    }
    MOTIONRACK_CHECK(check(spec));
    PortSpec placed = spec;
    if (placed.stride == 0) placed.stride = 2;
    MOTIONRACK_TRY(Parts parts, open_parts(placed, std::uint64_t{last} / 2 * placed.stride + 2, std::move(clock)));
    return std::unique_ptr<CardPort>(new CardPort(std::move(parts), placed, map, last));
}

CardPort::CardPort(Parts parts, const PortSpec& spec, const CardMap& map, std::uint32_t last)
    : LivePort(std::move(parts), spec), stride_(spec.stride), last_(last) {
    for (const RegisterInfo& reg : map.registers)
        if (reg.access == Access::read && reg.bank.empty()) quiet_.push_back(reg.offset);
}

bool CardPort::begin_access_at(std::uint32_t offset) {
    MOTIONRACK_ASSERT(offset % 2 == 0 && offset <= last_);
    return begin_access();
}

void CardPort::write(std::uint32_t offset, std::uint16_t value) {
    if (!begin_access_at(offset)) return;
    end_access(words().write(std::uint64_t{offset} / 2 * stride_, value), offset, "written");
}

std::uint16_t CardPort::read_word(std::uint32_t offset) {
    std::uint16_t value = empty_slot;
    if (!begin_access_at(offset)) return value;
    end_access(words().read(std::uint64_t{offset} / 2 * stride_, value), offset, "read");
    return value;
}

std::uint16_t CardPort::read(std::uint32_t offset) {
    const std::uint16_t value = read_word(offset);
    if (value == empty_slot && !trouble()) (void)check_answers();  // FFFFh: the register's value, or an empty slot
    return value;
}

Result<void> CardPort::check_answers() {
    for (const std::uint32_t offset : quiet_)
        if (!trouble() && read_word(offset) != empty_slot) return {};
    if (!trouble() && !quiet_.empty())
        set_trouble({ErrorKind::io,
                     fmt::format("Every register reads FFFFh: no card answers at {}. No access is made from here on; "
                                 "its axes may still drive, and their positions are not valid. Check the region, "
                                 "offset and stride, and whether the card is in its slot and has power.",
                                 path())});
    if (trouble()) return tl::unexpected<Error>(*trouble());
    return {};
}

}  // namespace motionrack::live
