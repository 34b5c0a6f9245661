// Enabled axes of an operated machine.
//
//   disabled ──enable──► enabled ──disable──► to be disabled: it no longer starts ──standstill──► disabled
#pragma once

#include <array>
#include <motionrack/control/move.hpp>
#include <motionrack/rack/config.hpp>
#include <string_view>

namespace motionrack::operate {

class AxisEnables {
  public:
    /// All axes start as disabled. `config` must outlive this.
    explicit AxisEnables(const rack::RackConfig& config) : config_(config) {}

    /// Enables these axes (letters, "XY"), or disables them at the next standstill; empty: all.
    void set(bool on, std::string_view axes);
    /// Disables the axes for which set() has requested it. Call at standstill.
    void settle();
    bool of(const rack::RackAxis& axis) const { return enabled_[index(axis)]; }
    /// Returns true if the axis is enabled and stays so.
    bool may_move(const rack::RackAxis& axis) const { return of(axis) && !disable_wanted_[index(axis)]; }
    /// Returns true if any axis is enabled.
    bool any() const;

  private:
    static std::size_t index(const rack::RackAxis& axis) { return static_cast<std::size_t>(axis.index()); }

    const rack::RackConfig& config_;
    std::array<bool, control::axis_count> enabled_ = {}, disable_wanted_ = {};
};

}  // namespace motionrack::operate
