// A running rack: the cards, wires and machine of a rack file, in one kernel.
//
//   RackConfig ──► cards (catalogue) ──pulses──► axis mechanics ──encoders──► cards
//                       │        └─volts─► servos ──┘   ▲
//                       ▲   wires (connections) ◄── switches, cams, index, emergency stop
//                       └── VirtualPort ◄── driver ◄── axes ◄── controller
//   belts, tables ──encoders, words──► card of a laser ──x, y, gate──► scan heads over them
//   stages: cards ──frames──► processors ──volts──► stages ──scales──► decoder
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/point_to_point_axes.hpp>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/config.hpp>
#include <motionrack/rack/fanout.hpp>
#include <motionrack/rack/marking.hpp>
#include <motionrack/rack/part.hpp>
#include <motionrack/rack/position_functions.hpp>
#include <motionrack/rack/stage.hpp>
#include <motionrack/rack/stop_latch.hpp>
#include <motionrack/sim/input_log.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/parts/axis_mechanics.hpp>
#include <motionrack/sim/parts/dc_motor.hpp>
#include <motionrack/sim/parts/line_encoder.hpp>
#include <motionrack/sim/parts/reference_cam.hpp>
#include <motionrack/sim/parts/signal_lamp.hpp>
#include <motionrack/sim/parts/touch_probe.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <motionrack/sim/wire_connections.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// One axis of the running machine.
struct RunningAxis {
    RackAxis config;
    MotionCard* card = nullptr;
    int channel = 0;                        ///< channel of the card
    std::unique_ptr<parts::DcMotor> servo;  ///< nullptr: a stepping motor, which belongs to the machine
    std::unique_ptr<parts::AxisMechanics> machine;
    std::unique_ptr<parts::ReferenceCam> cam;   ///< may be nullptr
    std::unique_ptr<parts::LineEncoder> lines;  ///< encoder tracks as wires, for cards that need them; may be nullptr
    std::unique_ptr<EdgeFanout> pulse_listeners,
        encoder_listeners;  ///< listeners to the edges of the card's pulses and of the encoder

    /// Source of the machine's motion: the card's pulses or the servo.
    sim::PositionFunction& turned_by() const {
        return servo ? static_cast<sim::PositionFunction&>(*servo) : card->pulses(channel);
    }
    /// Velocity of the table caused by the rotor at `now`, mm/s or degrees/s, signed.
    double velocity(Instant now) const {
        return servo ? servo->rate(now) * machine->units_per_pulse() : machine->velocity();
    }
    /// Returns false at standstill. A servo in position hold oscillates; below 1 % of its velocity it is at standstill.
    bool moves(Instant now) const {
        constexpr double trembles = 0.01;
        return std::fabs(velocity(now)) > (servo ? trembles * config.max_velocity : 0);
    }
};

/// One signal lamp of the running machine.
struct RunningLamp {
    RackLamp config;
    std::unique_ptr<parts::SignalLamp> device;
};

class Rack {
  public:
    /// Builds cards, parts and wires at virtual time 0. The config must come from read_rack.
    explicit Rack(const RackConfig& config);
    ~Rack();

    const RackConfig& config() const { return config_; }
    sim::Kernel& kernel() { return kernel_; }
    const sim::Kernel& kernel() const { return kernel_; }
    const std::vector<std::unique_ptr<Card>>& cards() const { return cards_; }
    Card* card(std::string_view name);
    std::vector<RunningAxis>& axes() { return axes_; }
    std::vector<RunningStage>& stages() { return stages_; }
    /// Returns nullptr if the stage is unknown.
    RunningStage* stage(std::string_view name);
    std::vector<RunningConveyor>& tracks() { return tracks_; }
    std::vector<RunningScanner>& scanners() { return scanners_; }
    std::vector<RunningLamp>& lamps() { return lamps_; }
    /// Returns nullptr if the conveyor is unknown.
    RunningConveyor* track(std::string_view name);
    RunningScanner* scanner(std::string_view name);
    /// All parts of the machine and the cards, in the order of part_kinds().
    const std::vector<std::unique_ptr<Part>>& parts() const { return parts_; }
    StopLatch& stop_latch() { return *stop_latch_; }
    sim::InputLog& input_log() { return log_; }
    /// Listeners to wire changes.
    WireFanout& wire_listeners() { return wire_listeners_; }
    /// Copies the state of another rack of the same config. Both must be started and between runs.
    void copy_from(Rack& other);

    /// Ends construction, so that virtual time can run.
    void start();
    bool started() const { return started_; }
    /// Returns all axes of the rack as an axis group: those of one card that follows paths, or axes that position one
    /// by one (see point_to_point). The group starts at `position`; an axis that positions by itself and has a valid
    /// position must agree with it. Without `position` the axes continue from their counters. Errors: refused if the
    /// rack has both kinds, or an axis does not agree. The rack must be started.
    Result<control::AxisGroup*> path_axes(const std::optional<control::Point>& position);
    Result<control::AxisGroup*> path_axes() { return path_axes(initial_position()); }
    Result<control::AxisGroup*> path_axes_here() { return path_axes(std::nullopt); }
    /// Sets the call-back for progress, draining and Ctrl-C: see VirtualPort. The stop latch is checked after each
    /// call.
    void on_slice(Duration slice, const std::function<void()>& call);
    void set_stop_flag(const std::atomic<bool>* stop);

    control::Point initial_position() const;
    /// Returns a condition as a sentence.
    std::string describe(const sim::Condition& condition);

  private:
    Result<control::AxisGroup*> positioning_axes(const std::optional<control::Point>& position);
    void build_cards();
    void build_axis(const RackAxis& axis);
    void build_probe();
    void build_stages();
    void build_scanners();
    CardProcessor& processor_of(const std::string& card);
    void join_links();
    void build_wires();
    sim::WireId wire_of(const WireEnd& end);
    bool is_contact(const WireEnd& end) const;

    RackConfig config_;
    sim::Kernel kernel_;
    WireFanout wire_listeners_{kernel_};
    sim::InputLog log_;
    std::vector<std::unique_ptr<Card>> cards_;
    std::vector<RunningAxis> axes_;
    std::unique_ptr<parts::TouchProbe> probe_;  // may be nullptr
    std::vector<RunningStage> stages_;
    std::vector<std::pair<std::string, std::unique_ptr<CardProcessor>>> processors_;  // by card name
    std::vector<RunningConveyor> tracks_;
    std::vector<RunningScanner> scanners_;
    std::vector<RunningLamp> lamps_;
    std::vector<std::unique_ptr<Part>> parts_;
    FixedPosition still_;  // source of a motor whose step input is open
    std::vector<std::unique_ptr<InvertedPosition>> mirrored_;
    std::unique_ptr<sim::WireConnections> junctions_;
    std::optional<control::PointToPointAxes> positioning_;
    std::unique_ptr<StopLatch> stop_latch_;
    bool started_ = false;
};

/// Share of each axis' acceleration that a planner leaves to the card; 0 in a rack without axes.
double accel_reserve_of(Rack& rack);

}  // namespace motionrack::rack
