// Implements mr_frame_read and mr_frame_wait of motionrack/c.h with the function library of the grating bus cards.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/cards/grating_bus/driver/grating_card.hpp>
#include <motionrack/frontends/c/calls.hpp>
#include <motionrack/frontends/c/session_host.hpp>
#include <motionrack/rack/bus_access.hpp>

namespace {

using namespace motionrack;
using namespace motionrack::c;
namespace gb = grating_bus;

static_assert(MR_MAX_SCALES == gb::max_scales && sizeof(mr_frame::counts) == sizeof(gb::Frame::counts) &&
              sizeof(mr_frame::addresses) == sizeof(gb::Frame::addresses));

constexpr const char* no_frame = "The pointer to the frame is null. Nothing was done.";

/// Registers and interrupt of a card as seen by a program with the rack; stores the first error.
class SessionPort final : public RegisterPort, public SessionHost {
  public:
    using SessionHost::SessionHost;
    void write(std::uint32_t offset, std::uint16_t value) override { keep(session_.write(card_, 16, offset, value)); }
    std::uint16_t read(std::uint32_t offset) override {
        const auto value = keep(session_.read(card_, 16, offset));
        return value ? static_cast<std::uint16_t>(*value) : std::uint16_t{0xFFFF};
    }
};

void copy(const gb::Frame& from, mr_frame& to) {
    to = mr_frame{};
    to.sequence = from.sequence;
    to.words = from.words;
    to.time_100ps = from.time;
    std::copy_n(from.counts.begin(), from.words, to.counts);
    std::copy_n(from.addresses.begin(), from.words, to.addresses);
}

/// Reads a frame of the named grating bus card with `take` and stores it in `frame`.
template <class Take>
Result<void> read_frame(rack::Session& session, std::string_view name, mr_frame& frame, Take take) {
    MOTIONRACK_TRY(const rack::Card* card, rack::card_named(session.rack(), name));
    if (card->map().name != gb::card_map().name)
        return fail(ErrorKind::invalid_input,
                    fmt::format("Card {} is a {}, which has no frames; a grating_bus has. Nothing was done.", name,
                                card->map().name));
    SessionPort port(session, name);
    gb::GratingCard library(port, port);
    const Result<gb::Reading> reading = take(library);
    if (port.error()) return tl::unexpected<Error>(*port.error());
    if (!reading) return tl::unexpected<Error>(reading.error());
    copy(reading->frame, frame);
    return {};
}

}  // namespace

int mr_frame_read(mr_rack* rack, const char* card, mr_frame* frame) {
    return guarded({{rack, no_rack}, {card, no_card}, {frame, no_frame}}, [&] {
        return read_frame(*rack->session, card, *frame, [](gb::GratingCard& library) { return library.read(); });
    });
}

int mr_frame_wait(mr_rack* rack, const char* card, uint64_t timeout_ns, mr_frame* frame) {
    return guarded({{rack, no_rack}, {card, no_card}, {frame, no_frame}}, [&]() -> Result<void> {
        if (timeout_ns > rack::Session::max_ns)
            return fail(ErrorKind::refused,
                        fmt::format("The time-out is {} ns; it must be 0 to {} ns. Nothing was done.", timeout_ns,
                                    rack::Session::max_ns));
        const Duration timeout = nanoseconds(static_cast<std::int64_t>(timeout_ns));
        return read_frame(*rack->session, card, *frame,
                          [&](gb::GratingCard& library) { return library.wait(timeout); });
    });
}
