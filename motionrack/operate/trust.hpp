// Which positions of a machine mean places of it: gained by homing and declaring, lost as in a program that is run.
#pragma once

#include <array>
#include <motionrack/control/axis.hpp>
#include <motionrack/control/move.hpp>
#include <motionrack/operate/status.hpp>
#include <motionrack/rack/trust.hpp>
#include <string>
#include <vector>

namespace motionrack::operate {

/// Somebody says where an axis stands; its card takes that over a little later.
struct Declared {
    char letter = 'X';
    double position = 0;
    rack::TrustWatch::Mark stood;  ///< when it was said
};

/// Axes by their letters, which the rack has.
class Trust {
  public:
    /// Nothing is trusted. The rack must outlive this.
    explicit Trust(rack::Rack& rack) : rack_(rack), watch_(rack) {}

    bool of(char letter) const { return trusted_[index(letter)]; }
    void lose(char letter) { trusted_[index(letter)] = false; }
    Declared declared(char letter, double position) const { return {letter, position, watch_.mark(number(letter))}; }
    /// It is trusted then; what it has lost since it was declared is lost. Errors: as Axis::set_position.
    Result<void> take(control::Axis& axis, const Declared& declared);
    /// It is trusted, and where it says since then.
    void begin_at_home(char letter, Instant since);
    /// What was lost since the last look, counts wrongly or stays behind: alarms with source, text and axis. Now
    /// and then, between drives.
    std::vector<Alarm> look(Instant now, MachineState state);
    /// At standstill: takes the trust from axes that do not know their positions any more. Their letters: "X, Y".
    std::string lose_unknown();

  private:
    std::size_t index(char letter) const;
    std::size_t number(char letter) const;  ///< in Rack::axes()
    void begin(char letter, const rack::TrustWatch::Mark& from);
    void lose_reset(bool comes_to_rest, std::vector<Alarm>& out);

    rack::Rack& rack_;
    std::uint64_t trips_ = 0;  ///< of the stop latch, looked at
    rack::TrustWatch watch_;
    std::array<bool, control::axis_count> trusted_ = {};
    Instant due_{};
    bool stood_ = false;
};

}  // namespace motionrack::operate
