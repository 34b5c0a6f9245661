// A card on a marking line and its host: loads lists, turns part edges into external starts, and starts into runs.
//
//   sensor   ──┐__┌──┐__      edge ──► track delay, queue of 8 ──► list ──► part
//  list 1   ====      ====   parts with individual texts: the lists alternate, and the host loads the idle one;
//  list 2        ====        it polls every millisecond
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <motionrack/cards/rtc5/model/engine.hpp>
#include <motionrack/mark/plan.hpp>
#include <motionrack/sim/parts/serial_position_source.hpp>

namespace motionrack::mark {

struct RunObserver {
    std::function<void(double part)> progress;  ///< receives the finished part of the work, 0 .. 1
    std::function<bool()> stop;                 ///< polled; true cancels
};

inline constexpr double max_seconds = 1000;  ///< simulated time

/// Loads list 1 or 2 of a card from its start. Errors: refused if the list is too short; nothing is loaded then.
Result<void> put_all(rtc5::Engine& card, int list, const std::vector<rtc5::Command>& commands);

/// Result of a part's start, in ticks of the belt time: 0 is the start of the job.
struct PartRun {
    std::size_t part = 0;    ///< from 0 on
    std::size_t marked = 0;  ///< if the start began a list: index of its drawing for Prepared::of()
    rtc5::StartFate fate = rtc5::StartFate::begun;
    std::int64_t begin = 0, end = 0;  ///< execution of the list; a lost start: both are its instant
};

/// Inputs of the card: the encoder counts and McBSP words of the moving part.
class InputModel final : public rtc5::Inputs {
  public:
    static Result<InputModel> make(const MarkingJob& job, const ConveyorTracking& following);
    /// Sets the belt time to 0 at this tick of the card. Requires that the object already has its final address.
    Result<void> begin(std::int64_t tick);
    void counts(int encoder, std::int64_t first, std::span<std::int32_t> out) override;
    bool words(std::int64_t first, std::span<std::uint32_t> out) override;
    const parts::Conveyor& track() const { return track_; }

  private:
    explicit InputModel(parts::Conveyor track) : track_(std::move(track)) {}
    parts::Conveyor track_;
    std::optional<parts::SerialPositionSettings> sender_;
    std::optional<parts::SerialPositionSource> source_;
    std::int64_t begin_ = 0;
};

class MarkingHost final : rtc5::ListListener {
  public:
    /// Loads settings, tables and the first lists into a new card, and sets the belt time to 0. `job` and `prepared`
    /// must outlive the object. Errors: as list_of(); refused if a list is too long or a part never reaches the sensor.
    static Result<std::unique_ptr<MarkingHost>> make(const MarkingJob& job, const Prepared& prepared,
                                                     const ConveyorTracking& following);

    /// Runs until all parts have passed and the card is idle. Calls `done` periodically with the belt tick.
    /// Errors: refused if it takes longer than max_seconds; stopped.
    Result<void> run(rtc5::Sink* sink, const std::function<void(std::int64_t)>& done, const RunObserver& watch);

    rtc5::Engine& card() { return card_; }
    /// Returns the tick of the card at which the belt time is 0.
    std::int64_t begin() const { return begin_; }
    /// Returns the starts of all parts so far, in time order.
    const std::vector<PartRun>& runs() const { return runs_; }
    /// Returns true if a start came while a list was running.
    bool some_lost() const;

  private:
    MarkingHost(const MarkingJob& job, const Prepared& prepared, const ConveyorTracking& following, InputModel senses,
                const rtc5::Settings& settings);
    Result<void> set_up();
    Result<void> arm();
    Result<void> find_edges();
    Result<void> load(int list, std::size_t marked);
    Result<void> serve();
    void started(std::int64_t tick, rtc5::StartFate fate) override;
    void ended(std::int64_t tick) override;

    const MarkingJob& job_;
    const Prepared& prepared_;
    ConveyorTracking following_;
    InputModel senses_;
    rtc5::Engine card_;
    bool alternates_ = false;
    std::int64_t begin_ = 0;
    std::vector<std::int64_t> edges_;  ///< in belt ticks
    std::size_t next_edge_ = 0;
    std::deque<std::size_t> waiting_;  ///< parts whose start is queued in the card
    std::vector<PartRun> runs_;
    std::array<std::size_t, 2> loaded_{};
    std::size_t begun_ = 0, over_ = 0, next_load_ = 2;
};

}  // namespace motionrack::mark
