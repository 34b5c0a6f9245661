// A card on its line, with the host that serves it: lists are loaded, edges of parts become external starts, starts
// become runs.
//
//   sensor   ──┐__┌──┐__      edge ──► track delay, queue of 8 ──► list ──► part
//   list 1   ====      ====   parts with texts of their own: the lists take turns, and the host loads the one that is
//   list 2        ====        not running; it looks every millisecond
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

struct Watch {
    std::function<void(double part)> progress;  ///< 0 .. 1
    std::function<bool()> stop;                 ///< true: give up
};

inline constexpr double max_seconds = 1000;  ///< of virtual time

/// Loads list 1 or 2 of a card from its begin. Errors: refused, it has not so many places; nothing was loaded then.
Result<void> put_all(rtc5::Engine& card, int list, const std::vector<rtc5::Command>& commands);

/// What became of a part's start. Ticks are those of the belt: 0 is the job's begin.
struct PartRun {
    std::size_t part = 0;    ///< from 0 on
    std::size_t marked = 0;  ///< which drawing, if it began: Prepared::of
    rtc5::StartFate fate = rtc5::StartFate::begun;
    std::int64_t begin = 0, end = 0;  ///< of the list; if lost: when
};

/// The part's movement as the card's inputs see it.
class InputModel final : public rtc5::Inputs {
  public:
    static Result<InputModel> make(const MarkingJob& job, const ConveyorTracking& following);
    /// After it has come to its place; the belt's time is 0 at this tick of the card.
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
    /// Everything is loaded and the belt's time is 0. `job` and `prepared` must live as long. Errors: as list_of;
    /// refused: a list that is too long, a part that does not come.
    static Result<std::unique_ptr<MarkingHost>> make(const MarkingJob& job, const Prepared& prepared,
                                                     const ConveyorTracking& following);

    /// Until all parts are through and the card rests. `done` is told the belt's tick now and then.
    /// Errors: refused: more than max_seconds; stopped.
    Result<void> run(rtc5::Sink* sink, const std::function<void(std::int64_t)>& done, const Watch& watch);

    rtc5::Engine& card() { return card_; }
    /// The card's tick in which the belt's time is 0.
    std::int64_t begin() const { return begin_; }
    /// In the order of the instants.
    const std::vector<PartRun>& runs() const { return runs_; }
    /// Whether a start came while a list ran.
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
    std::vector<std::int64_t> edges_;  ///< belt's ticks
    std::size_t next_edge_ = 0;
    std::deque<std::size_t> waiting_;  ///< parts whose start is in the card
    std::vector<PartRun> runs_;
    std::array<std::size_t, 2> loaded_{};
    std::size_t begun_ = 0, over_ = 0, next_load_ = 2;
};

}  // namespace motionrack::mark
