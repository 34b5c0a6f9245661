// Laws of a session that a program outside of the rack drives with its own calls: counters change with pulses, nothing
// moves after a program or homing until a new order, limits are kept, and time is monotone. Of C programs:
// c_sessions.cpp; of Python programs: python/test/laws.py.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace motionrack::test {

/// An axis that a channel of an MCX314 drives.
struct SessionAxis {
    char letter = 'X';
    double pulses_per_unit = 1, max_velocity = 1, max_accel = 1, velocity_step = 1;
};

/// A session as its own queries show it.
struct SessionPicture {
    std::uint64_t ns = 0;
    std::vector<std::int64_t> pulses;    ///< pulses that came to the motor of each axis
    std::vector<std::int64_t> counters;  ///< LP of the channel of each axis
};

class SessionLaws {
  public:
    using Report = std::function<void(const std::string& sentence)>;
    SessionLaws(std::vector<SessionAxis> axes, SessionPicture now, Report report);

    /// Since the last picture, only time has passed, or something was ordered.
    void see(const SessionPicture& now);
    /// The program wrote to a card, forced a wire, moved a part or injected a fault.
    void ordered();
    bool is_ordered() const { return ordered_; }
    /// A part program or homing begins. Call see() before.
    void begin_drive();
    /// While it runs.
    void during_drive(const SessionPicture& now);
    /// `moved`: false: it was refused. `whole`: it ran to its end, without a stop.
    void end_drive(const SessionPicture& now, bool moved, bool whole);

  private:
    void see_time(const SessionPicture& now);
    void see_limits(std::size_t axis, double velocity, double seconds);

    std::vector<SessionAxis> axes_;
    Report report_;
    SessionPicture last_;
    bool ordered_ = false;  ///< since the last picture: counters may have been written
    bool rests_ = false;    ///< nothing may move without an order
    std::vector<double> velocities_;
    double last_seconds_ = 0;  ///< duration of the interval of these velocities; 0: none
    std::string jump_;         ///< the first velocity change above the limits
};

}  // namespace motionrack::test
