// The parts of the virtual RTC5, each with its own part of the state, its commands and its answers. Engine
// (engine.hpp) runs them.
#pragma once

#include <motionrack/cards/rtc5/model/belt_encoders.hpp>
#include <motionrack/cards/rtc5/model/block_buffers.hpp>
#include <motionrack/cards/rtc5/model/connections.hpp>
#include <motionrack/cards/rtc5/model/external_starts.hpp>
#include <motionrack/cards/rtc5/model/fly_correction.hpp>
#include <motionrack/cards/rtc5/model/head_transforms.hpp>
#include <motionrack/cards/rtc5/model/input_wait.hpp>
#include <motionrack/cards/rtc5/model/laser_control.hpp>
#include <motionrack/cards/rtc5/model/list_execution.hpp>
#include <motionrack/cards/rtc5/model/list_memory.hpp>
#include <motionrack/cards/rtc5/model/mcbsp_receiver.hpp>
#include <motionrack/cards/rtc5/model/output_pipeline.hpp>
#include <motionrack/cards/rtc5/model/path_generator.hpp>
#include <motionrack/cards/rtc5/model/settings.hpp>
#include <motionrack/cards/rtc5/model/signal_recorder.hpp>
#include <motionrack/cards/rtc5/model/state.hpp>
#include <motionrack/cards/rtc5/model/status_flags.hpp>
#include <motionrack/cards/rtc5/model/wobbel_motion.hpp>

namespace motionrack::rtc5 {

struct EngineParts {
    /// The parts keep references to all arguments, which must outlive them.
    EngineParts(State& state, const Settings& settings, const Connections& connections, BlockBuffers& buffers)
        : flags(state.flags, state.limits),
          lists(state.lists, state.memory_hash, settings),
          execution(state.lists, flags, connections),
          encoders(state.encoders, state.tick, connections, buffers),
          mcbsp(state.mcbsp, state.fly.now, state.tick, connections, buffers),
          wait(state.activity, encoders, mcbsp, buffers),
          heads(state.transforms, buffers),
          fly(state.fly, state.z, state.tick, encoders, mcbsp, flags, buffers),
          recorder(state.recording, state.sender, state, heads),
          starts(state.starts, state.control_mode, state.tick, encoders, execution, flags, connections, buffers),
          laser(state.laser, state.tick, connections, buffers),
          wobbel(state.wobbel, state.lists, state.activity),
          path(state.path, state.activity, state.p, wait, wobbel, buffers),
          pipeline(state.output, state.p, state.tick, wobbel, fly, heads, recorder, buffers) {}
    EngineParts(const EngineParts&) = delete;
    EngineParts& operator=(const EngineParts&) = delete;

    StatusFlags flags;
    ListMemory lists;
    ListExecution execution;
    BeltEncoders encoders;
    McBspReceiver mcbsp;
    InputWait wait;
    HeadTransforms heads;
    FlyCorrection fly;
    SignalRecorder recorder;
    ExternalStarts starts;
    LaserControl laser;
    WobbelMotion wobbel;
    PathGenerator path;
    OutputPipeline pipeline;
};

}  // namespace motionrack::rtc5
