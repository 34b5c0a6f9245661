// Reads a rack file, given as a text or a path, section by section. Collects all errors; returns a config only without
// errors.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <motionrack/base/read_whole_file.hpp>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/part_catalogue.hpp>

namespace motionrack::rack {
namespace {

constexpr std::array<std::string_view, 4> axis_tables = {"motor", "servo", "switches", "homing"};

/// Sections at the top level of a file.
std::vector<std::string_view> top_level_keys() {
    std::vector<std::string_view> out = {"rack", "card"};
    for (const PartKind* kind : part_kinds())
        if (kind->sections != nullptr) out.insert(out.end(), kind->sections->keys.begin(), kind->sections->keys.end());
    out.insert(out.end(), {"controller", "safety", "wires"});
    return out;
}

class RackReader {
  public:
    RackReader(const TomlNode& root, Problems& problems) : root_(root), problems_(problems) {}

    RackConfig read() {
        const std::vector<std::string_view> top_level = top_level_keys();
        for (const TomlNode& node : root_.children) {
            if (std::find(top_level.begin(), top_level.end(), node.key) != top_level.end()) continue;
            const std::string hint = problems_.wants_hints() ? did_you_mean(node.key, top_level) : std::string();
            problems_.error(node.key_location,
                            fmt::format("A rack file has no section {}{}", in_quotes(node.key),
                                        hint.empty() ? fmt::format(": it has {}.", fmt::join(top_level, ", ")) : hint));
        }
        if (const TomlNode* node = table("rack"))
            read_fields(*node, rack_fields(), &config_, {"rack", "", "", {}}, problems_);
        if (const TomlNode* node = table("controller")) {
            read_fields(*node, controller_fields(), &config_.controller, {"controller", "", "", {}}, problems_);
        }
        if (const TomlNode* node = table("safety"))
            read_fields(*node, safety_fields(), &config_.safety, {"safety", "", "", {}}, problems_);
        read_cards();
        read_axes();
        check_axes(config_, sources_, problems_);
        for (const PartKind* kind : part_kinds()) {
            if (kind->sections == nullptr || kind->sections->read == nullptr) continue;
            for (const std::string_view key : kind->sections->keys)
                if (const TomlNode* node = table(key)) kind->sections->read(*node, config_, problems_);
        }
        resolve_wires(config_, table("wires"), problems_);
        return std::move(config_);
    }

  private:
    /// Returns the top-level table of that name; nullptr if it is missing or not a table.
    const TomlNode* table(std::string_view name) {
        const TomlNode* node = root_.find(name);
        return node != nullptr && is_table(*node, std::string(name), problems_) ? node : nullptr;
    }

    // ---- Cards

    void read_cards() {
        const TomlNode* cards = root_.find("card");
        if (cards == nullptr || (cards->type == TomlType::table && cards->children.empty())) {
            problems_.error(cards != nullptr ? cards->key_location : TextPosition{1, 1},
                            fmt::format("The rack has no card; add a section [card.motion] with type = \"{}\".",
                                        card_type_names().front()));
            return;
        }
        if (cards->type != TomlType::table) {
            problems_.error(cards->value_location,
                            fmt::format("card is {}, but each card needs a name: write card.motion = \"{}\" "
                                        "or a section [card.motion].",
                                        type_name(cards->type), card_type_names().front()));
            return;
        }
        if (cards->children.size() > slot_count) {
            problems_.error(
                cards->children[slot_count].key_location,
                fmt::format("The rack has {} cards, but only {} slots.", cards->children.size(), slot_count));
            return;
        }
        for (const TomlNode& node : cards->children) read_card(node);
        give_slots(*cards);
        check_cards(*cards);
    }

    void read_card(const TomlNode& node) {
        RackCard card;
        card.name = node.key;
        check_card_name(node);
        if (node.type == TomlType::text) {
            TomlNode as_table;  // card.c1 = "TYPE" is short for [card.c1] with that type
            as_table.key_location = node.key_location;
            as_table.children.push_back(node);
            as_table.children.back().key = "type";
            read_card_table(as_table, card);
            if (root_.find("card")->children.size() == 1 && root_.find("axis") == nullptr) alone_ = true;
        } else if (is_table(node, "card." + printable(node.key, 40), problems_)) {
            read_card_table(node, card);
        } else {
            card.type.clear();
        }
        config_.cards.push_back(std::move(card));
    }

