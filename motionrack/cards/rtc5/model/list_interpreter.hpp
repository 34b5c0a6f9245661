// Executes list commands: each starts an activity of the path generator (line, arc, delay, wait) or acts on another
// part of the card.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <motionrack/cards/rtc5/model/external_starts.hpp>
#include <motionrack/cards/rtc5/model/fly_correction.hpp>
#include <motionrack/cards/rtc5/model/head_transforms.hpp>
#include <motionrack/cards/rtc5/model/laser_control.hpp>
#include <motionrack/cards/rtc5/model/list_execution.hpp>
#include <motionrack/cards/rtc5/model/list_memory.hpp>
#include <motionrack/cards/rtc5/model/path_generator.hpp>
#include <motionrack/cards/rtc5/model/signal_recorder.hpp>

namespace motionrack::rtc5 {

/// The parts of the card that list commands act on.
struct CommandTargets {
    ListMemory& memory;
    ListExecution& list;
    PathGenerator& path;
    LaserControl& laser;
    WobbelMotion& wobbel;
    HeadTransforms& heads;
    FlyCorrection& fly;
    BeltEncoders& encoders;
    McBspReceiver& mcbsp;
    StatusFlags& flags;
    SignalRecorder& recorder;
    ExternalStarts& starts;
};

class ListInterpreter {
  public:
    ListInterpreter(State& state, const CommandTargets& parts, BlockBuffers& buffers)
        : state_(state), parts_(parts), buffers_(buffers) {}

    /// Ensures an activity for the tick that is n ticks from now. Returns false if a command of the pipeline comes
    /// first, which needs the previous ticks executed.
    bool next_step(std::size_t n);
    /// Fast path for dense lists: consecutive micro-vectors that do not switch the laser, from tick n of the block on,
    /// up to `capacity`. Returns the next tick.
    std::size_t micro_vectors(std::size_t n, std::size_t capacity);
    /// Begins a jump at the jump speed; transforms that wait for a jump apply.
    void jump_to(Point target);

  private:
    void finish(std::int64_t tick);
    void take(const Command& c, std::int64_t tick);
    void take_motion(const Command& c, std::int64_t tick);
    bool begin_polyline(std::int64_t tick);
    const Command* next_mark() const;

    // list_interpreter_commands.cpp
    void pipeline_command(const Command& c);
    bool fly_command(const Command& c);
    void control_command(const Command& c);
    bool empty_cycle(std::initializer_list<std::size_t> encoders);
    void park(const Command& c);

    State& state_;
    CommandTargets parts_;
    BlockBuffers& buffers_;
};

}  // namespace motionrack::rtc5
