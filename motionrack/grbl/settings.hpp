// Numbered settings: most come from the rack file, some belong to the session.
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
    double laser = 0;       ///< $32: changes of S do not wait for the previous motion
};

/// Exactly one of `rack` and `own` is set.
struct Setting {
    int number;
    int decimals;
    std::string_view what;
    double (*rack)(const rack::RackConfig& config);
    double SessionSettingValues::*own;
    double max = 0;  ///< maximum of an own setting; its minimum is 0
};
std::span<const Setting> settings();

/// A number per axis: `first` for X, and so on.
struct AxisSetting {
    int first;
    std::string_view what;
    double (*get)(const rack::RackAxis& axis);
};
std::span<const AxisSetting> axis_settings();

/// Returns all settings for this number of axes as lines: "$0=10" ..
std::string settings_text(const rack::RackConfig& config, const SessionSettingValues& own, int axes);

/// Result of a change of a setting: Grbl's error number, 0 on success, and the message.
struct SettingResult {
    int error = 0;
    std::string note;
};
SettingResult change_setting(const rack::RackConfig& config, SessionSettingValues& own, int axes, int number,
                             double value);

}  // namespace motionrack::grbl
