// Laws of a session that a host program drives with its own calls: counters change only with pulses, nothing moves
// after a program or homing until a new command, limits are kept, and time is monotone. For C programs: c_sessions.cpp;
// for Python programs: python/test/laws.py.
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

/// State of a session, read by its own queries.
struct SessionPicture {
    std::uint64_t ns = 0;
    std::vector<std::int64_t> pulses;    ///< pulses received by the motor of each axis
    std::vector<std::int64_t> counters;  ///< LP of the channel of each axis
};

class SessionLaws {
  public:
    using Report = std::function<void(const std::string& sentence)>;
    SessionLaws(std::vector<SessionAxis> axes, SessionPicture now, Report report);

    /// Checks a picture. Since the last one, only time has passed, or ordered() was called.
    void see(const SessionPicture& now);
    /// The program wrote to a card, forced a wire, moved a part or injected a fault.
    void ordered();
    bool is_ordered() const { return ordered_; }
    /// Call it when a part program or homing begins, after see().
    void begin_drive();
    /// Checks a picture while it runs.
    void during_drive(const SessionPicture& now);
    /// Call it at its end. `moved`: false: it was refused. `whole`: it ran to its end, without a stop.
    void end_drive(const SessionPicture& now, bool moved, bool whole);

  private:
    void see_time(const SessionPicture& now);
    void see_limits(std::size_t axis, double velocity, double seconds);

    std::vector<SessionAxis> axes_;
    Report report_;
    SessionPicture last_;
    bool ordered_ = false;  ///< since the last picture: counters may have been written
    bool rests_ = false;    ///< nothing may move without a command
    std::vector<double> velocities_;
    double last_seconds_ = 0;  ///< duration of the interval of these velocities; 0: none
    std::string jump_;         ///< the first velocity change above the limits
};

}  // namespace motionrack::test
