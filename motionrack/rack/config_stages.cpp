// Sections [stage.NAME] of a rack file: their keys, and conflicts between stages, cards and scales.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/grating.hpp>
#include <motionrack/rack/stage.hpp>

namespace motionrack::rack {

namespace {

constexpr std::array<std::string_view, 2> stage_tables = {"scale", "servo"};
constexpr std::array<std::string_view, 3> stage_profiles = {"hold", "scan", "steps"};

constexpr std::array<Field, 12> stage_table = {
    required(field<&RackStage::card>("card", 1, 32, "", "name of the card (type grating_bus) that drives it"),
             "required"),
    field<&RackStage::output>("output", 0, grating_bus::output_count - 1, "", "number of the card's analog output"),
    required(field<&RackStage::input>("input", 0, 127, "", "number of its scale at the decoder"), "required"),
    field<&RackStage::accel_per_volt_m_s2>("accel_per_volt_m_s2", 0.001, 1'000, "m/s2",
                                           "acceleration per volt, without the load"),
    formerly("top_accel_m_s2",
             field<&RackStage::current_limit_accel_m_s2>("current_limit_accel_m_s2", 0.001, 1'000, "m/s2",
                                                         "acceleration at the current limit, without the load")),
    formerly("top_speed_m_s", field<&RackStage::saturation_velocity_m_s>("saturation_velocity_m_s", 0.001, 10, "m/s",
                                                                         "velocity at which the amplifier saturates")),
    formerly("viscous_per_s", field<&RackStage::viscous_friction_per_s>("viscous_friction_per_s", 0, 100, "1/s",
                                                                        "viscous friction, m/s2 per m/s")),
    formerly("coulomb_m_s2",
             field<&RackStage::coulomb_friction_m_s2>("coulomb_friction_m_s2", 0, 1'000, "m/s2", "Coulomb friction")),
    formerly("load", field<&RackStage::load_mass_ratio>("load_mass_ratio", 0, 1'000, "",
                                                        "mass on the stage in units of its own")),
    absent_means(field<&RackStage::start_mm>("start_mm", -1e4, 1e4, "mm", "initial position"),
                 "start of its servo's profile"),
    formerly("end_minus_mm",
             field<&RackStage::hard_stop_minus_mm>("hard_stop_minus_mm", -1e4, 1e4, "mm", "end of travel")),
    formerly("end_plus_mm",
             field<&RackStage::hard_stop_plus_mm>("hard_stop_plus_mm", -1e4, 1e4, "mm", "end of travel")),
};

constexpr std::array<Field, 7> scale_table = {
    field<&RackScale::pitch_um>("pitch_um", 0.001, 1'000, "um", "period of the grating, whole picometres"),
    field<&RackScale::interpolation>("interpolation", 4, 65'536, "", "counts of a pitch, a multiple of 4"),
    field<&RackScale::reversed>("reversed", 0, 1, "", "it counts down while the stage moves up"),
    formerly("zero_mm", field<&RackScale::zero_offset_mm>("zero_offset_mm", -1e4, 1e4, "mm", "position of count 0")),
    formerly("fastest_mhz", field<&RackScale::max_count_rate_mhz>("max_count_rate_mhz", 0.001, 1'000, "MHz",
                                                                  "million counts a second; faster counts are lost")),
    absent_means(field<&RackScale::index_mm>("index_mm", -1e4, 1e4, "mm", "position of the reference mark"),
                 "no such mark"),
    formerly("dirt_at_mm", field<&RackScale::dirt_position_mm>("dirt_position_mm", -1e4, 1e4, "mm",
                                                               "start of the dirty part of the fault scale.dirt")),
};

constexpr std::array<Field, 16> stage_servo_table = {
    field<&RackStageServo::bandwidth_hz>("bandwidth_hz", 1, 10'000, "Hz",
                                         "frequency at which the open loop has gain 1"),
    absent_means(formerly("p_v_um", field<&RackStageServo::kp_v_um>("kp_v_um", 0, 1e6, "V/um", "proportional gain")),
                 "by the bandwidth"),
    absent_means(
        formerly("i_v_um_s", field<&RackStageServo::ki_v_um_s>("ki_v_um_s", 0, 1e9, "V/(um s)", "integral gain")),
        "by the bandwidth"),
    absent_means(
        formerly("d_v_s_um", field<&RackStageServo::kd_v_s_um>("kd_v_s_um", 0, 1e6, "V s/um", "differential gain")),
        "by the bandwidth"),
    formerly("limit_um",
             field<&RackStageServo::max_following_error_um>("max_following_error_um", 0, 1e6, "um",
                                                            "following error above which the loop opens; 0: none")),
    formerly("compute_us",
             field<&RackStageServo::control_delay_us>("control_delay_us", 0, 100'000, "us",
                                                      "delay from the frame to the voltage, less than a period")),
    with_choices(field<&RackStageServo::profile>("profile", 0, 0, "", "where it goes"), stage_profiles),
    field<&RackStageServo::from_mm>("from_mm", -1e4, 1e4, "mm", "scan: start of the constant velocity"),
    field<&RackStageServo::to_mm>("to_mm", -1e4, 1e4, "mm", "end of the constant velocity; then back"),
    field<&RackStageServo::step_mm>("step_mm", -1e4, 1e4, "mm", "steps: length of a step"),
    field<&RackStageServo::steps>("steps", 1, 1'000'000, "", "number of steps up, then the same number down"),
    formerly("every_ms",
             field<&RackStageServo::step_period_ms>("step_period_ms", 0.1, 1e6, "ms", "steps: time between two steps")),
    formerly("speed_mm_s",
             field<&RackStageServo::max_velocity_mm_s>("max_velocity_mm_s", 0.001, 10'000, "mm/s", "maximum velocity")),
    formerly("accel_mm_s2",
             field<&RackStageServo::max_accel_mm_s2>("max_accel_mm_s2", 0.001, 1e6, "mm/s2", "maximum acceleration")),
    formerly("jerk_mm_s3",
             field<&RackStageServo::max_jerk_mm_s3>("max_jerk_mm_s3", 0.001, 1e12, "mm/s3", "maximum jerk")),
    field<&RackStageServo::delay_ms>("delay_ms", 0, 1e9, "ms", "start time of the profile"),
};

class StageReader {
  public:
    StageReader(RackConfig& config, Problems& problems) : config_(config), problems_(problems) {}

    void read(const TomlNode& node) {
        if (!is_name(node.key) || node.key == "estop" || config_.card(node.key) != nullptr || node.key.size() == 1) {
            problems_.error(
                node.key_location,
                fmt::format("{} cannot be a stage's name: 2 to 32 letters, digits and '_', not beginning with a digit, "
                            "not the name of a card, not estop.",
                            in_quotes(node.key)));
            return;
        }
        if (!is_table(node, "stage." + node.key)) return;
        RackStage stage;
        stage.name = node.key;
        const std::string name = "stage " + node.key;
        bool sound = read_fields(node, stage_fields(), &stage, {name, "", "", stage_tables}, problems_).empty();
        if (const TomlNode* scale = node.find("scale"))
            sound = read_sub(*scale, name, scale_fields(), &stage.scale) && sound;
        if (const TomlNode* servo = node.find("servo"))
            sound = read_sub(*servo, name, stage_servo_fields(), &stage.servo.emplace()) && sound;
        if (!sound) return;
        check(stage, node);
        config_.stages.push_back(std::move(stage));
    }

  private:
    bool is_table(const TomlNode& node, const std::string& path) {
        if (node.type == TomlType::table) return true;
        problems_.error(
            node.value_location,
            fmt::format("{} is {}, but must be a table; write [{}] on a line of its own and its keys below.", path,
                        type_name(node.type), path));
        return false;
    }
    bool read_sub(const TomlNode& node, const std::string& stage, std::span<const Field> fields, void* object) {
        return is_table(node, stage + "." + node.key) &&
               read_fields(node, fields, object, {node.key + " of " + stage, "", "", {}}, problems_).empty();
    }
    void refuse(const TomlNode& node, std::string_view key, std::string text) {
        problems_.error(node.location_of(key), fmt::format("Stage {}: {}", node.key, text));
    }

    void check(const RackStage& stage, const TomlNode& node) {
        const RackCard* card = config_.card(stage.card);
        if (card == nullptr) return refuse(node, "card", fmt::format("unknown card {}.", in_quotes(stage.card)));
        if (card->type != "grating_bus")
            return refuse(
                node, "card",
                fmt::format("card {} is of type {}; one of type grating_bus drives a stage.", stage.card, card->type));
        for (const RackStage& other : config_.stages) {
            if (other.card == stage.card && other.output == stage.output)
                refuse(
                    node, "output",
                    fmt::format("output {} of card {} drives stage {} already.", stage.output, stage.card, other.name));
            if (other.input == stage.input)
                refuse(node, "input",
                       fmt::format("scale {} of the decoder is that of stage {} already.", stage.input, other.name));
        }
        const std::vector<int> wanted = wanted_scales(card->grating_bus);
        if (wanted.empty()) return;  // its list is invalid, which is reported for the card
        std::int64_t scales = 0;
        for (const RackCard& other : config_.cards)
            if (other.type == "grating_bus")
                for (const int address : wanted_scales(other.grating_bus))
                    scales = std::max(scales, std::int64_t{1} + address);
        for (const RackCard& other : config_.cards)
            if (other.type == "grating_decoder") scales = other.grating_decoder.scales;
        if (stage.input >= scales)
            refuse(node, "input",
                   fmt::format("its scale is number {}, but the decoder has {} (0 to {}).", stage.input, scales,
                               scales - 1));
        if (stage.servo && std::find(wanted.begin(), wanted.end(), stage.input) == wanted.end())
            refuse(node, "input",
                   fmt::format("card {} cannot close its loop: it reads the scales {}, and its scale is number {}.",
                               stage.card, fmt::join(wanted, ", "), stage.input));
        check_scale(stage, node);
        if (check_servo(stage, node)) check_place(stage, node);
    }
    void check_scale(const RackStage& stage, const TomlNode& node) {
        const TomlNode* table = node.find("scale");
        if (table == nullptr) return;
        const double pm = stage.scale.pitch_um * 1e6;
        if (std::fabs(pm - std::floor(pm + 0.5)) > 1e-6)
            refuse(*table, "pitch_um",
                   fmt::format("a pitch of {} um is not a whole number of picometres.",
                               number_text(stage.scale.pitch_um)));
        if (stage.scale.interpolation % 4 != 0)
            refuse(*table, "interpolation",
                   fmt::format("{} counts of a pitch are no multiple of 4, which A and B cannot represent.",
                               stage.scale.interpolation));
    }
    bool check_servo(const RackStage& stage, const TomlNode& node) {
        if (!stage.servo) return true;
        const TomlNode& table = *node.find("servo");
        if (stage.servo->control_delay_us >= config_.card(stage.card)->grating_bus.period_us)
            refuse(table, "control_delay_us",
                   fmt::format("computing takes {} us, but the frame period is {} us.",
                               number_text(stage.servo->control_delay_us),
                               number_text(config_.card(stage.card)->grating_bus.period_us)));
        const std::string flaw = profile_flaw(stage);
        if (!flaw.empty()) refuse(table, "profile", flaw);
        return flaw.empty();
    }
    void check_place(const RackStage& stage, const TomlNode& node) {
        if (!(stage.hard_stop_minus_mm < stage.hard_stop_plus_mm))
            return refuse(node, "hard_stop_plus_mm",
                          fmt::format("its ends of travel are {} and {} mm; the first must be the smaller.",
                                      number_text(stage.hard_stop_minus_mm), number_text(stage.hard_stop_plus_mm)));
        const double start = motor_settings(stage).start_nm * 1e-6;
        if (start < stage.hard_stop_minus_mm || start > stage.hard_stop_plus_mm)
            refuse(node, "start_mm",
                   fmt::format("it starts at {} mm, beyond its ends of travel at {} and {} mm.", number_text(start),
                               number_text(stage.hard_stop_minus_mm), number_text(stage.hard_stop_plus_mm)));
    }

    RackConfig& config_;
    Problems& problems_;
};

}  // namespace

std::span<const Field> stage_fields() {
    return stage_table;
}
std::span<const Field> scale_fields() {
    return scale_table;
}
std::span<const Field> stage_servo_fields() {
    return stage_servo_table;
}

bool is_name(std::string_view name) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    const auto allowed = [&](char c) { return letter(c) || (c >= '0' && c <= '9'); };
    return !name.empty() && name.size() <= 32 && letter(name[0]) && std::all_of(name.begin(), name.end(), allowed);
}

void read_stages(const TomlNode& stages, RackConfig& config, Problems& problems) {
    StageReader reader(config, problems);
    for (const TomlNode& node : stages.children) reader.read(node);
}

}  // namespace motionrack::rack
