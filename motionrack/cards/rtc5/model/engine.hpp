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
#include <motionrack/cards/rtc5/model/belt_encoders.hpp>
#include <motionrack/cards/rtc5/model/block_buffers.hpp>
#include <motionrack/cards/rtc5/model/connections.hpp>
#include <motionrack/cards/rtc5/model/correction.hpp>
#include <motionrack/cards/rtc5/model/external_starts.hpp>
#include <motionrack/cards/rtc5/model/fly_correction.hpp>
#include <motionrack/cards/rtc5/model/head_transforms.hpp>
#include <motionrack/cards/rtc5/model/input_wait.hpp>
#include <motionrack/cards/rtc5/model/kernels.hpp>
#include <motionrack/cards/rtc5/model/laser_control.hpp>
#include <motionrack/cards/rtc5/model/list_execution.hpp>
#include <motionrack/cards/rtc5/model/list_interpreter.hpp>
#include <motionrack/cards/rtc5/model/list_memory.hpp>
#include <motionrack/cards/rtc5/model/mcbsp_receiver.hpp>
#include <motionrack/cards/rtc5/model/output_pipeline.hpp>
#include <motionrack/cards/rtc5/model/path_generator.hpp>
#include <motionrack/cards/rtc5/model/settings.hpp>
#include <motionrack/cards/rtc5/model/signal_recorder.hpp>
#include <motionrack/cards/rtc5/model/state.hpp>
#include <motionrack/cards/rtc5/model/status_flags.hpp>
#include <motionrack/cards/rtc5/model/wobbel_motion.hpp>
#include <optional>
#include <string_view>

namespace motionrack::rtc5 {

class Engine {
  public:
    /// `settings` must pass check().
    explicit Engine(const Settings& settings = {});
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    // ---- parts with commands of their own
    FlyCorrection& fly() { return fly_; }
    HeadTransforms& heads() { return heads_; }
    McBspReceiver& mcbsp() { return mcbsp_; }
    const McBspReceiver& mcbsp() const { return mcbsp_; }
    SignalRecorder& recorder() { return recorder_; }
    const SignalRecorder& recorder() const { return recorder_; }

    // ---- lists
    /// list2 of -1: the remaining memory.
    Result<void> config_list(std::int64_t list1, std::int64_t list2) { return memory_.configure(list1, list2); }
    /// Sets the input pointer of put(): list 1 (odd numbers) or 2 (even numbers), also while the list runs. Positions
    /// are 0 .. 1048575; behind the list's end they are 0.
    Result<void> set_start_list(std::uint32_t list, std::int64_t position = 0) {
        return memory_.set_start_list(list, position);
    }
    /// The same for a list that is not running: 1, 2, a free one (0), or a free one that ran to its end (3). Returns
    /// the opened list; 0: none, and put() is refused until a list is opened.
    Result<std::uint32_t> load_list(std::uint32_t list, std::int64_t position) {
        return memory_.load_list(list, position);
    }
    /// Stores the commands up to list_return as subroutine `index` (0 .. 1023) in list 3; without commands the
    /// subroutine is deleted.
    Result<void> load_sub(std::uint32_t index) { return memory_.load_sub(index); }
    /// Appends a command; refused if the list is full (nothing is changed). `command` must come from list_command().
    Result<void> put(const Command& command) { return memory_.put(command); }
    std::int64_t input_pointer() const { return state_.lists.input; }
    /// Parameters as set_start_list takes them.
    Result<void> execute_list(std::uint32_t list, std::int64_t position = 0);
    Result<void> execute_at(std::int64_t position) { return list_.execute_at(position); }
    void auto_change() { list_.auto_change(); }
    void start_loop() { list_.start_loop(); }
    void quit_loop() { list_.quit_loop(); }
    void stop_execution() { stop(startstop_bit("INTERNAL_STOP")); }
    void pause_list();
    void restart_list();
    /// Jumps at the jump speed; only while no list runs.
    Result<void> goto_xy(double x, double y);

    // ---- control commands
    /// Resets everything except McBSP location 0, its filling, and the inputs. Lists, tables and settings return to
    /// their power-up state.
    void load_program_file();
    /// Loads table 1 to 4; nullptr: 1:1.
    Result<void> load_correction(std::shared_ptr<const Table> table, int number) {
        return heads_.load_table(std::move(table), number);
    }
    /// Selects the tables of head A and B, 0 .. 4; 0: A: 1:1, B: no output.
    Result<void> select_cor_table(int head_a, int head_b) { return heads_.select_tables(head_a, head_b); }
    Result<void> set_delays(const Delays& delays) { return path_.set_delays(delays); }
    void set_jump_speed(double bits_ms) { path_.set_jump_speed(bits_ms); }
    void set_mark_speed(double bits_ms) { path_.set_mark_speed(bits_ms); }
    Result<void> simulate_encoder(int which) { return encoders_.simulate(which); }
    void set_tracking_error(std::uint16_t x, std::uint16_t y) { encoders_.set_tracking_error(x, y); }
    void set_control_mode(std::uint32_t mode) { state_.control_mode = mode; }
    Result<void> set_ext_start_delay(std::int32_t delay, int encoder);
    void set_extstartpos(std::int64_t position) { starts_.set_position(position); }
    Result<void> set_encoder_speed(int encoder, double counts_ms, double smooth) {
        return encoders_.watch_speed(encoder, counts_ms, smooth);
    }
    /// Copies the data that State does not contain from the card whose state was copied: tables and recorded samples.
    void copy_beside_state(const Engine& other);
    Result<void> apply_mcbsp(int head, int at_once) { return heads_.apply(mcbsp_, head, at_once); }
    /// Disabling switches the laser off and blocks it until it is enabled again.
    void enable_laser() { laser_.enable(); }
    void disable_laser() { laser_.disable(); }

