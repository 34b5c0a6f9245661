// Errors, and checks of arguments that the function library itself cannot receive.
#include <fmt/format.h>
#include <mcx314lib.h>

#include <motionrack/cards/mcx314/driver/own_names.hpp>
#include <motionrack/frontends/mcx314lib/calls.hpp>

namespace motionrack::mcx314lib {

namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): C functions keep it for each thread
thread_local std::string last_error;

}  // namespace

calls::Process<ChipTable>& process() {
    static calls::Process<ChipTable> one;
    return one;
}

void failed(const char* who, std::string_view sentence) noexcept {
    try {
        process().failed(last_error, who, mcx314::with_own_names(sentence, "mcx314_"));
    } catch (...) {
        last_error.clear();
    }
}

Result<unsigned> mask_of(int axis) {
    if (axis >= 1 && axis <= static_cast<int>(mcx314::xyzu)) return static_cast<unsigned>(axis);
    return fail(ErrorKind::refused,
                fmt::format("the axis mask is {}, but X is 1, Y 2, Z 4, U 8, and sums of these are 1 to 15. "
                            "Nothing was written.",
                            axis));
}

Result<int> channel_of(int axis) {
    for (int i = 0; i < 4; ++i)
        if (axis == 1 << i) return i;
    return fail(ErrorKind::refused,
                fmt::format("the axis is {}, but it must be one of X 1, Y 2, Z 4, U 8. Nothing was written.", axis));
}

Result<unsigned> mode_word(int word) {
    if (word >= 0 && word <= 0xFFFF) return static_cast<unsigned>(word);
    return fail(ErrorKind::refused, fmt::format("WR1Reg is {}; it must be 0 to 65535. Nothing was written.", word));
}

}  // namespace motionrack::mcx314lib

// ---- errors

const char* mcx314_last_error(void) {
    return motionrack::mcx314lib::last_error.c_str();
}
void mcx314_clear_error(void) {
    motionrack::mcx314lib::last_error.clear();
}

void mcx314_on_error(void (*handler)(const char* sentence, void* user), void* user) {
    motionrack::mcx314lib::process().on_error(handler, user);
}