    /// An unknown type leaves `type` empty, so that its pins are not searched.
    void read_card_table(const TomlNode& node, RackCard& card) {
        const TomlNode* type = node.find("type");
        const CardType* known = type != nullptr ? find_card_type(type->text) : nullptr;
        std::vector<std::string_view> setting_names;
        std::vector<TomlNode> own;
        const Section section{"card " + printable(card.name, 40), "", "", {}};
        if (known == nullptr) {
            card.type.clear();
            // Without a type, only the keys common to all cards can be checked.
            TomlNode common = node;
            std::erase_if(common.children,
                          [](const TomlNode& child) { return child.key != "type" && child.key != "slot"; });
            RackCard scratch;
            read_fields(common, card_fields(), &scratch, section, problems_);
            card.slot = scratch.slot;
            return;
        }
        std::vector<FormerKey> former_names;
        for (const Field& field : known->settings) {
            setting_names.push_back(field.key);
            if (!field.old_key.empty()) former_names.push_back({field.old_key, field.key});
        }
        Section common = section;
        common.also = setting_names;
        common.former = former_names;
        read_fields(node, card_fields(), &card, common, problems_);
        TomlNode settings = node;
        std::erase_if(settings.children, [&](const TomlNode& child) {
            return std::find(setting_names.begin(), setting_names.end(), child.key) == setting_names.end();
        });
        read_fields(settings, known->settings, known->settings_of(card), section, problems_);
    }

    void check_card_name(const TomlNode& node) {
        const std::string& name = node.key;
        if (!is_name(name)) {
            problems_.error(node.key_location,
                            fmt::format("{} cannot be a card's name: 1 to 32 letters, digits and '_', not beginning "
                                        "with a digit.",
                                        in_quotes(name)));
        } else if (name == "estop" || std::find(axis_names.begin(), axis_names.end(), name) != axis_names.end()) {
            problems_.error(node.key_location,
                            fmt::format("A card cannot be called {}: wires use that name for {}; choose another.", name,
                                        name == "estop" ? "the emergency stop" : "an axis"));
        }
    }

    void check_cards(const TomlNode& cards) {
        for (std::size_t i = 0; i < config_.cards.size(); ++i) {
            const CardType* type = find_card_type(config_.cards[i].type);
            if (type == nullptr || type->flaw == nullptr) continue;
            const auto flaw = type->flaw(config_.cards[i], std::span(config_.cards).first(i));
            if (flaw) problems_.error(cards.children[i].location_of(flaw->key), flaw->text);
        }
    }

    void give_slots(const TomlNode& cards) {
        std::array<const RackCard*, slot_count> in_slot = {};
        for (std::size_t i = 0; i < config_.cards.size(); ++i) {
            const RackCard& card = config_.cards[i];
            if (!card.slot) continue;
            const RackCard*& there = in_slot[static_cast<std::size_t>(*card.slot)];
            if (there != nullptr) {
                problems_.error(cards.children[i].location_of("slot"),
                                fmt::format("Slot {} has two cards, {} and {}; give one of them another "
                                            "slot (0 .. {}).",
                                            *card.slot, there->name, card.name, slot_count - 1));
            }
            there = &card;
        }
        for (RackCard& card : config_.cards) {
            if (card.slot) continue;
            const auto free = std::find(in_slot.begin(), in_slot.end(), nullptr);
            if (free == in_slot.end()) return;  // only after an error about two cards in one slot
            card.slot = static_cast<int>(free - in_slot.begin());
            *free = &card;
        }
    }

    // ---- Axes

    void read_axes() {
        if (alone_ && !config_.cards[0].type.empty()) return add_ideal_axes();
        const TomlNode* axes = table("axis");
        if (axes == nullptr) return;
        for (const std::string_view name : axis_names) {
            if (const TomlNode* node = axes->find(name)) {
                if (is_table(*node, "axis." + std::string(name), problems_)) read_axis(*node);
            }
        }
        for (const TomlNode& node : axes->children) {
            if (std::find(axis_names.begin(), axis_names.end(), node.key) != axis_names.end()) continue;
            const bool near =
                node.key.size() == 1 && std::string_view("xyzabc").find(node.key[0]) != std::string_view::npos;
            problems_.error(
                node.key_location,
                fmt::format("Unknown axis {}: the axes are X Y Z (mm) and A B C (degrees){}", in_quotes(node.key),
                            near ? fmt::format("; did you mean '{}'?", static_cast<char>(node.key[0] - 'a' + 'A'))
                                 : std::string(".")));
        }
    }