    // ---- external inputs
    void external_start() { starts_.trigger(); }
    void external_stop() { stop(startstop_bit("EXTERNAL_STOP")); }
    void set_count(int encoder, std::int32_t counts) { encoders_.set_count(encoder, counts); }
    /// Records a tick in which both lines of an encoder changed.
    void encoder_sequence_error(int encoder);
    /// Sets the source of inputs; nullptr: set_count and receive.
    void set_inputs(Inputs* inputs) { connections_.inputs = inputs, starts_.forget_inputs(); }
    /// Sets the listener; nullptr: none.
    void set_listener(ListListener* listener) { connections_.listener = listener; }

    // ---- running
    /// Runs the ticks before `tick`.
    void run_until(std::int64_t tick, Sink* sink = nullptr);
    /// Runs at most `ticks` ticks until no list runs, nothing moves and no start waits; returns true if this state was
    /// reached.
    bool run_to_rest(std::int64_t ticks, Sink* sink = nullptr);
    std::int64_t tick() const { return state_.tick; }
    /// True if no list runs, nothing moves or waits to start, and no laser change is pending.
    bool at_rest() const;

    // ---- answers
    bool busy() const { return list_.is_running(); }
    std::uint32_t status() const { return list_.status(); }
    std::uint32_t list_status() const { return memory_.status(); }
    std::int64_t list_position() const { return list_.position(); }
    std::int32_t encoder(int number) const { return encoders_.count(static_cast<std::size_t>(number)); }
    /// Reads and clears by the rules of RULES.md.
    std::uint32_t get_marking_info() { return flags_.take_marking_info(); }
    /// Both counts of store_encoder, `pos` 0 or 1.
    std::array<std::int32_t, 2> read_encoder(int pos) const { return encoders_.stored(pos); }
    std::uint32_t get_startstop_info();
    /// Correction table 1 .. 4; nullptr: 1:1.
    const Table* table(std::int64_t number) const { return heads_.table(number); }
    /// The same without clearing.
    std::uint32_t startstop_info() const;
    /// Counts/ms after the filters; 0 while not watched.
    double encoder_speed() const { return encoders_.speed(); }
    /// x, y of head A in the last tick.
    const HeadOutput& output() const { return pipeline_.output(); }
    const State& state() const { return state_; }
    /// Extent of the corrected position (before clipping) while a correction was on, since clear_extent: the margin of
    /// a job in the field. Not part of the state.
    const PlanExtent& extent() const { return pipeline_.extent(); }
    void clear_extent() { pipeline_.clear_extent(); }
    State& mutable_state() { return state_; }
    std::span<Command> memory() { return memory_.commands(); }
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
    StatusFlags flags_{state_.flags, state_.limits};
    ListMemory memory_{state_.lists, state_.memory_hash, settings_};
    ListExecution list_{state_.lists, flags_, connections_};
    BeltEncoders encoders_{state_.encoders, state_.tick, connections_, *buffers_};
    McBspReceiver mcbsp_{state_.mcbsp, state_.fly.now, state_.tick, connections_, *buffers_};
    InputWait wait_{state_.activity, encoders_, mcbsp_, *buffers_};
    HeadTransforms heads_{state_.transforms, *buffers_};
    FlyCorrection fly_{state_.fly, state_.z, state_.tick, encoders_, mcbsp_, flags_, *buffers_};
    SignalRecorder recorder_{state_.recording, state_.sender, state_, heads_};
    ExternalStarts starts_{state_.starts, state_.control_mode, state_.tick, encoders_, list_,
                           flags_,        connections_,        *buffers_};
    LaserControl laser_{state_.laser, state_.tick, connections_, *buffers_};
    WobbelMotion wobbel_{state_.wobbel, state_.lists, state_.activity};
    PathGenerator path_{state_.path, state_.activity, state_.p, wait_, wobbel_, *buffers_};
    OutputPipeline pipeline_{state_.output, state_.p, state_.tick, wobbel_, fly_, heads_, recorder_, *buffers_};
    ListInterpreter interpreter_{
        state_,
        {memory_, list_, path_, laser_, wobbel_, heads_, fly_, encoders_, mcbsp_, flags_, recorder_, starts_},
        *buffers_};
    bool until_rest_ = false;  // the run ends when the card is idle
};

}  // namespace motionrack::rtc5
