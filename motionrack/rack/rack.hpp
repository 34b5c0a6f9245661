// A running rack: the cards, wires and machine that a rack file describes, in one kernel.
//
//   RackConfig ──► cards (catalogue) ──pulses──► axis machines ──encoders──► cards
//                       ▲   wires (junctions) ◄── switches, index, emergency stop
//                       └── VirtualPort ◄── driver ◄── axes ◄── controller
#pragma once

#include <functional>
#include <memory>
#include <motionrack/control/path_axes.hpp>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/config.hpp>
#include <motionrack/rack/motions.hpp>
#include <motionrack/sim/input_log.hpp>
#include <motionrack/sim/junction.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/parts/axis_machine.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// One axis of the running machine.
struct RunningAxis {
    RackAxis config;
    Card* card = nullptr;
    int channel = 0;  ///< of the card
    std::unique_ptr<parts::AxisMachine> machine;
};

class Rack {
  public:
    /// Builds cards, parts and wires; nothing has happened yet (virtual time 0). The config must come from read_rack.
    explicit Rack(const RackConfig& config);
    ~Rack();

    const RackConfig& config() const { return config_; }
    sim::Kernel& kernel() { return kernel_; }
    const sim::Kernel& kernel() const { return kernel_; }
    const std::vector<std::unique_ptr<Card>>& cards() const { return cards_; }
    Card* card(std::string_view name);
    std::vector<RunningAxis>& axes() { return axes_; }
    sim::InputLog& input_log() { return log_; }

    /// No more parts: virtual time can run.
    void start();
    bool started() const { return started_; }
    /// All axes of the rack's motion card as a group that follows paths, set up at the machine's start position. Errors: refused if
    /// the axes are not all on one card. The rack must be started.
    Result<control::PathAxes*> path_axes();
    /// For progress, draining and Ctrl-C: see VirtualPort.
    void on_slice(Duration slice, std::function<void()> call);
    void set_stop_flag(const std::atomic<bool>* stop);

    control::Point start_position() const;
    /// A condition as a sentence.
    std::string describe(const sim::Condition& condition);

  private:
    void build_cards();
    void build_axes();
    void join_links();
    void build_wires();
    std::string wire_name(const WireEnd& end) const;

    RackConfig config_;
    sim::Kernel kernel_;
    sim::InputLog log_;
    std::vector<std::unique_ptr<Card>> cards_;
    std::vector<RunningAxis> axes_;
    StillMotion still_;  // what turns a motor whose step input is open
    std::vector<std::unique_ptr<MirroredMotion>> mirrored_;
    std::unique_ptr<sim::Junctions> junctions_;
    bool started_ = false;
};

}  // namespace motionrack::rack
