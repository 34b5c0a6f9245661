// Which positions of a machine mean places of it: gained by homing and declaring, lost as in a program that is run.
#pragma once

#include <array>
#include <motionrack/control/move.hpp>
#include <motionrack/operate/status.hpp>
#include <motionrack/rack/trust.hpp>
#include <string>
#include <vector>

namespace motionrack::operate {

/// Axes by their letters, which the rack has.
class Trust {
  public:
    /// Nothing is trusted. The rack must outlive this.
    explicit Trust(rack::Rack& rack) : rack_(rack), watch_(rack) {}

    bool of(char letter) const { return trusted_[index(letter)]; }
    void lose(char letter) { trusted_[index(letter)] = false; }
    /// An axis, and what it has lost so far: it stands where somebody will say.
    rack::TrustWatch::Mark mark(char letter) const { return watch_.mark(number(letter)); }
    /// It is trusted; and what it has lost since `from` is lost.
    void begin(char letter, const rack::TrustWatch::Mark& from);
    /// What was lost since the last look, counts wrongly or stays behind: alarms with source, text and axis. Now
    /// and then, between drives.
    std::vector<Alarm> look(Instant now, MachineState state);
    /// At standstill: takes the trust from axes that do not know their positions any more. Their letters: "X, Y".
    std::string lose_unknown();

  private:
    std::size_t index(char letter) const;
    std::size_t number(char letter) const;  ///< in Rack::axes()

    rack::Rack& rack_;
    rack::TrustWatch watch_;
    std::array<bool, control::axis_count> trusted_ = {};
    Instant due_{};
    bool stood_ = false;
};

}  // namespace motionrack::operate
