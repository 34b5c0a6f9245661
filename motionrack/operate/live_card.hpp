// A real card in the place of a virtual one of the rack, for as long as a service lasts.
//
//   Service ──► library ──► LiveCard ──► live::CardPort ──► card      the card's time is the computer's
//                              │ waits: 1 ms of the rack's time between two looks, so that orders, leases and the
//                              │ status go on
//                              └ after each call and twice a second: all registers, for the card's page
//
// A stop is written in the next look. What the computer refuses ends the service: reads give 0 then, so that functions
// which wait for an axis end, and what they answer is replaced by the reason.
#pragma once

#include <memory>
#include <motionrack/base/function_library.hpp>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/live/card_port.hpp>
#include <motionrack/live/clock.hpp>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/rack.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::operate {

/// Where a real card is that stands for a card of the rack file.
struct LivePlace {
    std::string card;   ///< of the rack file
    std::string place;  ///< "port:/dev/port,offset=0x300,width=8"
    live::PortSpec spec = {};
};
/// Reads CARD=PLACE. Errors: invalid_input, with the form.
Result<LivePlace> read_live_place(std::string_view text);
/// Errors: invalid_input, no such card, or one that is named twice; refused, axes of the machine are on it, or a real
/// card of its type cannot be driven.
Result<void> check_live_places(const rack::RackConfig& config, std::span<const LivePlace> places);

/// All registers of a card, as they were read last.
struct LiveRegisters {
    rack::RegisterView view;
    Instant at{};  ///< of the rack
};

/// What came of a stop.
struct LiveStop {
    bool stands = false;   ///< the axes were seen standing after it
    std::string sentence;  ///< what an alarm says; empty: nothing
};

/// Only the motion thread uses it.
class LiveCard final : public RegisterPort, public Interrupt {
  public:
    /// Opens the port and reads the registers; the rack must outlive it. Errors: as live::CardPort::open; io, an access
    /// that the computer refuses, and no card answers.
    static Result<std::unique_ptr<LiveCard>> open(const LivePlace& place, rack::Rack& rack);

    // ---- for the library
    void write(std::uint32_t offset, std::uint16_t value) override;
    std::uint16_t read(std::uint32_t offset) override;
    bool wait(Duration timeout) override;
    void pass(Duration duration) override;
    Instant now() const override { return clock_.now(); }
    /// Also once the card is lost: functions that wait end then.
    bool stop_requested() const override { return lost_.has_value() || host_.stop_requested(); }
    std::unique_ptr<FunctionLibrary> make_library() { return kind_.library(*this, *this); }

    // ---- for the service
    /// Reads all registers now; writes WR0, with NOP and read commands.
    void look();
    /// The same, if the last look was half a second ago.
    void look_now_and_then();
    const LiveRegisters& registers() const { return registers_; }
    const LivePlace& place() const { return place_; }
    /// Why no access is made any more: the computer refused one, or no card answers.
    const std::optional<Error>& lost() const { return lost_; }
    /// Why a function that has ended cannot be believed; nothing: it can.
    std::optional<Error> doubt() const;
    /// Writes the quick stop of all axes, and looks until they stand, 100 times a millisecond apart. A port that
    /// refused an access before is opened once more for it.
    LiveStop stop(FunctionLibrary& library);

  private:
    LiveCard(const LivePlace& place, rack::Rack& rack, const rack::CardKind& kind);
    Result<void> open_port();
    void keep_up();
    void heed_stop();
    bool stands_after_stop(FunctionLibrary& library);

    LivePlace place_;
    const rack::CardKind& kind_;
    Interrupt& host_;  ///< the rack's time
    live::MonotonicClock clock_;
    std::unique_ptr<live::CardPort> port_;  ///< nullptr: it could not be opened again
    std::optional<Error> lost_;
    LiveRegisters registers_;
    Instant looked_{};                ///< of this clock
    Instant passed_{};                ///< up to here the rack's time has followed this clock
    std::optional<Instant> stopped_;  ///< a function has waited with a stop in force since
    int stop_waits_ = 0;              ///< since then
    bool gives_up_ = false;           ///< for too long: an axis does not stop
};

}  // namespace motionrack::operate
