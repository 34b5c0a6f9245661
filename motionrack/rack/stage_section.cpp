// Sections [stage.NAME] of a rack file: their keys, and conflicts between stages, cards and scales.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/part_sections.hpp>
#include <motionrack/rack/stage.hpp>

namespace motionrack::rack {

namespace {

/// Highest number of an output that can drive a stage.
int last_stage_output() {
    int outputs = 1;
    for (const std::string_view name : card_type_names())
        outputs = std::max(outputs, find_card_type(name)->stage_drive.outputs);
    return outputs - 1;
}

/// Returns the stage properties of a card type; nullptr if its cards drive no stage.
const StageDrive* stage_drive_of(std::string_view card_type) {
    const CardType* type = find_card_type(card_type);
    return type != nullptr && drives_stages(*type) ? &type->stage_drive : nullptr;
}

constexpr std::array<std::string_view, 2> stage_tables = {"scale", "servo"};
constexpr std::array<std::string_view, 3> stage_profiles = {"hold", "scan", "steps"};

constexpr std::array<Field, 12> stage_table = {
    required(field<&RackStage::card>("card", 1, 32, "", "name of the card that drives it"), "required"),
    field<&RackStage::output>("output", 0, 0, "", "number of the card's analog output"),
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

std::span<const Field> stage_fields() {
    static const std::string card_doc =
        fmt::format("name of the card (type {}) that drives it", card_types_text(drives_stages));
    static const auto table = [] {
        auto out = with_doc(stage_table, "card", card_doc);
        for (Field& field : out)
            if (field.key == "output") field.max = last_stage_output();
        return out;
    }();
    return table;
}

/// Checks of one stage for conflicts between its keys, its card and its scale.
class StageCheck {
  public:
    StageCheck(const RackStage& stage, const RackConfig& config, PartReader& reader)
        : stage_(stage), config_(config), reader_(reader) {}

    void run() {
        const RackCard* card = config_.card(stage_.card);
        if (card == nullptr) return reader_.refuse("card", fmt::format("unknown card {}.", in_quotes(stage_.card)));
        const StageDrive* drive = stage_drive_of(card->type);
        if (drive == nullptr)
            return reader_.refuse("card", fmt::format("card {} is of type {}; one of type {} drives a stage.",
                                                      stage_.card, card->type, card_types_text(drives_stages)));
        for (const RackStage& other : config_.stages) {
            if (other.card == stage_.card && other.output == stage_.output)
                reader_.refuse("output", fmt::format("output {} of card {} drives stage {} already.", stage_.output,
                                                     stage_.card, other.name));
            if (other.input == stage_.input)
                reader_.refuse("input", fmt::format("scale {} of the decoder is that of stage {} already.",
                                                    stage_.input, other.name));
        }
        const std::vector<int> wanted = drive->scales(*card);
        if (wanted.empty()) return;  // its list is invalid, which is reported for the card
        std::int64_t scales = 0;
        for (const RackCard& other : config_.cards)
            if (const StageDrive* its = stage_drive_of(other.type))
                for (const int address : its->scales(other)) scales = std::max(scales, std::int64_t{1} + address);
        for (const RackCard& other : config_.cards)
            if (const CardType* type = find_card_type(other.type); type != nullptr && type->decoded_scales != nullptr)
                scales = type->decoded_scales(other);
        if (stage_.input >= scales)
            reader_.refuse("input", fmt::format("its scale is number {}, but the decoder has {} (0 to {}).",
                                                stage_.input, scales, scales - 1));
        if (stage_.servo && std::find(wanted.begin(), wanted.end(), stage_.input) == wanted.end())
            reader_.refuse(
                "input",
                fmt::format("card {} cannot close its loop: it reads the scales {}, and its scale is number {}.",
                            stage_.card, fmt::join(wanted, ", "), stage_.input));
        check_scale();
        if (check_servo(drive->period_us(*card))) check_place();
    }

  private:
    void check_scale() {
        const TomlNode* table = reader_.node().find("scale");
        if (table == nullptr) return;
        const double pm = stage_.scale.pitch_um * 1e6;
        if (std::fabs(pm - std::floor(pm + 0.5)) > 1e-6)
            reader_.refuse(*table, "pitch_um",
                           fmt::format("a pitch of {} um is not a whole number of picometres.",
                                       number_text(stage_.scale.pitch_um)));
        if (stage_.scale.interpolation % 4 != 0)
            reader_.refuse(*table, "interpolation",
                           fmt::format("{} counts of a pitch are no multiple of 4, which A and B cannot represent.",
                                       stage_.scale.interpolation));
    }
    bool check_servo(double period_us) {
        if (!stage_.servo) return true;
        const TomlNode& table = *reader_.node().find("servo");
        if (stage_.servo->control_delay_us >= period_us)
            reader_.refuse(table, "control_delay_us",
                           fmt::format("computing takes {} us, but the frame period is {} us.",
                                       number_text(stage_.servo->control_delay_us), number_text(period_us)));
        const std::string flaw = profile_flaw(stage_);
        if (!flaw.empty()) reader_.refuse(table, "profile", flaw);
        return flaw.empty();
    }
    void check_place() {
        if (!(stage_.hard_stop_minus_mm < stage_.hard_stop_plus_mm))
            return reader_.refuse(
                "hard_stop_plus_mm",
                fmt::format("its ends of travel are {} and {} mm; the first must be the smaller.",
                            number_text(stage_.hard_stop_minus_mm), number_text(stage_.hard_stop_plus_mm)));
        const double start = motor_settings(stage_).start_nm * 1e-6;
        if (start < stage_.hard_stop_minus_mm || start > stage_.hard_stop_plus_mm)
            reader_.refuse("start_mm",
                           fmt::format("it starts at {} mm, outside of its travel, {} to {} mm.", number_text(start),
                                       number_text(stage_.hard_stop_minus_mm), number_text(stage_.hard_stop_plus_mm)));
    }

    const RackStage& stage_;
    const RackConfig& config_;
    PartReader& reader_;
};

void read_stage(const TomlNode& node, RackConfig& config, Problems& problems) {
    if (!is_free_name(config, node.key)) {
        problems.error(
            node.key_location,
            fmt::format("{} cannot be a stage's name: 2 to 32 letters, digits and '_', not beginning with a digit, "
                        "not the name of a card, not estop.",
                        in_quotes(node.key)));
        return;
    }
    if (!is_table(node, "stage." + node.key, problems)) return;
    RackStage stage;
    stage.name = node.key;
    const std::string name = "stage " + node.key;
    PartReader reader(node, {name, "", "", {}}, "Stage " + node.key, problems);
    const auto read_own = [&](const TomlNode& table, std::span<const Field> fields, void* object) {
        return is_table(table, name + "." + table.key, problems) && reader.read_table(table, fields, object);
    };
    bool sound = reader.read(stage_fields(), &stage, stage_tables);
    if (const TomlNode* scale = node.find("scale")) sound = read_own(*scale, scale_table, &stage.scale) && sound;
    if (const TomlNode* servo = node.find("servo"))
        sound = read_own(*servo, stage_servo_table, &stage.servo.emplace()) && sound;
    if (!sound) return;
    StageCheck(stage, config, reader).run();
    config.stages.push_back(std::move(stage));
}

void read_stages(const TomlNode& stages, RackConfig& config, Problems& problems) {
    for (const TomlNode& node : stages.children) read_stage(node, config, problems);
}

constexpr std::array<std::string_view, 1> stage_keys = {"stage"};
constexpr std::array<PartSection, 3> stage_section_rows = {{
    {"[stage.NAME]",
     "A stage on a linear motor with a grating scale, driven by an analog output of a card of a grating bus.",
     stage_fields, default_object<RackStage>},
    {"[stage.NAME.scale]", {}, rows_of<scale_table>, default_object<RackScale>},
    {"[stage.NAME.servo]",
     "With the section, even an empty one, the card's processor closes a loop through the bus' frames and follows the "
     "profile.",
     rows_of<stage_servo_table>, default_object<RackStageServo>},
}};

}  // namespace

constinit const PartSections stage_sections = {stage_keys, stage_section_rows, names_in<&RackConfig::stages>,
                                               read_stages};

}  // namespace motionrack::rack
