// Keys of a sweep file, each declared once.
#pragma once

#include <array>
#include <motionrack/sweep/sweep_file.hpp>

namespace motionrack::sweep {

inline constexpr std::array<std::string_view, 2> sampling_names = {"grid", "random"};

inline constexpr std::array<rack::Field, 7> sweep_fields = {
    rack::required(rack::field<&SweepSettings::program>(
                       "program", 1, 4096, "", "part program; relative to the sweep file, as are the other files"),
                   "required"),
    rack::absent_means(rack::field<&SweepSettings::rack>("rack", 1, 4096, "", "rack file"), "the built-in router"),
    rack::absent_means(rack::field<&SweepSettings::tools>("tools", 1, 4096, "", "tool table (LinuxCNC's .tbl)"),
                       "none"),
    rack::field<&SweepSettings::block_delete>("block_delete", 0, 0, "", "skip lines that begin with '/'"),
    rack::with_choices(
        rack::formerly("order", rack::field<&SweepSettings::sampling>(
                                    "sampling", 0, 0, "", "all combinations of the values, or random points")),
        sampling_names),
    rack::absent_means(rack::field<&SweepSettings::points>("points", 1, static_cast<double>(max_points), "",
                                                           "number of random points"),
                       "required with random, else none"),
    rack::field<&SweepSettings::seed>(
        "seed", 0, 2'147'483'647, "",
        "random seed: the same seed gives the same points; more points begin with the same ones"),
};

/// { from = 500, to = 4000, steps = 8 }
struct RangeSettings {
    double from = 0, to = 0;
    std::optional<std::int64_t> steps;
    bool integer = false;
};
inline constexpr std::array<rack::Field, 4> range_fields = {
    rack::required(rack::field<&RangeSettings::from>("from", -1e15, 1e15, "", "the first number"), "required"),
    rack::required(rack::field<&RangeSettings::to>("to", -1e15, 1e15, "", "the last one"), "required"),
    rack::absent_means(rack::field<&RangeSettings::steps>("steps", 2, static_cast<double>(max_steps), "",
                                                          "number of values, at equal distances, including both ends"),
                       "required with grid; with random any value between"),
    rack::formerly("whole", rack::field<&RangeSettings::integer>("integer", 0, 0, "", "rounded to whole numbers")),
};

}  // namespace motionrack::sweep
