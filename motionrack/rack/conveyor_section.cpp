// Sections [belt.NAME] and [table.NAME] of a rack file: their keys, and conflicts between them and the cards.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/part_sections.hpp>
#include <motionrack/sim/parts/serial_word_source.hpp>

namespace motionrack::rack {

namespace {

constexpr std::array<std::string_view, 3> track_tables = {"profile", "sender", "parts"};
constexpr std::size_t max_profile_points = 10'000;

constexpr std::array<Field, 10> track_table = {
    absent_means(field<&RackConveyor::card>("card", 1, 32, "", "name of the card that its lines lead to"),
                 "where [wires] says"),
    field<&RackConveyor::encoder>("encoder", 0, 1, "", "encoder input of the card for its encoder"),
    formerly("speed_{u}_s", field<&RackConveyor::velocity>("velocity_{u}_s", -parts::max_track_velocity,
                                                           parts::max_track_velocity, "{u}/s", "how fast it goes")),
    field<&RackConveyor::deceleration>("deceleration_{u}_s2", 1, 1e7, "{u}/s2", "deceleration at a stop"),
    only_in(field<&RackConveyor::direction_deg>("direction_deg", -3'600, 3'600, "deg",
                                                "direction of its motion, from +X counter-clockwise"),
            "mm"),
    only_in(field<&RackConveyor::centre_x_mm>("centre_x_mm", -1e5, 1e5, "mm", "what it turns about, counter-clockwise"),
            "deg"),
    only_in(field<&RackConveyor::centre_y_mm>("centre_y_mm", -1e5, 1e5, "mm", "what it turns about"), "deg"),
    field<&RackConveyor::counts_per_unit>(
        "counts_per_{u}", -1e6, 1e6, "",
        "counts of its encoder, four a line; negative counts the other way; 0: no encoder"),
    field<&RackConveyor::slip>("slip", -0.5, 0.5, "", "slip of the encoder's wheel, share of the travel"),
    field<&RackConveyor::jitter_us>("jitter_us", 0, 1'000, "us",
                                    "maximum random delay of an edge of the encoder; the same in every run"),
};

constexpr std::array<Field, 4> sender_table = {
    field<&parts::SerialPositionSettings::bits_per_mm>("bits_per_{u}", -1e9, 1e9, "", "resolution"),
    field<&parts::SerialPositionSettings::period_us>("period_us", 1, 1e6, "us", "between readings"),
    field<&parts::SerialPositionSettings::delay_us>("delay_us", 0, 1e6, "us",
                                                    "delay from a reading to its complete word; less than 255 periods"),
    only_in(
        field<&parts::SerialPositionSettings::two_axes>("two_axes", 0, 0, "", "X in the low and Y in the high 16 bits"),
        "mm"),
};

constexpr std::array<Field, 3> passing_table = {
    formerly("every_{u}", field<&RackParts::part_pitch>("part_pitch_{u}", 0.001, 1e6, "{u}", "from part to part")),
    formerly("first_{u}", field<&RackParts::first_part>("first_part_{u}", -1e6, 1e6, "{u}",
                                                        "travel at which the first part reaches the sensor")),
    field<&RackParts::length>("length_{u}", 0.0001, 1e6, "{u}",
                              "length of a part, less than the pitch; the sensor is low along it"),
};

std::span<const Field> track_fields() {
    static const std::string card_doc =
        fmt::format("name of the card (type {}) that its lines lead to", card_types_text(drives_scan_heads));
    static const auto table = with_doc(track_table, "card", card_doc);
    return table;
}

class ConveyorReader {
  public:
    /// `track`: a belt or table with its name.
    ConveyorReader(RackConveyor& track, const RackConfig& config, PartReader& reader)
        : track_(track), config_(config), reader_(reader) {}

    void read() {
        const TomlNode& node = reader_.node();
        bool sound = reader_.read(track_fields(), &track_, track_tables);
        if (const TomlNode* sender = node.find("sender"))
            sound = reader_.read_table(*sender, sender_table, &track_.sender.emplace()) && sound;
        if (const TomlNode* row = node.find("parts"))
            sound = reader_.read_table(*row, passing_table, &track_.passing.emplace()) && sound;
        if (const TomlNode* profile = node.find("profile")) sound = read_profile(*profile) && sound;
        if (sound) check();
    }

