// Accesses to ports of 8 bits.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/live/byte_card_port.hpp>

namespace motionrack::live {

Result<std::unique_ptr<ByteCardPort>> ByteCardPort::open(const PortSpec& spec, const CardMap& map,
                                                         std::unique_ptr<Clock> clock) {
    std::uint32_t last = 0;
    for (const RegisterInfo& reg : map.registers) {
        if (reg.width != 8)
            return fail(
                ErrorKind::refused,
                fmt::format("The {} has registers that are not ports of 8 bits. Nothing was opened.", map.name));
        last = std::max(last, reg.offset);
    }
    PortSpec placed = spec;
    placed.width = 8;
    if (placed.stride == 0) placed.stride = 1;
    MOTIONRACK_TRY(Parts parts, open_parts(placed, std::uint64_t{last} * placed.stride + 1, std::move(clock)));
    return std::unique_ptr<ByteCardPort>(new ByteCardPort(std::move(parts), placed, last));
}

ByteCardPort::ByteCardPort(Parts parts, const PortSpec& spec, std::uint32_t last)
    : LivePort(std::move(parts), spec), stride_(spec.stride), last_(last) {}

void ByteCardPort::out(std::uint8_t port, std::uint8_t value) {
    MOTIONRACK_ASSERT(port <= last_);
    if (begin_access()) end_access(words().write_byte(std::uint64_t{port} * stride_, value), port, "written");
}

std::uint8_t ByteCardPort::in(std::uint8_t port) {
    MOTIONRACK_ASSERT(port <= last_);
    std::uint8_t value = 0xFF;
    if (begin_access()) end_access(words().read_byte(std::uint64_t{port} * stride_, value), port, "read");
    return value;
}

}  // namespace motionrack::live
