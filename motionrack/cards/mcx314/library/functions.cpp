// The source's 57 functions, in the order of its chapter 4.
#include <motionrack/cards/mcx314/library/arguments.hpp>
#include <motionrack/cards/mcx314/library/calls.hpp>

namespace motionrack::mcx314::functions {

namespace source {
namespace {

constexpr std::string_view initial = "4.3 Initial", basic = "4.4 Basic motion", lines = "4.5.1 Lines",
                           arcs = "4.5.2 Arcs", signals = "4.6 Signals", homes = "4.7 Home",
                           positions = "4.8 Positions";

// ---- arguments

constexpr std::array pulse_modes = {ValueInfo{0, "two pulse trains"}, ValueInfo{1, "pulse and direction"}};
constexpr std::array pulse_mode = {axes, one_of("mode", pulse_modes, "pulse output")};
constexpr std::array multiple = {axes, number("data", 1, 500, "", "the multiple M = 8,000,000 / R", 10)};
constexpr std::array range = {of("data", param::R, "", "R of all axes: M = 8,000,000 / R", 800'000)};
constexpr std::array max_speed = {number("data", 1, 4'000'000, "pulses/s", "maximum speed of V", 80'000)};
constexpr std::array jerk = {axes, k_of("data")};
constexpr std::array offset = {axes, of("data", param::AO, pulse_unit, "reserved for the end at SV", 0)};
constexpr std::array way = {axes, of("data", param::pulses, pulse_unit, "the sign is the direction", 1000)};
constexpr std::array dec_point = {axes, of("DecPulse", param::DP, pulse_unit, "of the drive, then it decelerates", 0)};

constexpr std::array t_fixed = {axes, sv_of("m_SV"), v_of("m_V"), a_of("m_A"), fixed_pulses};
constexpr std::array t_endless = {axes, sv_of("m_SV"), v_of("m_V"), a_of("m_A")};
constexpr std::array s_fixed = {axes, sv_of("m_SV"), v_of("m_V"), a_of("m_A"), k_of("m_K"), fixed_pulses};
constexpr std::array s_endless = {axes, sv_of("m_SV"), v_of("m_V"), a_of("m_A"), k_of("m_K")};

constexpr ArgumentInfo px = finish_of("PX", finish_text, 1000), py = finish_of("PY", finish_text, 1000),
                       pz = finish_of("PZ", finish_text, 0), pu = finish_of("PU", finish_text, 0);
constexpr std::array line2_c = {v_of("V"), px, py, pz, pu, two};
constexpr std::array line3_c = {v_of("V"), px, py, pz, pu, three};
constexpr std::array line2_t = {sv_of("SV"), v_of("V"), a_of("A"), d_or_a, px, py, pz, pu, two};
constexpr std::array line3_t = {sv_of("SV"), v_of("V"), a_of("A"), d_or_a, px, py, pz, pu, three};
constexpr std::array line2_s = {sv_of("SV"), v_of("V"), a_of("A"), d_or_a, k_of("K"), px, py, pz, pu, two};
constexpr std::array line3_s = {sv_of("SV"), v_of("V"), a_of("A"), d_or_a, k_of("K"), px, py, pz, pu, three};

constexpr ArgumentInfo ax = finish_of("PX", arc_finish_text, 0), ay = finish_of("PY", arc_finish_text, 0),
                       az = finish_of("PZ", arc_finish_text, 0), au = finish_of("PU", arc_finish_text, 0),
                       cx = finish_of("CX", centre_text, 1000), cy = finish_of("CY", centre_text, 0),
                       cz = finish_of("CZ", centre_text, 0), cu = finish_of("CU", centre_text, 0);
constexpr std::array arc2_c = {v_of("V"), ax, ay, az, au, cx, cy, cz, cu, two};
constexpr std::array arc2_t = {sv_of("SV"), v_of("V"), a_of("A"), d_or_a, ax, ay, az, au, cx, cy, cz, cu, two};
constexpr std::array centre = {axes, of("data", param::C, pulse_unit, "centre of arcs, from the start", 1000)};
constexpr std::array finish = {axes, finish_of("data", "finish point of lines and arcs, from the start", 1000)};

constexpr std::array at_once_or_ramp = {ValueInfo{0, "at once"}, ValueInfo{1, "decelerating"}};
constexpr std::array counters = {ValueInfo{0, "the logical position LP"}, ValueInfo{1, "the real position EP"}};
constexpr std::array encoders = {ValueInfo{0, "quadrature A/B"}, ValueInfo{1, "up and down pulses"}};
constexpr std::array divisions = {ValueInfo{0, "all"}, ValueInfo{1, "every second"}, ValueInfo{2, "every fourth"}};
constexpr std::array active_level = {one_of("n", low_high, "the input acts at"), axes};
constexpr std::array limit_stop = {one_of("n", at_once_or_ramp, "a limit switch stops"), axes};
constexpr std::array switch_all = {one_of("n", off_on, "of all axes")};
constexpr std::array compared = {one_of("n", counters, "counter that COMP+ and COMP- are compared with, on all axes")};
constexpr std::array encoder = {one_of("n", encoders, "encoder inputs"), axes};
constexpr std::array division = {one_of("n", divisions, "counted edges of A/B"), axes};

constexpr std::array wr1_bits = {ValueInfo{0x01, "IN0 at High"},     ValueInfo{0x02, "IN0 stops"},
                                 ValueInfo{0x04, "IN1 at High"},     ValueInfo{0x08, "IN1 stops"},
                                 ValueInfo{0x10, "IN2 (Z) at High"}, ValueInfo{0x20, "IN2 stops"},
                                 ValueInfo{0x40, "IN3 at High"},     ValueInfo{0x80, "IN3 stops"}};
constexpr std::array home_data = {
    ArgumentInfo{"WR1Reg",
                 1,
                 255,
                 {},
                 "WR1: the home switch enabled, at its level; IN2's level for Z, or IN3's if IN2 alone is enabled",
                 2,
                 wr1_bits,
                 true},
    sv_of("SV"), v_of("V"), a_of("A")};

constexpr std::array read_axis = {one_axis};
constexpr std::array logical = {axes, of("data", param::LP, pulse_unit, "new logical position", 0)};
constexpr std::array real = {axes, of("data", param::EP, "counts", "new real position", 0)};
constexpr std::array compare = {axes, of("data", param::COMP_PLUS, pulse_unit, "position of the software limit", 0)};

// ---- functions with individual rows

Result<CallAnswer> set_pulse_mode(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.SetPulseMode(axes_of(v[0]), static_cast<int>(v[1])));
    return written();
}
Result<CallAnswer> set_d(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.SetD(axes_of(v[0]), v[1]));
    MOTIONRACK_CHECK(chip.driver.SetAsymmetric(axes_of(v[0]), true));
    return written();
}
Result<CallAnswer> set_ao(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.SetAO(axes_of(v[0]), v[1]));
    return written();
}
Result<CallAnswer> auto_dec(LibraryChip& chip, Values) {
    MOTIONRACK_CHECK(chip.driver.AutoDec());
    return written();
}
Result<CallAnswer> t_curve_f(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.TCurve_F(axes_of(v[0]), v[1], v[2], v[3], v[4]));
    return begun(chip, axes_of(v[0]));
}
Result<CallAnswer> t_curve_c(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.TCurve_C(axes_of(v[0]), v[1], v[2], v[3]));
    return begun(chip, axes_of(v[0]));
}
Result<CallAnswer> s_curve_f(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.SCurve_F(axes_of(v[0]), v[1], v[2], v[3], v[4], v[5]));
    return begun(chip, axes_of(v[0]));
}
Result<CallAnswer> s_curve_c(LibraryChip& chip, Values v) {
    MOTIONRACK_CHECK(chip.driver.SCurve_C(axes_of(v[0]), v[1], v[2], v[3], v[4]));
    return begun(chip, axes_of(v[0]));
}
Result<CallAnswer> reset(LibraryChip& chip, Values) {
    chip.driver.RESET();
    return CallAnswer{{}, "The chip was reset; set the multiple and all parameters again."};
}

using D = Driver;
constexpr Call range_of_all = set_all<&D::SetRange>, speed_of_all = set_all<&D::SetMaxSpeed>;

constexpr std::string_view of_counter = "pulses";

constexpr std::array rows = {
    FunctionRow{{"SetPulseMode", initial, "Pulse output: two pulse trains, or pulse and direction.", pulse_mode},
                set_pulse_mode},
    FunctionRow{{"SetMultiple", initial,
                 "The multiple M: pulses a second = V x M. One of these three comes before the first drive.", multiple},
                set<&D::SetMultiple>},
    FunctionRow{{"SetRange", initial, "R of all axes; R = 800,000 is M = 10.", range}, range_of_all},
    FunctionRow{
        {"SetMaxSpeed", initial, "The smallest multiple with which V reaches this speed, of all axes.", max_speed},
        speed_of_all},

    FunctionRow{{"SetSV", basic, "Initial speed.", speed}, set<&D::SetSV>},
    FunctionRow{{"SetV", basic, "Drive speed; acts also while driving.", speed}, set<&D::SetV>},
    FunctionRow{{"SetA", basic, "Acceleration.", ramp}, set<&D::SetA>},
    FunctionRow{{"SetD", basic, "Sets the deceleration D and selects it instead of A.", ramp}, set_d},
    FunctionRow{{"SetAA", basic, "K, the acceleration's rate.", jerk}, set<&D::SetAA>},
    FunctionRow{{"SetAO", basic, "Pulses reserved for the end at SV.", offset}, set_ao},
    FunctionRow{{"Pulse", basic, "Output pulses of a fixed drive.", way}, set<&D::Pulse>},
    FunctionRow{{"AutoDec", basic, "The chip finds the deceleration of all axes itself."}, auto_dec},
    FunctionRow{{"ManualDec", basic, "Sets the pulses after which fixed drives decelerate.", dec_point},
                set<&D::ManualDec>},
    FunctionRow{{"ManDec", basic, "As ManualDec; the source has both names.", dec_point}, set<&D::ManDec>},
    FunctionRow{{"TCurve_F", basic, "Fixed drive with T-curve.", t_fixed}, t_curve_f},
    FunctionRow{{"TCurve_C", basic, "Continuous drive with T-curve in + direction, until it is stopped.", t_endless},
                t_curve_c},
    FunctionRow{{"SCurve_F", basic, "Fixed drive with S-curve.", s_fixed}, s_curve_f},
    FunctionRow{{"SCurve_C", basic, "Continuous drive with S-curve in + direction, until it is stopped.", s_endless},
                s_curve_c},

    FunctionRow{{"Line2D_C", lines, "Line of two axes at constant speed.", line2_c}, line_c<&D::Line2D_C>},
    FunctionRow{{"Line3D_C", lines, "Line of three axes at constant speed.", line3_c}, line_c<&D::Line3D_C>},
    FunctionRow{{"Line2D_T", lines, "Line of two axes with T-curve.", line2_t}, line_t<&D::Line2D_T>},
    FunctionRow{{"Line3D_T", lines, "Line of three axes with T-curve.", line3_t}, line_t<&D::Line3D_T>},
    FunctionRow{{"Line2D_S", lines, "Line of two axes with S-curve.", line2_s}, line_s<&D::Line2D_S>},
    FunctionRow{{"Line3D_S", lines, "Line of three axes with S-curve.", line3_s}, line_s<&D::Line3D_S>},

    FunctionRow{
        {"CircleCW_C", arcs, "Arc clockwise at constant speed; the first axis points right, the second up.", arc2_c},
        arc_c<&D::CircleCW_C>},
    FunctionRow{{"CircleCCW_C", arcs, "Arc counterclockwise at constant speed.", arc2_c}, arc_c<&D::CircleCCW_C>},
    FunctionRow{{"CircleCW_T", arcs, "Arc clockwise with T-curve.", arc2_t}, arc_t<&D::CircleCW_T>},
    FunctionRow{{"CircleCCW_T", arcs, "Arc counterclockwise with T-curve.", arc2_t}, arc_t<&D::CircleCCW_T>},
    FunctionRow{{"SetCP", arcs, "Centre of arcs whose own centre is 0.", centre}, set<&D::SetCP>},
    FunctionRow{{"SetC", arcs, "As SetCP; the source has both names.", centre}, set<&D::SetC>},
    FunctionRow{{"SetFP", arcs, "Finish point of lines and arcs whose own is 0.", finish}, set<&D::SetFP>},
    FunctionRow{{"SetP", arcs, "As SetFP; the source has both names.", finish}, set<&D::SetP>},

    FunctionRow{{"HLMTP", signals, "Level at which the + limit switch acts.", active_level}, turn<&D::HLMTP>},
    FunctionRow{{"HLMTM", signals, "Level at which the - limit switch acts.", active_level}, turn<&D::HLMTM>},
    FunctionRow{{"HLMTSig", signals, "How limit switches stop.", limit_stop}, turn<&D::HLMTSig>},
    FunctionRow{{"SLMTP", signals, "Software limit at COMP+.", switch_all}, turn_all<&D::SLMTP>},
    FunctionRow{{"SLMTM", signals, "Software limit at COMP-.", switch_all}, turn_all<&D::SLMTM>},
    FunctionRow{{"SLMTSig", signals, "Counter that the software limits are compared with.", compared},
                turn_all<&D::SLMTSig>},
    FunctionRow{{"EncoderMode", signals, "Kind of the encoder inputs.", encoder}, turn<&D::EncoderMode>},
    FunctionRow{{"EncoderCWCCW", signals, "Counted edges of A/B.", division}, turn<&D::EncoderCWCCW>},
    FunctionRow{{"EnableALM", signals, "Alarm inputs.", switch_all}, turn_all<&D::EnableALM>},
    FunctionRow{{"EnableInPos", signals, "In-position inputs.", switch_all}, turn_all<&D::EnableInPos>},
    FunctionRow{{"ALMSig", signals, "Level at which the alarm input acts.", active_level}, turn<&D::ALMSig>},
    FunctionRow{{"InPosSig", signals, "Level at which the in-position input acts.", active_level}, turn<&D::InPosSig>},

    FunctionRow{
        {"HomeType1", homes, "Decelerates at the home switch. The axes are those of home_axes.", home_data, {}, true},
        home<1>},
    FunctionRow{{"HomeType2", homes, "HomeType1, then back at SV and slowly to the switch again.", home_data, {}, true},
                home<2>},
    FunctionRow{{"HomeType3", homes, "HomeType1, then on at SV to the encoder's index Z.", home_data, {}, true},
                home<3>},
    FunctionRow{{"HomeType4", homes, "HomeType3 slowly, then HomeType2.", home_data, {}, true}, home<4>},

    FunctionRow{{"LPS", positions, "Sets the logical position.", logical}, set<&D::LPS>},
    FunctionRow{{"EPS", positions, "Sets the real (encoder) position.", real}, set<&D::EPS>},
    FunctionRow{{"ReadLPS", positions, "The logical position of one axis.", read_axis, of_counter}, read<&D::ReadLPS>},
    FunctionRow{{"ReadEPS", positions, "The real position of one axis.", read_axis, "counts"}, read<&D::ReadEPS>},
    FunctionRow{{"ReadCV", positions, "Present speed of one axis; 0 at standstill.", read_axis, speed_unit},
                read<&D::ReadCV>},
    FunctionRow{{"ReadCA", positions, "Present acceleration of one axis.", read_axis, ramp_unit}, read<&D::ReadCA>},
    FunctionRow{{"SetCompP", positions, "COMP+, the + software limit.", compare}, set<&D::SetCompP>},
    FunctionRow{{"SetCompM", positions, "COMP-, the - software limit.", compare}, set<&D::SetCompM>},
    FunctionRow{{"RESET", positions, "Resets the chip; all registers and the multiple have to be set again."}, reset},
};

static_assert(rows.size() == 57);

}  // namespace
}  // namespace source

std::span<const FunctionRow> function_rows() {
    return source::rows;
}

}  // namespace motionrack::mcx314::functions
