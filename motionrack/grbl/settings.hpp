// The numbered settings: most are what the rack file says, some belong to the session.
#pragma once

#include <motionrack/rack/config.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::grbl {

/// Settings that a sender may change; they last until the program ends.
struct SessionSettingValues {
    double report = 1;      ///< $10: bit 0 machine positions, else work positions; bit 1 free blocks and bytes
    double inches = 0;      ///< $13: reports in inches
    double max_rpm = 1000;  ///< $30
    double min_rpm = 0;     ///< $31
    double laser = 0;       ///< $32: changes of S do not wait for the motion before them
};

/// Exactly one of `rack` and `own` is there.
struct Setting {
    int number;
    int decimals;
    std::string_view what;
    double (*rack)(const rack::RackConfig& config);
    double SessionSettingValues::*own;
    double most = 0;  ///< own: 0 .. this
};
std::span<const Setting> settings();

/// One number an axis: `first` for X, and so on.
struct AxisSetting {
    int first;
    std::string_view what;
    double (*get)(const rack::RackAxis& axis);
};
std::span<const AxisSetting> axis_settings();

/// "$0=10\r\n" .., all of them, for so many axes.
std::string settings_text(const rack::RackConfig& config, const SessionSettingValues& own, int axes);

/// How an attempt to change a setting ended: Grbl's error number, 0 if it is done, and what to tell.
struct Changed {
    int error = 0;
    std::string note;
};
Changed change_setting(const rack::RackConfig& config, SessionSettingValues& own, int axes, int number, double value);

}  // namespace motionrack::grbl