    void read_axis(const TomlNode& node) {
        RackAxis axis = default_axis(node.key[0]);
        const AxisKind by_letter = axis.kind;
        if (const TomlNode* kind = node.find("kind"); kind != nullptr && kind->type == TomlType::text) {
            // Set before the other keys are read, because their names and defaults depend on it.
            if (kind->text == "linear") axis.kind = AxisKind::linear;
            if (kind->text == "rotary") axis.kind = AxisKind::rotary;
        }
        if (axis.kind != by_letter) {
            problems_.error(node.location_of("kind"),
                            fmt::format("Axis {} cannot be {}: X Y Z are linear (mm), A B C rotary (degrees).",
                                        node.key, by_letter == AxisKind::linear ? "rotary" : "linear"));
        }
        Section section{"axis " + node.key, std::string(axis.unit()),
                        axis.kind == AxisKind::linear ? "a linear axis" : "a rotary axis", axis_tables};
        AxisSource source{&node, {}};
        source.refused = read_fields(node, part_fields("axis.NAME"), &axis, section, problems_);
        const std::string name = section.name;
        section.also = {};
        const auto read_sub = [&](std::string_view sub, void* object) {
            const TomlNode* sub_table = node.find(sub);
            if (sub_table == nullptr || !is_table(*sub_table, fmt::format("axis.{}.{}", node.key, sub), problems_))
                return;
            section.name = fmt::format("{} of {}", sub, name);
            const auto refused =
                read_fields(*sub_table, part_fields(fmt::format("axis.NAME.{}", sub)), object, section, problems_);
            source.refused.insert(source.refused.end(), refused.begin(), refused.end());
        };
        read_sub("motor", &axis.motor);
        if (node.find("servo") != nullptr) read_sub("servo", &axis.servo.emplace());
        read_sub("switches", &axis.switches);
        read_sub("homing", &axis.homing);
        config_.axes.push_back(std::move(axis));
        sources_.push_back(std::move(source));
    }

    /// A card alone with several channels drives ideal axes: one encoder count per pulse, no step loss, no switches,
    /// ample travel.
    void add_ideal_axes() {
        const RackCard& card = config_.cards[0];
        const CardType& type = *find_card_type(card.type);
        const double max_pulse_hz = type.max_pulse_hz(card);
        constexpr std::string_view letters = "XYZA";
        for (std::size_t i = 0; i < std::min(type.channels.size(), letters.size()); ++i) {
            RackAxis axis = default_axis(letters[i]);
            axis.card = card.name;
            axis.channel = type.channels[i];
            axis.microsteps = 5;  // 1000 pulses per revolution, 1000 pulses per mm or degree
            axis.lead_mm = 1;
            axis.gear_ratio = 360;
            axis.encoder_counts_per_rev = axis.pulses_per_rev();
            axis.max_velocity = max_pulse_hz / axis.pulses_per_unit();
            axis.max_accel = 100'000;
            axis.max_jerk = 0;
            axis.min_limit = -2'000'000;
            axis.max_limit = 2'000'000;
            axis.motor = {max_pulse_hz, max_pulse_hz};
            config_.axes.push_back(std::move(axis));
            sources_.emplace_back();
        }
    }

    const TomlNode& root_;
    Problems& problems_;
    RackConfig config_;
    std::vector<AxisSource> sources_;
    bool alone_ = false;  ///< the whole file is one card by its type's name
};

RackReading only_error(Error error) {
    RackReading out;
    out.errors.push_back(std::move(error));
    return out;
}

}  // namespace

RackReading read_rack_text(std::string_view text, std::string_view file) {
    const Result<TomlNode> root = parse_toml(text, file);
    if (!root) return only_error(root.error());
    Problems problems{std::string(file)};
    RackConfig config = RackReader(*root, problems).read();
    RackReading out;
    if (!problems.any_errors()) out.config = std::move(config);
    out.errors = problems.take_errors();
    out.warnings = problems.take_warnings();
    return out;
}

RackReading read_rack_file(const std::filesystem::path& path) {
    const std::string name = path.string();
    const auto fail_io = [&](std::string what) { return only_error(Error{ErrorKind::io, std::move(what), name, {}}); };
    std::error_code code;
    const auto status = std::filesystem::status(path, code);
    if (status.type() == std::filesystem::file_type::not_found) {
        return fail_io("The rack file does not exist; 'motionrack new' writes one.");
    }
    if (!std::filesystem::status_known(status))
        return fail_io(fmt::format("The rack file cannot be reached: {}.", code.message()));
    if (std::filesystem::is_directory(status)) return fail_io("This is a folder, not a rack file.");
    const Result<std::string> text = read_whole_file(name, {max_toml_bytes, "a rack file"});
    if (!text) return only_error(Error{text.error().kind, text.error().message, name, {}});
    return read_rack_text(*text, name);
}

RackReading read_rack(std::string_view path_or_text) {
    if (path_or_text.find_first_of("\n=") != std::string_view::npos) return read_rack_text(path_or_text);
    if (path_or_text.empty()) {
        return only_error(Error{ErrorKind::invalid_input,
                                fmt::format("No rack file was named; give a path, or text such as card.c1 = \"{}\".",
                                            card_type_names().front()),
                                {},
                                {}});
    }
    return read_rack_file(std::filesystem::path(path_or_text));
}

}  // namespace motionrack::rack
