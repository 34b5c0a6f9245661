// calibrate: computes the corrections of a marking machine from marks and readings.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <memory>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <motionrack/mark/calibration.hpp>
#include <vector>

namespace motionrack::cli {

namespace {

struct CalibrateOptions {
    mark::ScaleData scale{.bits_per_mm = 8656};
    std::vector<double> readings, marks, velocities, shifts;
    double place_uncertainty_mm = 0.01, count_uncertainty = 0.5;
    mark::LagData lag{.shift_uncertainty_mm = 0.005};
};

std::string shown(const mark::Measured& m, const char* unit) {
    return fmt::format("{:.9g} +- {:.3g}{}{}", m.value, m.uncertainty, *unit != '\0' ? " " : "", unit);
}

int scale(CalibrateOptions& o) {
    o.scale.reading1 = o.readings[0], o.scale.reading2 = o.readings[1];
    const auto out = mark::calibrate_scale(o.scale);
    if (!out) return report(out.error());
    fmt::print("source:  {}\nscale:   {}\n", shown(out->per_mm, "counts/mm"),
               shown(out->scale, "bits a count, for set_fly_x, set_fly_x_pos and the like"));
    return exit_done;
}

int rotary(const CalibrateOptions& o) {
    std::array<mark::RotaryMark, 3> marks;
    for (std::size_t i = 0; i < 3; ++i) marks[i] = {{o.marks[3 * i], o.marks[3 * i + 1]}, o.marks[3 * i + 2]};
    const auto out = mark::calibrate_rotary(marks, o.place_uncertainty_mm, o.count_uncertainty);
    if (!out) return report(out.error());
    fmt::print("centre x:    {}\ncentre y:    {}\nradius:      {}\nresolution:  {}\n", shown(out->centre_x, "mm"),
               shown(out->centre_y, "mm"), shown(out->radius_mm, "mm"),
               shown(out->counts_per_turn, "counts a turn, for set_fly_rot"));
    if (out->unlike > 0.01)
        print_warning(
            fmt::format("the two steps disagree about the counts a turn by {:.1f} %; check the marks and counts again",
                        out->unlike * 100));
    return exit_done;
}

int lag(CalibrateOptions& o) {
    for (std::size_t i = 0; i < 2; ++i) o.lag.velocity_mm_s[i] = o.velocities[i], o.lag.shift_mm[i] = o.shifts[i];
    const auto out = mark::calibrate_lag(o.lag);
    if (!out) return report(out.error());
    fmt::print(
        "lag:             {}\ntracking error:  {}, for set_fly_tracking_error\nfixed shift:     {:.4f} mm at any "
        "velocity\n",
        shown(out->lag_us, "us"), out->tracking_error, out->fixed_shift_mm);
    return exit_done;
}

}  // namespace

void add_calibrate(CLI::App& app, Action& chosen) {
    auto o = std::make_shared<CalibrateOptions>();
    CLI::App* group = app.add_subcommand(
        "calibrate",
        "Scales, centres and lags of marking on the fly, from marks and readings, with their uncertainty (one sigma)");
    group->require_subcommand(1);
    CLI::App* s = group->add_subcommand(
        "scale", "scale from two readings of the encoder or McBSP source and the distance between them");
    s->add_option(
         "--readings", o->readings,
         "readings of get_encoder or read_mcbsp, before and after the movement; from a word of two axes take the "
         "16 bits of one axis with its sign (X low, Y high)")
        ->expected(2)
        ->required();
    s->add_option("--distance", o->scale.distance_mm, "mm between them, with its sign")->required();
    s->add_option("--bits-per-mm", o->scale.bits_per_mm, "K of the field")->capture_default_str();
    s->add_option("--reading-uncertainty", o->scale.reading_uncertainty, "counts")->capture_default_str();
    s->add_option("--distance-uncertainty", o->scale.distance_uncertainty_mm, "mm")->capture_default_str();
    s->footer(
        "Example: motionrack calibrate scale --readings 1000 51000 --distance 50 --bits-per-mm 5184 "
        "--distance-uncertainty 0.05");
    s->callback([o, &chosen] { chosen = [o] { return scale(*o); }; });
    CLI::App* r =
        group->add_subcommand("rotary", "centre and counts a turn from three marks of the same position of the field");
    r->add_option("--marks", o->marks,
                  "x y count, three times: position of each mark on the part (mm) and its encoder count")
        ->expected(9)
        ->required();
    r->add_option("--place-uncertainty", o->place_uncertainty_mm, "mm, of each x and y")->capture_default_str();
    r->add_option("--count-uncertainty", o->count_uncertainty, "counts")->capture_default_str();
    r->footer(
        "Measure the marks with the table back at count 0, in the field's coordinates.\n"
        "Example: motionrack calibrate rotary --marks 30 0 0 26 15 30000 15 26 60000");
    r->callback([o, &chosen] { chosen = [o] { return rotary(*o); }; });
    CLI::App* l = group->add_subcommand("lag", "tracking error from a cross marked at two velocities of the part");
    l->add_option("--velocities", o->velocities, "mm/s, of both")->expected(2)->required();
    l->add_option("--shifts", o->shifts, "mm, displacement of both crosses; positive against the movement")
        ->expected(2)
        ->required();
    l->add_option("--shift-uncertainty", o->lag.shift_uncertainty_mm, "mm")->capture_default_str();
    l->footer("Example: motionrack calibrate lag --velocities 100 500 --shifts 0.015 0.075");
    l->callback([o, &chosen] { chosen = [o] { return lag(*o); }; });
}

}  // namespace motionrack::cli