  private:
    /// Reads profile = [[0, 50], [0.5, 120]]: seconds and velocities.
    bool read_profile(const TomlNode& profile) {
        const auto number_in = [](const TomlNode& node) {
            return node.type == TomlType::integer ? static_cast<double>(node.integer) : node.number;
        };
        const auto is_number = [](const TomlNode& node) {
            return node.type == TomlType::number || node.type == TomlType::integer;
        };
        const auto bad = [&](TextPosition location, const std::string& text) {
            reader_.refuse_at(location, text);
            return false;
        };
        if (profile.type != TomlType::array || profile.children.empty() || profile.children.size() > max_profile_points)
            return bad(
                profile.value_location,
                fmt::format("profile must be an array of 1 to {} pairs [seconds, velocity].", max_profile_points));
        for (const TomlNode& pair : profile.children) {
            if (pair.type != TomlType::array || pair.children.size() != 2 || !is_number(pair.children[0]) ||
                !is_number(pair.children[1]))
                return bad(pair.value_location, "a point of its profile must be a pair [seconds, velocity].");
            track_.profile.push_back({number_in(pair.children[0]), number_in(pair.children[1])});
        }
        if (reader_.node().find(with_unit("velocity_{u}_s", track_.unit())) != nullptr)
            return bad(profile.key_location, "a velocity and a profile are both given; leave one out.");
        return true;
    }

    void check() {
        if (const auto made = parts::Conveyor::make(track_.settings()); !made)
            return reader_.refuse("profile", made.error().message + ".");
        if (track_.card && is_marking_card(*track_.card, config_, reader_)) check_pins();
        if (track_.sender) check_sender();
        if (track_.passing && !(track_.passing->length < track_.passing->part_pitch))
            reader_.refuse(*reader_.node().find("parts"), with_unit("length_{u}", track_.unit()),
                           fmt::format("a part is {} {} long, but the next one comes after {}.",
                                       number_text(track_.passing->length), track_.unit(),
                                       number_text(track_.passing->part_pitch)));
        double peak_velocity = std::fabs(track_.velocity);
        if (!track_.profile.empty()) peak_velocity = 0;
        for (const parts::VelocityPoint& point : track_.profile)
            peak_velocity = std::max(peak_velocity, std::fabs(point.velocity));
        if (peak_velocity > track_.max_velocity())
            reader_.refuse(
                with_unit("velocity_{u}_s", track_.unit()),
                fmt::format("its velocity is {0} {1}/s, but above {2:.6g} {1}/s its encoder would make more than "
                            "{3:.0f} counts a second, or "
                            "more than {4:.0f} parts a second would come.",
                            number_text(peak_velocity), track_.unit(), track_.max_velocity(), max_track_counts,
                            max_parts));
    }

    /// Refuses two conveyors at one pin of a card.
    void check_pins() {
        for (const RackConveyor& other : config_.tracks) {
            if (other.card != track_.card) continue;
            if (track_.has_encoder() && other.has_encoder() && other.encoder == track_.encoder)
                reader_.refuse("encoder", fmt::format("encoder input {} of card {} has the encoder of {} already.",
                                                      track_.encoder, *track_.card, other.name));
            if (track_.sender && other.sender)
                reader_.refuse("sender",
                               fmt::format("the sender of {} is at card {} already.", other.name, *track_.card));
            if (track_.passing && other.passing)
                reader_.refuse("parts",
                               fmt::format("the parts of {} start card {} already.", other.name, *track_.card));
        }
    }

