// A real card that replaces a virtual one of the rack during a service.
//
//   Service ──► library ──► LiveCard ──► live::LivePort ──► card      the card runs on the computer's time
//                              │ waits: polls the card every 1 ms of virtual time, so that commands, leases and the
//                              │ status continue
//                              └ after each call and twice a second: all registers, for the card's page; while a
//                                function waits, those that do not disturb it
//
// A stop is written at the next poll. If a failure of any thread ends the program, the stop is written at once: see
// LastStop. An access that the computer refuses ends the service: reads then return 0, so that functions waiting for an
// axis end, and the reason replaces their result.
#pragma once

#include <memory>
#include <motionrack/base/function_library.hpp>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/live/clock.hpp>
#include <motionrack/live/last_stop.hpp>
#include <motionrack/live/open_card.hpp>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/rack.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::operate {

/// Address of a real card that replaces a card of the rack file.
struct LivePlace {
    std::string card;   ///< name in the rack file
    std::string place;  ///< "port:/dev/port,offset=0x300,width=8"
    live::PortSpec spec = {};
};
/// Parses CARD=PLACE. Errors: invalid_input, with the format.
Result<LivePlace> read_live_place(std::string_view text);
/// Errors: invalid_input for an unknown card, or a card named twice; refused if axes of the machine are on it, or if a
/// real card of its type cannot be driven.
Result<void> check_live_places(const rack::RackConfig& config, std::span<const LivePlace> places);

/// Registers of a card, as last read: while a function waits, only those whose reading does not disturb it.
struct LiveRegisters {
    rack::RegisterView view;
    Instant at{};  ///< virtual time
};

/// Result of a stop.
struct LiveStop {
    bool is_stationary = false;  ///< the registers showed all axes at standstill afterwards
    std::string sentence;        ///< text of an alarm; empty: no alarm
};

/// Used only by the motion thread.
class LiveCard final : public RegisterPort, public BytePort, public Interrupt {
  public:
    /// Opens the port and reads the registers; the rack must outlive the object. Errors: as live::open_card; io if the
    /// computer refuses an access or no card answers.
    static Result<std::unique_ptr<LiveCard>> open(const LivePlace& place, rack::Rack& rack);

    // ---- interface for the library
    void write(std::uint32_t offset, std::uint16_t value) override;
    std::uint16_t read(std::uint32_t offset) override;
    void out(std::uint8_t port, std::uint8_t value) override;
    std::uint8_t in(std::uint8_t port) override;
    bool wait(Duration timeout) override;
    void pass(Duration duration) override;
    Instant now() const override { return clock_.now(); }
    /// Also true once the card is lost, which ends waiting functions.
    bool stop_requested() const override { return lost_.has_value() || host_.stop_requested(); }
    std::unique_ptr<FunctionLibrary> make_library() { return plugin_.library(bus()); }

    // ---- interface for the service
    /// Reads all registers now; writes the commands that reading takes, which move nothing.
    void poll();
    /// Calls poll() if the card was last read at least half a second ago.
    void look_now_and_then();
    const LiveRegisters& registers() const { return registers_; }
    const LivePlace& place() const { return place_; }
    /// Reason for which accesses have ended: the computer refused one, or no card answers.
    const std::optional<Error>& lost() const { return lost_; }
    /// Reason why the result of an ended function may be wrong; nothing: it is valid.
    std::optional<Error> doubt() const;
    /// Writes the quick stop of all axes, and polls up to 100 times, a millisecond apart, until they are at standstill.
    /// A port that has refused an access is first opened once more.
    LiveStop stop(FunctionLibrary& library);

  private:
    LiveCard(const LivePlace& place, rack::Rack& rack, const rack::CardPlugin& plugin);
    rack::CardBus bus() { return {this, this, this, select_}; }
    Result<void> open_port();
    void keep_up();
    /// As look_now_and_then(), while a function waits: reads only the registers whose reading does not disturb it.
    void look_beside_function();
    bool is_look_due() const;
    void heed_stop();
    bool stands_after_stop(FunctionLibrary& library);

    LivePlace place_;
    const rack::CardPlugin& plugin_;
    std::uint8_t select_;
    Interrupt& host_;  ///< virtual time
    live::MonotonicClock clock_;
    live::OpenCard card_;                            ///< without a port: it could not be reopened
    std::unique_ptr<FunctionLibrary> last_library_;  ///< on the port itself: without virtual time
    std::optional<live::LastStop> last_stop_;
    std::optional<Error> lost_;
    LiveRegisters registers_;
    Instant polled_{};                ///< last poll, on clock_
    Instant passed_{};                ///< instant of clock_ up to which virtual time has followed
    std::optional<Instant> stopped_;  ///< since when a function has waited with a stop in force
    int stop_waits_ = 0;              ///< waits since then
    bool gives_up_ = false;           ///< the wait was too long: an axis does not stop
    bool stopping_ = false;           ///< the stop itself waits for the card
};

}  // namespace motionrack::operate
