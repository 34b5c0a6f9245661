// Detection of the card and configuration of its array.
#include <fmt/format.h>

#include <motionrack/cards/ioflex02/driver/flex02.hpp>
#include <utility>

namespace motionrack::ioflex02 {

namespace {

namespace status {
constexpr Field LOADING = field("STATUS", "LOADING"), RUNNING = field("STATUS", "RUNNING"),
                FAILED = field("STATUS", "FAILED");
}

const char* refusal(std::uint16_t code) {
    switch (static_cast<CfgError>(code)) {
        case CfgError::foreign:
            return "it is not an image of this card";
        case CfgError::length:
            return "the length in its header is out of range";
        case CfgError::cut_short:
            return "it is cut short";
        case CfgError::crc:
            return "its CRC-32 is wrong, so it is damaged";
        default:
            return "the card reports an unknown reason";
    }
}

}  // namespace

Flex02::Flex02(RegisterPort& port, Interrupt& interrupt, FlexSettings settings)
    : port_(port), interrupt_(interrupt), settings_(std::move(settings)) {
    MOTIONRACK_ASSERT(settings_.start_timeout > Duration{0} && settings_.poll > Duration{0});
}

// ---- configuration

bool Flex02::set(FlexResult result, std::string why) {
    Result = result;
    why_ = std::move(why);
    return result == Flex_Ok;
}

void Flex02::Init(std::uint16_t Addr) {
    base_ = Addr;
    set(Flex_ErrDevice, "The array was not configured since the base address was set. Call Configure.");
}

void Flex02::Configure(std::span<const std::uint8_t> image) {
    if (!find_card()) return;
    const motionrack::Result<std::vector<std::uint8_t>> raw = unpacked(image);
    if (!raw) {
        set(Flex_ErrCfg, raw.error().message);
        return;
    }
    if (feed(*raw) && wait_until_running() && check_project()) set(Flex_Ok);
}

bool Flex02::find_card() {
    const std::uint16_t seen = in(offset("SIGNATURE"));
    const std::uint16_t serial = in(offset("SERIAL"));
    const std::uint16_t inverted = in(offset("SERIAL_N"));
    if (seen != signature)
        return set(
            Flex_ErrDevice,
            fmt::format("No IOFLEX02 answers at {:04X}h: the signature reads {:04X}h; it must be {:04X}h. Nothing was "
                        "written; check the base address and its switches.",
                        base_, seen, signature));
    if ((serial ^ inverted) != 0xFFFF)
        return set(
            Flex_ErrDevice,
            fmt::format(
                "At {:04X}h two cards answer, or the card is faulty: the serial number reads {:04X}h and, inverted, "
                "{:04X}h. Nothing was written; give each card its own base address.",
                base_, serial, inverted));
    return true;
}

bool Flex02::feed(std::span<const std::uint8_t> raw) {
    out(offset("CONTROL"), field("CONTROL", "CONFIGURE").mask);
    const std::uint16_t state = in(offset("STATUS"));
    if (!status::LOADING.test(state))
        return set(Flex_ErrDevice, fmt::format("The card at {:04X}h does not accept an image: its status reads {:04X}h "
                                               "after CONFIGURE. Its array is empty; the card seems faulty.",
                                               base_, state));
    for (std::size_t i = 0; i < raw.size(); i += 2) {
        const unsigned high = i + 1 < raw.size() ? raw[i + 1] : 0u;
        out(offset("DATA"), static_cast<std::uint16_t>(raw[i] | high << 8));
    }
    out(offset("CONTROL"), field("CONTROL", "END").mask);
    return true;
}

bool Flex02::wait_until_running() {
    const Instant until = later(interrupt_.now(), settings_.start_timeout);
    while (true) {
        const std::uint16_t state = in(offset("STATUS"));
        if (status::RUNNING.test(state)) return true;
        if (status::FAILED.test(state)) {
            const std::uint16_t code = in(offset("CFG_ERROR"));
            return set(
                Flex_ErrCfg,
                fmt::format(
                    "The card at {:04X}h refused the configuration image (error {}): {}. Its array is empty; make or "
                    "copy the image again.",
                    base_, code, refusal(code)));
        }
        if (interrupt_.stop_requested())
            return set(Flex_ErrCfg,
                       fmt::format("The configuration of the card at {:04X}h was stopped by the user. Call Init again.",
                                   base_));
        if (interrupt_.now() >= until)
            return set(
                Flex_ErrCfg,
                fmt::format(
                    "The array of the card at {:04X}h did not start within {:.1f} s after its image. Call Init again; "
                    "if this persists, the card is faulty.",
                    base_, to_seconds(settings_.start_timeout)));
        interrupt_.pass(settings_.poll);
    }
}

bool Flex02::check_project() {
    const std::uint16_t code = in(offset("CFG_ERROR"));
    const std::uint16_t ident = in(offset("IDENT"));
    if (static_cast<CfgError>(code) == CfgError::unknown_project)
        return set(Flex_ErrProject, fmt::format("The image for the card at {:04X}h is of another project than \"{}\" "
                                                "(ident {:02X}h). The array runs it, but this library cannot use it.",
                                                base_, position_project, ident));
    if (ident != settings_.ident)
        return set(
            Flex_ErrProject,
            fmt::format(
                "The array of the card at {:04X}h has version {:02X}h of the project, but {:02X}h is needed. Use the "
                "image that belongs to this library.",
                base_, ident, settings_.ident));
    return true;
}

// ---- registers

std::uint16_t Flex02::get(std::uint32_t at) {
    return ok() ? in(at) : std::uint16_t{0};
}

void Flex02::put(std::uint32_t at, std::uint16_t value) {
    if (ok()) out(at, value);
}

std::uint32_t Flex02::get24(std::uint32_t low) {
    const std::uint32_t lower = get(low);
    const std::uint32_t upper = get(low + 2);
    return (upper << 16 | lower) & mask_24;
}

std::uint8_t Flex02::GetIdent() {
    return static_cast<std::uint8_t>(get(offset("IDENT")));
}

void Flex02::WriteOutL(std::uint8_t Data) {
    put(offset("OUTL"), Data);
}

void Flex02::WriteOutH(std::uint8_t Data) {
    put(offset("OUTH"), Data);
}

std::uint8_t Flex02::ReadInL() {
    return static_cast<std::uint8_t>(get(offset("IN")));
}

std::uint8_t Flex02::ReadInH() {
    return static_cast<std::uint8_t>(get(offset("IN")) >> 8);
}

}  // namespace motionrack::ioflex02