    void check_sender() {
        const parts::SerialPositionSettings& s = *track_.sender;
        const TomlNode& table = *reader_.node().find("sender");
        if (s.bits_per_mm == 0)
            return reader_.refuse(table, with_unit("bits_per_{u}", track_.unit()), "a sender needs bits other than 0.");
        const double max_delay_us = static_cast<double>(parts::SerialWordSource::max_under_way - 1) * s.period_us;
        if (!(s.delay_us < max_delay_us))
            return reader_.refuse(
                table, "delay_us",
                fmt::format("the delay is {} us with a reading every {} us; it must be less than {} us.",
                            number_text(s.delay_us), number_text(s.period_us), number_text(max_delay_us)));
        const parts::Conveyor made = *parts::Conveyor::make(track_.settings());
        if (const auto sender = parts::SerialPositionSource::make(made, s); !sender)
            reader_.refuse("sender", sender.error().message + ".");
    }

    RackConveyor& track_;
    const RackConfig& config_;
    PartReader& reader_;
};

void read_conveyor(const TomlNode& node, bool rotary, RackConfig& config, Problems& problems) {
    const std::string_view kind = rotary ? "table" : "belt";
    if (!is_marking_name(node, config, problems)) return;
    if (!is_table(node, fmt::format("{}.{}", kind, node.key), problems)) return;
    RackConveyor track;
    track.name = node.key;
    track.rotary = rotary;
    const std::string name = fmt::format("{} {}", kind, node.key);
    PartReader reader(node, {name, std::string(track.unit()), fmt::format("a {}", kind), {}}, name, problems);
    ConveyorReader(track, config, reader).read();
    config.tracks.push_back(std::move(track));
}

/// `table`: [belt] or [table].
void read_conveyors(const TomlNode& table, RackConfig& config, Problems& problems) {
    for (const TomlNode& node : table.children) read_conveyor(node, table.key == "table", config, problems);
}

const void* conveyor_defaults(bool rotary) {
    static const RackConveyor belt;
    static const RackConveyor turning = [] {
        RackConveyor out;
        out.rotary = true;
        return out;
    }();
    return rotary ? &turning : &belt;
}

constexpr std::array<std::string_view, 2> conveyor_keys = {"belt", "table"};
constexpr std::array<PartSection, 3> conveyor_section_rows = {{
    {"[belt.NAME], [table.NAME]",
     "The conveyor under a scan head: a belt (mm) or a rotary table (degrees). In place of its velocity "
     "`profile = [[0, 50], [0.5, 120]]`: seconds and velocities, linear between, constant before and after. "
     "`motionrack run` and `mr_part_set` change the velocity: fault `drive.speed`.",
     track_fields, conveyor_defaults},
    {"[belt.NAME.sender]",
     "With the section, even an empty one, a position sender samples the position and gives the card's serial input "
     "words. In [table.NAME.sender] the same.",
     rows_of<sender_table>, default_object<parts::SerialPositionSettings>},
    {"[belt.NAME.parts]",
     "With the section, even an empty one, parts pass a light barrier, which starts the card. In [table.NAME.parts] "
     "the same.",
     rows_of<passing_table>, default_object<RackParts>},
}};

}  // namespace

bool is_marking_name(const TomlNode& node, const RackConfig& config, Problems& problems) {
    if (is_free_name(config, node.key)) return true;
    problems.error(
        node.key_location,
        fmt::format("{} cannot be the name of a belt, table or scanner: 2 to 32 letters, digits and '_', not "
                    "beginning with a digit, not the name of a card or another part, not estop.",
                    in_quotes(node.key)));
    return false;
}

bool is_marking_card(const std::string& name, const RackConfig& config, PartReader& reader) {
    const RackCard* card = config.card(name);
    if (card == nullptr) return reader.refuse("card", fmt::format("unknown card {}.", in_quotes(name))), false;
    const CardType* type = find_card_type(card->type);
    if (card->type.empty() || (type != nullptr && drives_scan_heads(*type))) return true;
    return reader.refuse("card", fmt::format("card {} is of type {}; one of type {} marks.", name, card->type,
                                             card_types_text(drives_scan_heads))),
           false;
}

constinit const PartSections conveyor_sections = {conveyor_keys, conveyor_section_rows, names_in<&RackConfig::tracks>,
                                                  read_conveyors};

}  // namespace motionrack::rack
