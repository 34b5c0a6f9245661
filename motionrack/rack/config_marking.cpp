// Sections [belt.NAME], [table.NAME] and [scanner.NAME] of a rack file: their keys, and conflicts between them and the
// cards.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/sim/parts/serial_word_source.hpp>

namespace motionrack::rack {

namespace {

constexpr std::array<std::string_view, 3> track_tables = {"profile", "sender", "parts"};
constexpr std::array<std::string_view, 3> scanner_tables = {"lens", "galvo", "laser"};
constexpr std::size_t max_profile_points = 10'000;

constexpr std::array<Field, 10> track_table = {
    absent_means(field<&RackConveyor::card>("card", 1, 32, "", "name of the card (type rtc5) that its lines lead to"),
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

constexpr std::array<Field, 5> scanner_table = {
    required(field<&RackScanner::card>("card", 1, 32, "", "name of the card (type rtc5) that drives it"), "required"),
    absent_means(formerly("part_on", field<&RackScanner::conveyor>("conveyor", 1, 32, "",
                                                                   "name of the belt or table that carries the part")),
                 "none: the part does not move"),
    field<&RackScanner::bits_per_mm>("bits_per_mm", 1, 1e6, "", "of the field, without a lens"),
    field<&RackScanner::tolerance_um>("tolerance_um", 0, 10'000, "um",
                                      "maximum distance of a merged piece from the marked path"),
    formerly("greatest_points",
             field<&RackScanner::max_points>("max_points", 16, 4'000'000, "",
                                             "stored points of marks; further points are only counted")),
};

class MarkingReader {
  public:
    MarkingReader(RackConfig& config, Problems& problems) : config_(config), problems_(problems) {}

    void read_track(const TomlNode& node, bool rotary) {
        node_ = &node;
        what_ = (rotary ? "table " : "belt ") + printable(node.key, 40);
        if (!sound_name() || !is_table(node, (rotary ? "table." : "belt.") + node.key)) return;
        RackConveyor track;
        track.name = node.key;
        track.rotary = rotary;
        unit_ = track.unit();
        kind_ = rotary ? "a table" : "a belt";
        bool sound = read_fields(node, track_fields(), &track, {what_, unit_, kind_, track_tables}, problems_).empty();
        if (const TomlNode* sender = node.find("sender"))
            sound = read_sub(*sender, sender_fields(), &track.sender.emplace()) && sound;
        if (const TomlNode* row = node.find("parts"))
            sound = read_sub(*row, passing_fields(), &track.passing.emplace()) && sound;
        if (const TomlNode* profile = node.find("profile")) sound = read_profile(*profile, track) && sound;
        if (sound) check(track);
        config_.tracks.push_back(std::move(track));
    }

    void read_scanner(const TomlNode& node) {
        node_ = &node;
        what_ = "scanner " + printable(node.key, 40);
        unit_ = kind_ = {};
        if (!sound_name() || !is_table(node, "scanner." + node.key)) return;
        RackScanner scanner;
        scanner.name = node.key;
        bool sound = read_fields(node, scanner_fields(), &scanner, {what_, "", "", scanner_tables}, problems_).empty();
        if (const TomlNode* lens = node.find("lens"))
            sound = read_sub(*lens, lens_keys, &scanner.lens.emplace()) && sound;
        if (const TomlNode* galvo = node.find("galvo")) sound = read_sub(*galvo, galvo_keys, &scanner.galvo) && sound;
        if (const TomlNode* laser = node.find("laser")) sound = read_sub(*laser, laser_keys, &scanner.laser) && sound;
        if (sound) check(scanner);
        config_.scanners.push_back(std::move(scanner));
    }

  private:
    bool sound_name() {
        const std::string& name = node_->key;
        const auto called = [&](const auto& parts) {
            return std::any_of(parts.begin(), parts.end(), [&](const auto& p) { return p.name == name; });
        };
        if (is_name(name) && name != "estop" && name.size() > 1 && !called(config_.cards) && !called(config_.stages) &&
            !called(config_.tracks) && !called(config_.scanners))
            return true;
        problems_.error(
            node_->key_location,
            fmt::format("{} cannot be the name of a belt, table or scanner: 2 to 32 letters, digits and '_', not "
                        "beginning with a digit, not the name of a card or another part, not estop.",
                        in_quotes(name)));
        return false;
    }
    bool is_table(const TomlNode& node, const std::string& path) {
        if (node.type == TomlType::table) return true;
        problems_.error(
            node.value_location,
            fmt::format("{} is {}, but must be a table; write [{}] on a line of its own and its keys below.",
                        printable(path, 60), type_name(node.type), printable(path, 60)));
        return false;
    }
    bool read_sub(const TomlNode& node, std::span<const Field> fields, void* object) {
        return is_table(node, fmt::format("{} of {}", node.key, what_)) &&
               read_fields(node, fields, object, {fmt::format("{} of {}", node.key, what_), unit_, kind_, {}},
                           problems_)
                   .empty();
    }
    void refuse(const TomlNode& table, std::string_view key, std::string text) {
        problems_.error(table.location_of(key), fmt::format("{}: {}", what_, text));
    }

    /// Reads profile = [[0, 50], [0.5, 120]]: seconds and velocities.
    bool read_profile(const TomlNode& profile, RackConveyor& track) {
        const auto number = [](const TomlNode& node) {
            return node.type == TomlType::integer ? static_cast<double>(node.integer) : node.number;
        };
        const auto is_number = [](const TomlNode& node) {
            return node.type == TomlType::number || node.type == TomlType::integer;
        };
        const auto bad = [&](TextPosition location, std::string text) {
            problems_.error(location, fmt::format("{}: {}", what_, text));
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
            track.profile.push_back({number(pair.children[0]), number(pair.children[1])});
        }
        if (node_->find(with_unit("velocity_{u}_s", track.unit())) != nullptr)
            return bad(profile.key_location, "a velocity and a profile are both given; leave one out.");
        return true;
    }

    /// Reports a card that does not exist; returns true if it exists.
    bool check_card(const std::string& name) {
        const RackCard* card = config_.card(name);
        if (card == nullptr) return refuse(*node_, "card", fmt::format("unknown card {}.", in_quotes(name))), false;
        if (card->type == "rtc5" || card->type.empty()) return true;
        return refuse(*node_, "card", fmt::format("card {} is of type {}; one of type rtc5 marks.", name, card->type)),
               false;
    }

    void check(const RackConveyor& track) {
        if (const auto made = parts::Conveyor::make(track.settings()); !made)
            return refuse(*node_, "profile", made.error().message + ".");
        if (track.card && check_card(*track.card)) check_pins(track);
        if (track.sender) check_sender(track);
        if (track.passing && !(track.passing->length < track.passing->part_pitch))
            refuse(*node_->find("parts"), with_unit("length_{u}", unit_),
                   fmt::format("a part is {} {} long, but the next one comes after {}.",
                               number_text(track.passing->length), unit_, number_text(track.passing->part_pitch)));
        double peak_velocity = std::fabs(track.velocity);
        if (!track.profile.empty()) peak_velocity = 0;
        for (const parts::VelocityPoint& point : track.profile)
            peak_velocity = std::max(peak_velocity, std::fabs(point.velocity));
        if (peak_velocity > track.max_velocity())
            refuse(*node_, with_unit("velocity_{u}_s", unit_),
                   fmt::format("it goes at {0} {1}/s, but at more than {2:.6g} {1}/s its encoder would make more than "
                               "{3:.0f} counts a second, or "
                               "more than {4:.0f} parts a second would come.",
                               number_text(peak_velocity), unit_, track.max_velocity(), max_track_counts, max_parts));
    }

    /// Two conveyors at one pin would drive against each other.
    void check_pins(const RackConveyor& track) {
        for (const RackConveyor& other : config_.tracks) {
            if (other.card != track.card) continue;
            if (track.has_encoder() && other.has_encoder() && other.encoder == track.encoder)
                refuse(*node_, "encoder",
                       fmt::format("encoder input {} of card {} has the encoder of {} already.", track.encoder,
                                   *track.card, other.name));
            if (track.sender && other.sender)
                refuse(*node_, "sender",
                       fmt::format("the sender of {} is at card {} already.", other.name, *track.card));
            if (track.passing && other.passing)
                refuse(*node_, "parts", fmt::format("the parts of {} start card {} already.", other.name, *track.card));
        }
    }

    void check_sender(const RackConveyor& track) {
        const parts::SerialPositionSettings& s = *track.sender;
        const TomlNode& table = *node_->find("sender");
        if (s.bits_per_mm == 0)
            return refuse(table, with_unit("bits_per_{u}", unit_), "a sender needs bits other than 0.");
        const double max_delay_us = static_cast<double>(parts::SerialWordSource::max_under_way - 1) * s.period_us;
        if (!(s.delay_us < max_delay_us))
            return refuse(
                table, "delay_us",
                fmt::format("a delay of {} us with a reading every {} us is too long; less than {} us is possible.",
                            number_text(s.delay_us), number_text(s.period_us), number_text(max_delay_us)));
        const parts::Conveyor made = *parts::Conveyor::make(track.settings());
        if (const auto sender = parts::SerialPositionSource::make(made, s); !sender)
            refuse(*node_, "sender", sender.error().message + ".");
    }

    void check(const RackScanner& scanner) {
        if (scanner.conveyor && config_.track(*scanner.conveyor) == nullptr)
            refuse(*node_, "conveyor", fmt::format("unknown belt or table {}.", in_quotes(*scanner.conveyor)));
        check_card(scanner.card);
        for (const RackScanner& other : config_.scanners)
            if (other.card == scanner.card)
                refuse(*node_, "card", fmt::format("card {} drives scanner {} already.", scanner.card, other.name));
        if (scanner.lens && node_->find("bits_per_mm") != nullptr)
            refuse(*node_, "bits_per_mm", "with a lens its bits_per_mm stand in the table lens.");
        if (const auto made = parts::MarkingStation::make(scanner.settings()); !made)
            refuse(*node_, scanner.lens ? "lens" : "galvo", made.error().message + ".");
    }

    RackConfig& config_;
    Problems& problems_;
    const TomlNode* node_ = nullptr;
    std::string what_;  // "belt line"
    std::string unit_, kind_;
};

}  // namespace

std::span<const Field> track_fields() {
    return track_table;
}
std::span<const Field> sender_fields() {
    return sender_table;
}
std::span<const Field> passing_fields() {
    return passing_table;
}
std::span<const Field> scanner_fields() {
    return scanner_table;
}

void read_marking(const TomlNode* belts, const TomlNode* tables, const TomlNode* scanners, RackConfig& config,
                  Problems& problems) {
    MarkingReader reader(config, problems);
    if (belts != nullptr)
        for (const TomlNode& node : belts->children) reader.read_track(node, false);
    if (tables != nullptr)
        for (const TomlNode& node : tables->children) reader.read_track(node, true);
    if (scanners != nullptr)
        for (const TomlNode& node : scanners->children) reader.read_scanner(node);
}

}  // namespace motionrack::rack
