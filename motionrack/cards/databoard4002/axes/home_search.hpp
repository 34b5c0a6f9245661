// Homing with the card's own zeroing: the reference input (a cam, a switch), the encoder's zero pulse, or both at once
// set the counter to 0 at that instant.
//
//   type 1  SEARCH ─ref─► STOP ─► HOMED            the counter is 0 at the edge, the axis stops behind it
//   type 2  SEARCH ─ref─► STOP ─► BACK ─off─► STOP ─► SLOW ─ref─► STOP ─► HOMED
//   type 3, 4 as 1, 2, but the counter is 0 at the zero pulse under the cam
//
//   on the cam at the start, or an end stop met in SEARCH ─► BACK, the other way over the cam, ─► SEARCH or SLOW
#pragma once

#include <cstdint>
#include <motionrack/base/switch_edges.hpp>
#include <motionrack/cards/databoard4002/driver/driver.hpp>
#include <motionrack/cards/databoard4002/driver/slope.hpp>
#include <motionrack/control/homing.hpp>
#include <string>
#include <string_view>

namespace motionrack::databoard4002 {

/// Data that a search needs from its axis.
struct HomeFrame {
    std::string name;
    std::string_view unit;
    double counts_per_unit = 100;
    int speed_rate = 1;       ///< the card's rate for the search
    int slow_rate = 1;        ///< the card's rate for the second approach
    std::int64_t travel = 0;  ///< counts: the longest distance travelled in one state
    double offset = 0;        ///< position of the counter's 0 before homing, in `unit`
    Duration settle{};        ///< the axis is at standstill after this time without a count
};

class HomeSearch {
  public:
    HomeSearch(Driver& driver, Interrupt& host) : driver_(driver), host_(host) {}

    void begin(const control::HomingRequest& order, const HomeFrame& frame, Instant now);
    /// Executes one poll; commands take the card's time.
    void step(Instant now);
    /// Ends the search: the output is 0 at once.
    void stop();

    bool running() const { return state_ != State::idle && state_ != State::homed && state_ != State::failed; }
    bool homed() const { return state_ == State::homed; }
    std::string_view state_name() const;
    /// Position of the counter's 0 after homing.
    double home_position() const { return order_.home_offset; }
    const control::HomingResult& outcome() const { return outcome_; }
    /// Reason of the failure. Requires that the search ended without success.
    const Error& error() const { return error_; }

  private:
    enum class State : std::uint8_t { idle, back, back_stop, search, search_stop, slow, slow_stop, homed, failed };

    bool twice() const {
        return order_.method == control::HomingMethod::twice_to_switch ||
               order_.method == control::HomingMethod::twice_and_index;
    }
    bool marking() const { return state_ == State::search || state_ == State::slow; }
    std::uint8_t marks() const;
    Result<void> enter(State state, Instant now);
    Result<void> drive(bool towards, int rate);
    Result<void> poll(Instant now);
    Result<void> look_back(Instant now);
    Result<void> look_search(Instant now);
    Result<void> check_edge(double distance);
    double towards(double distance) const { return order_.towards_plus ? distance : -distance; }
    Result<void> look_standing(Instant now);
    Result<void> check_set_up(const Events& seen) const;
    Result<void> look_at_events(Instant now);
    Result<void> look_at_stop(Instant now);
    Result<void> count(Instant now);
    void leave(Instant now);
    void fail_with(const Error& error, Instant now);
    void finish(State state, std::string sentence, Instant now);
    tl::unexpected<Error> failed(const std::string& why) const;
    double place(double distance) const { return frame_.offset + distance / frame_.counts_per_unit; }
    /// Seconds from the beginning of the search to `then`.
    double since(Instant then) const { return to_seconds(then - outcome_.from); }

    Driver& driver_;
    Interrupt& host_;
    control::HomingRequest order_;
    HomeFrame frame_;
    State state_ = State::idle;
    bool seen_ = false;         // BACK: the reference has been active
    bool turned_ = false;       // an end stop was met
    bool zeroed_ = false;       // the counter's 0 is home
    bool marked_ = false;       // the event that the state waits for has occurred
    bool counted_ = false;      // and is included in the distance
    bool forward_ = false;      // direction of the present drive
    std::int64_t counts_ = 0;   // the card's counter
    double distance_ = 0;       // counts along the whole search, without the zeroing
    double home_distance_ = 0;  // distance at which home was found
    double pace_ = 0;           // velocity at the last poll, counts/s
    Instant polled_{};
    double step_ = 0;          // counts from the last poll to this one
    SwitchEdges edges_;        // in counts
    bool under_ = false;       // the reference was active before the index pulse under it
    double off_distance_ = 0;  // BACK: distance at which the reference was released
    bool off_ = false;
    Instant still_since_{};
    Instant entered_{};
    double entered_way_ = 0;
    Instant stop_seen_ = never;  // instant at which the contacts of a stop have settled
    control::HomingResult outcome_;
    Error error_;
};

}  // namespace motionrack::databoard4002
