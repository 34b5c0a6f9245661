// Accesses, one at a time, with a minimum interval.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <motionrack/live/card_port.hpp>

namespace motionrack::live {

namespace {

constexpr std::uint16_t empty_slot = 0xFFFF;  ///< a bus on which no card answers reads so

}  // namespace

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
    MOTIONRACK_TRY(auto words, open_words(spec, std::uint64_t{last} / 2 * spec.stride + 2));
    std::optional<InterruptLine> line;
    if (!spec.interrupt.empty()) {
        MOTIONRACK_TRY(line, InterruptLine::open(spec.interrupt));
    }
    if (!clock) clock = std::make_unique<MonotonicClock>();
    return std::unique_ptr<CardPort>(
        new CardPort(std::move(words), std::move(line), std::move(clock), spec, map, last));
}

CardPort::CardPort(std::unique_ptr<WordAccess> words, std::optional<InterruptLine> line, std::unique_ptr<Clock> clock,
                   const PortSpec& spec, const CardMap& map, std::uint32_t last)
    : words_(std::move(words)),
      line_(std::move(line)),
      clock_(std::move(clock)),
      path_(spec.path),
      gap_(spec.gap),
      stride_(spec.stride),
      last_(last) {
    for (const RegisterInfo& reg : map.registers)
        if (reg.access == Access::read && reg.bank.empty()) quiet_.push_back(reg.offset);
}

bool CardPort::begin_access(std::uint32_t offset) {
    MOTIONRACK_ASSERT(offset % 2 == 0 && offset <= last_);
    if (trouble_) return false;
    if (accessed_)
        if (const Duration left = *accessed_ + gap_ - clock_->now(); left > Duration{0}) clock_->sleep(left);
    return true;
}

void CardPort::end_access(int error, std::uint32_t offset, const char* what) {
    accessed_ = clock_->now();
    if (error != 0)
        trouble_ =
            Error{ErrorKind::io,
                  fmt::format("The register at {:02X}h could not be {} through {}: {}. No access is made from here on; "
                              "the card continues its current motion.",
                              offset, what, path_, std::strerror(error))};
}

void CardPort::write(std::uint32_t offset, std::uint16_t value) {
    if (!begin_access(offset)) return;
    end_access(words_->write(std::uint64_t{offset} / 2 * stride_, value), offset, "written");
}

std::uint16_t CardPort::read_word(std::uint32_t offset) {
    std::uint16_t value = empty_slot;
    if (!begin_access(offset)) return value;
    end_access(words_->read(std::uint64_t{offset} / 2 * stride_, value), offset, "read");
    return value;
}

std::uint16_t CardPort::read(std::uint32_t offset) {
    const std::uint16_t value = read_word(offset);
    if (value == empty_slot && !trouble_) (void)check_answers();  // FFFFh: the register's value, or an empty slot
    return value;
}

Result<void> CardPort::check_answers() {
    for (const std::uint32_t offset : quiet_)
        if (!trouble_ && read_word(offset) != empty_slot) return {};
    if (!trouble_ && !quiet_.empty())
        trouble_ = Error{ErrorKind::io,
                         fmt::format("Every register reads FFFFh: no card answers at {}. No access is made from here "
                                     "on; its axes may still drive, and their positions are not valid. Check the "
                                     "region, offset and stride, and whether the card is in its slot and has power.",
                                     path_)};
    if (trouble_) return tl::unexpected<Error>(*trouble_);
    return {};
}

bool CardPort::wait(Duration timeout) {
    if (line_) return line_->wait(timeout, *clock_);
    clock_->sleep(timeout);
    return false;
}

}  // namespace motionrack::live
