// The virtual RTC5: lists of vectors become outputs every 10 us, corrected for a part that moves (RULES.md).
//
//   list ──► vectors ──► p ──► global ──► fly ──► flags ──► matrix ──► clip ──► table ──► gain ──► x, y of head A and B
//                │                         ▲
//                └──► laser gate           └── encoder counts, McBSP words                every 10 us, in blocks
//
// The engine needs no kernel: run_until(tick, sink) runs in bulk and passes blocks of samples to the sink; without a
// sink it skips from vector to vector. Card (card.hpp) is the engine on the wires of a rack.
#pragma once

#include <memory>
#include <motionrack/cards/rtc5/model/engine_parts.hpp>
#include <motionrack/cards/rtc5/model/list_interpreter.hpp>

namespace motionrack::rtc5 {

class Engine {
  public:
    /// `settings` must pass check().
    explicit Engine(const Settings& settings = {});
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    /// Returns the parts; commands and answers that concern a single part are called on that part.
    EngineParts& parts() { return parts_; }
    const EngineParts& parts() const { return parts_; }

    // ---- lists
    /// Sets the input pointer of put() to `position` in list 1 (odd numbers) or 2 (even numbers), also while the list
    /// runs. Positions are 0 .. 1048575; one behind the list's end counts as 0.
    Result<void> set_start_list(std::uint32_t list, std::int64_t position = 0) {
        return parts_.lists.set_start_list(list, position);
    }
    /// Appends a command; refused if the list is full (nothing is changed). `command` must come from list_command().
    Result<void> put(const Command& command) { return parts_.lists.put(command); }
    std::int64_t input_pointer() const { return state_.lists.input; }
    /// Starts a list at a position; both parameters are as for set_start_list(). Refused while the card is busy.
    Result<void> execute_list(std::uint32_t list, std::int64_t position = 0);
    void stop_execution() { stop(startstop_bit("INTERNAL_STOP")); }
    void pause_list();
    void restart_list();
    /// Jumps to (x, y) bits at the jump speed; refused while a list runs.
    Result<void> goto_xy(double x, double y);

    // ---- control commands
    /// Resets everything except McBSP location 0, its filling, and the inputs. Lists, tables and settings return to
    /// their power-up state.
    void load_program_file();
    void set_control_mode(std::uint32_t mode) { state_.control_mode = mode; }
    Result<void> set_ext_start_delay(std::int32_t delay, int encoder);
    /// Copies the data that State does not contain from the card whose state was copied: tables and recorded samples.
    void copy_beside_state(const Engine& other);
    Result<void> apply_mcbsp(int head, int at_once) { return parts_.heads.apply(parts_.mcbsp, head, at_once); }

    // ---- external inputs
    void external_stop() { stop(startstop_bit("EXTERNAL_STOP")); }
    /// Sets the source of inputs; nullptr: inputs come from BeltEncoders::set_count and McBspReceiver::receive.
    void set_inputs(Inputs* inputs) { connections_.inputs = inputs, parts_.starts.forget_inputs(); }
    /// Sets the listener of list starts and ends; nullptr: none.
    void set_listener(ListListener* listener) { connections_.listener = listener; }

    // ---- running
    /// Executes all ticks before `tick`, so that `tick` is the next one; passes their samples to `sink`.
    void run_until(std::int64_t tick, Sink* sink = nullptr);
    /// Runs at most `ticks` ticks until no list runs, nothing moves and no start waits; returns true if this state was
    /// reached.
    bool run_to_rest(std::int64_t ticks, Sink* sink = nullptr);
    std::int64_t tick() const { return state_.tick; }
    /// Returns true if no list runs, nothing moves or waits to start, and no laser change is pending.
    bool at_rest() const;

    // ---- answers
    bool busy() const { return parts_.execution.is_running(); }
    std::uint32_t status() const { return parts_.execution.status(); }
    std::int32_t encoder(int number) const { return parts_.encoders.count(static_cast<std::size_t>(number)); }
    std::uint32_t get_startstop_info();
    /// Returns the start and stop info without clearing it.
    std::uint32_t startstop_info() const;
    /// Returns the outputs of the last tick: x, y of both heads and Z.
    const HeadOutput& output() const { return parts_.pipeline.output(); }
    const State& state() const { return state_; }
    State& mutable_state() { return state_; }
    const Settings& settings() const { return settings_; }

  private:
    static constexpr std::size_t block = kernels::block;

    // engine.cpp
    void begin_tick();
    void piece(std::int64_t end, Sink* sink);
    std::size_t produce(std::size_t capacity);
    bool skip(std::int64_t limit);
    void advance(std::int64_t n);

    // control.cpp
    void stop(std::uint32_t cause);

    Settings settings_;
    State state_;
    Connections connections_;
    std::unique_ptr<BlockBuffers> buffers_ = std::make_unique<BlockBuffers>();
    EngineParts parts_{state_, settings_, connections_, *buffers_};
    ListInterpreter interpreter_{
        state_,
        {parts_.lists, parts_.execution, parts_.path, parts_.laser, parts_.wobbel, parts_.heads, parts_.fly,
         parts_.encoders, parts_.mcbsp, parts_.flags, parts_.recorder, parts_.starts},
        *buffers_};
    bool until_rest_ = false;  // the run ends when the card is idle
};

}  // namespace motionrack::rtc5
