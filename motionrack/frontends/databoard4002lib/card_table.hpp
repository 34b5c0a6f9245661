// Cards that a process has open through databoard4002lib.h.
//
//   databoard4002_open ──► OpenDataboard 1 ─ CommandLibrary ─┐
//                          OpenDataboard 2 ─ CommandLibrary ─┴─► DataboardBus: live::ByteCardPort, or a rack
//   databoard4002_stop ──► StopFlags ──► StoppableTime ──► the call that waits
//
// Locks, in this order: of a card's calls, of the table, of a bus's accesses. A call that waits gives the last one
// away.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <motionrack/cards/databoard4002/library/library.hpp>
#include <motionrack/live/byte_card_port.hpp>
#include <motionrack/rack/session.hpp>
#include <mutex>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::databoard4002lib {

/// Stops of the open cards, which a thread requests while another one is in a call.
class StopFlags {
  public:
    void add(int handle, std::shared_ptr<std::atomic<bool>> flag);
    void remove(int handle);
    /// No effect if no card has this handle.
    void set(int handle);

  private:
    std::mutex lock_;
    std::map<int, std::shared_ptr<std::atomic<bool>>> flags_;
};
/// Returns the stop flags of the process.
StopFlags& stop_flags();

/// A lock that goes to the threads in the order in which they ask for it.
class TurnLock {
  public:
    void lock();
    void unlock();

  private:
    std::mutex lock_;
    std::condition_variable next_;
    std::uint64_t last_ticket_ = 0, turn_ = 0;
};

/// A bus with cards: a real one, or that of a rack.
struct DataboardBus {
    TurnLock accesses;
    std::unique_ptr<live::ByteCardPort> port;  ///< real cards only
    std::unique_ptr<rack::Session> session;    ///< virtual cards only
};

/// Time and interrupt of a card, with the stop of databoard4002_stop(). Its user has locked the accesses of the bus;
/// pass() lets others have them meanwhile, and drivers select their card again afterwards.
class StoppableTime final : public Interrupt {
  public:
    StoppableTime(Interrupt& inner, DataboardBus& bus, const std::atomic<bool>& stop)
        : inner_(inner), bus_(bus), stop_(stop) {}
    bool wait(Duration timeout) override { return inner_.wait(timeout); }
    void pass(Duration duration) override;
    Instant now() const override { return inner_.now(); }
    bool stop_requested() const override { return stop_.load(); }

  private:
    Interrupt& inner_;
    DataboardBus& bus_;
    const std::atomic<bool>& stop_;
};

/// An open card with its function library. Its calls need both locks, calls() and the bus's.
class OpenDataboard {
  public:
    /// `card`: the virtual card; nullptr: a real one. `port` and `time`: those of the bus.
    OpenDataboard(std::shared_ptr<DataboardBus> bus, rack::Card* card, BytePort& port, Interrupt& time,
                  std::uint8_t number);

    const std::shared_ptr<DataboardBus>& shared_bus() const { return bus_; }
    int number() const { return number_; }
    std::mutex& calls() { return calls_; }
    const std::shared_ptr<std::atomic<bool>>& stop_flag() const { return stop_; }

    /// As CommandLibrary::connect() and begin(). Errors: also those of check_live().
    Result<void> connect();
    Result<void> reset();
    /// Calls a function of the declaration; returns its number, or 0. Errors: invalid_input, a value out of its range;
    /// those of the library and of check_answers().
    Result<std::int64_t> call(std::string_view function, std::span<const std::int64_t> values);
    /// Errors: io, for the first access that the computer refused.
    Result<void> check_live() const;
    /// Errors: as check_live(); machine if no card answers.
    Result<void> check_answers();
    /// Errors: stopped while a stop holds. `effect`: what that means for the call.
    Result<void> check_stop(std::string_view effect) const;
    /// Sends Q, the card's stop command, also while a stop holds. Errors: machine if the card does not take it; those
    /// of check_answers().
    Result<void> stop();
    void reset_stop() { stop_->store(false); }

    Instant now() const { return time_.now(); }
    /// Errors: refused at the end of virtual time.
    Result<void> advance(Duration duration);
    /// Returns the virtual card. Errors: refused if the card is real.
    Result<rack::Card*> virtual_card(std::string_view missing) const;
    Result<void> set_wire(std::string_view wire, double value);

  private:
    std::mutex calls_;
    std::shared_ptr<DataboardBus> bus_;
    rack::Card* card_;
    std::uint8_t number_;
    std::shared_ptr<std::atomic<bool>> stop_ = std::make_shared<std::atomic<bool>>(false);
    StoppableTime time_;
    databoard4002::CommandLibrary library_;
    databoard4002::Driver stopper_;  ///< on the bus itself, which a stop does not guard
};

class DataboardTable {
  public:
    /// See databoard4002_open.
    Result<int> open(const char* place, int number);
    void close(int handle);
    Result<std::shared_ptr<OpenDataboard>> find(int handle) const;

  private:
    Result<std::shared_ptr<DataboardBus>> bus_at(const char* place) const;

    std::map<int, std::shared_ptr<OpenDataboard>> cards_;
    int last_ = 0;
};

}  // namespace motionrack::databoard4002lib
