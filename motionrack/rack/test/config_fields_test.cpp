// Table of keys: every key's range, and the templates and the reference page written from it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <motionrack/rack/catalogue.hpp>
#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/mcx314_card.hpp>
#include <motionrack/rack/part_catalogue.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <set>
#include <tests/source_root.hpp>

namespace motionrack::rack {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// ---- Every key's range

struct FieldCase {
    const Field* field;
    std::string header;  ///< the section's header, without brackets
    char axis;
    std::string unit;
    std::string_view type = "mcx314";
};

std::vector<FieldCase> all_fields() {
    std::vector<FieldCase> out;
    const auto add = [&](std::span<const Field> fields, const std::string& header, char axis, const std::string& unit,
                         std::string_view type = "mcx314") {
        for (const Field& field : fields) {
            if (field.only.empty() || field.only == unit) out.push_back({&field, header, axis, unit, type});
        }
    };
    add(rack_fields(), "rack", 'X', "");
    add(controller_fields(), "controller", 'X', "");
    add(card_fields(), "card.m", 'X', "");
    for (const std::string_view type : card_type_names()) add(find_card_type(type)->settings, "card.m", 'X', "", type);
    for (const auto& [letter, unit] : {std::pair{'X', "mm"}, std::pair{'A', "deg"}}) {
        add(part_fields("axis.NAME"), fmt::format("axis.{}", letter), letter, unit);
        add(part_fields("axis.NAME.motor"), fmt::format("axis.{}.motor", letter), letter, unit);
        add(part_fields("axis.NAME.servo"), fmt::format("axis.{}.servo", letter), letter, unit);
        add(part_fields("axis.NAME.switches"), fmt::format("axis.{}.switches", letter), letter, unit);
        add(part_fields("axis.NAME.homing"), fmt::format("axis.{}.homing", letter), letter, unit);
    }
    for (const auto& [header, unit] : {std::pair{"belt.line", "mm"}, std::pair{"table.dial", "deg"}}) {
        add(part_fields("belt.NAME"), header, 'X', unit, "rtc5");
        add(part_fields("belt.NAME.sender"), fmt::format("{}.sender", header), 'X', unit, "rtc5");
        add(part_fields("belt.NAME.parts"), fmt::format("{}.parts", header), 'X', unit, "rtc5");
    }
    add(part_fields("scanner.NAME"), "scanner.head", 'X', "", "rtc5");
    add(lens_keys, "scanner.head.lens", 'X', "", "rtc5");
    add(galvo_keys, "scanner.head.galvo", 'X', "", "rtc5");
    add(laser_keys, "scanner.head.laser", 'X', "", "rtc5");
    add(part_fields("lamp.NAME"), "lamp.red", 'X', "");
    return out;
}

/// Returns a rack file with only that field besides the required ones; the field is in line 3.
std::string rack_with_field(const FieldCase& c, const std::string& value) {
    std::string out = fmt::format("\n[{}]\n{} = {}\n", c.header, with_unit(c.field->key, c.unit), value);
    const auto needs = [&](std::string_view header, std::string_view key, std::string_view text) {
        const bool same_section = c.header == header;
        if (same_section && c.field->key == key) return std::string();
        return fmt::format("{} = {}\n", key, text);
    };
    const std::string axis = fmt::format("axis.{}", c.axis);
    const std::string card_keys = needs("card.m", "type", fmt::format("\"{}\"", c.type));
    if (c.header.rfind("scanner", 0) == 0) {
        if (c.header != "scanner.head") out += "[scanner.head]\n";
        return out + needs("scanner.head", "card", "\"m\"") + "[card.m]\n" + card_keys;
    }
    if (c.header.rfind("belt", 0) == 0 || c.header.rfind("table", 0) == 0) return out + "[card.m]\n" + card_keys;
    if (find_card_type(c.type)->channels.empty()) return out + card_keys;
    const std::string axis_keys = needs(axis, "card", "\"m\"") + needs(axis, "channel", "\"x\"");
    if (c.header == "card.m") return out + card_keys + "[" + axis + "]\n" + axis_keys;
    if (c.header == axis) return out + axis_keys + "[card.m]\n" + card_keys;
    return out + "[card.m]\n" + card_keys + "[" + axis + "]\n" + axis_keys;
}

void expect_refused(const FieldCase& c, const std::string& value) {
    const std::string text = rack_with_field(c, value);
    const RackReading reading = read_rack_text(text);
    ASSERT_EQ(reading.errors.size(), 1U) << all_texts(reading.errors) << text;
    EXPECT_EQ(reading.errors[0].location.line, 3) << all_texts(reading.errors) << text;
    EXPECT_THAT(reading.errors[0].message, HasSubstr(with_unit(c.field->key, c.unit)));
    EXPECT_THAT(reading.errors[0].message, HasSubstr(range_text(*c.field, c.unit)));
}

TEST(RackKeys, RejectsEveryKeyOutOfRangeOrOfTheWrongType) {
    for (const FieldCase& c : all_fields()) {
        std::vector<std::string> bad = {"1979-05-27", "[1, 2]"};
        switch (c.field->type) {
            case FieldType::flag:
                bad.insert(bad.end(), {"1", "\"true\""});
                break;
            case FieldType::choice:
                bad.insert(bad.end(), {"1", "\"zzz\"", "\"\""});
                break;
            case FieldType::text:
                bad.insert(bad.end(), {"1", '"' + std::string(static_cast<std::size_t>(c.field->max) + 1, 'a') + '"'});
                if (c.field->min > 0) bad.push_back("\"\"");
                break;
            case FieldType::integer:
                bad.insert(bad.end(), {toml_text(static_cast<std::int64_t>(c.field->min) - 1),
                                       toml_text(static_cast<std::int64_t>(c.field->max) + 1), "9223372036854775807",
                                       "-9223372036854775808", toml_text(c.field->min + 0.5)});
                [[fallthrough]];
            case FieldType::number:
                bad.insert(bad.end(),
                           {"nan", "inf", "-inf", "1e300", "-1e300", "true", "\"1\"",
                            fmt::format("{}", std::nextafter(c.field->max, std::numeric_limits<double>::infinity())),
                            fmt::format("{}", std::nextafter(c.field->min, -std::numeric_limits<double>::infinity()))});
                break;
        }
        for (const std::string& value : bad) expect_refused(c, value);
    }
}

TEST(RackKeys, RefusesRandomNumbersOutsideTheRange) {
    const std::vector<FieldCase> cases = all_fields();
    EXPECT_TRUE(rc::check("a number outside its range is refused with its name and the range", [&] {
        const FieldCase& c = cases[*rc::gen::inRange<std::size_t>(0, cases.size())];
        RC_PRE(c.field->type == FieldType::number || c.field->type == FieldType::integer);
        const double scale = *rc::gen::positive<double>();
        const bool above = *rc::gen::arbitrary<bool>();
        const double value = above ? c.field->max * 1.000001 + scale : c.field->min - scale;
        RC_PRE(value < c.field->min || value > c.field->max);
        const RackReading reading = read_rack_text(rack_with_field(c, fmt::format("{:.17g}", value)));
        RC_ASSERT(reading.errors.size() == 1U);
        RC_ASSERT(reading.errors[0].message.find(range_text(*c.field, c.unit)) != std::string::npos);
        RC_ASSERT(reading.errors[0].message.find(with_unit(c.field->key, c.unit)) != std::string::npos);
    }));
}

TEST(RackKeys, KeepsNumbersBitForBit) {
    EXPECT_TRUE(rc::check("what the file says is what the config has", [] {
        const double lead = *rc::gen::inRange(1, 1'000'000) / 7000.0 + 1;
        const double travel = *rc::gen::inRange(1, 1'000'000) / 3000.0;
        const RackReading reading = read_rack_text(
            rack_with(fmt::format("lead_mm = {}\nmax_limit_mm = {}\nmax_velocity_mm_s = 2\n", lead, travel)));
        RC_ASSERT(reading.config.has_value());
        RC_ASSERT(reading.config->axes[0].lead_mm == lead);
        RC_ASSERT(reading.config->axes[0].max_limit == travel);
        RC_ASSERT(reading.config->axes[0].pulses_per_unit() == 3200 / lead);
    }));
}

TEST(RackKeys, TakesWholeNumbersWrittenWithAnExponentOrAPoint) {
    const RackConfig config =
        good(rack_with("microsteps = 8.0\nlead_mm = 10\n") + "[card.n]\ntype = \"mcx314\"\nbus_access_ns = 1.25e2\n");
    EXPECT_EQ(config.axes[0].microsteps, 8);
    EXPECT_EQ(config.axes[0].lead_mm, 10.0);
    EXPECT_EQ(mcx314_in(config.cards[1]).bus_access_ns, 125);
}

// ---- Templates and the reference page

TEST(RackTemplate, EveryVariantReadsWithoutErrorsOrWarnings) {
    for (const TemplateVariant& variant : template_variants()) {
        const Result<std::string> text = rack_template(variant.name);
        ASSERT_TRUE(text.has_value());
        const RackReading reading = read_rack(*text);
        EXPECT_TRUE(reading.config.has_value()) << all_texts(reading.errors);
        EXPECT_THAT(reading.warnings, IsEmpty()) << all_texts(reading.warnings);
    }
    EXPECT_EQ(good(*rack_template("router")).axes.size(), 4U);
    EXPECT_EQ(good(*rack_template("router")).axis('A')->channel, "u");
    EXPECT_EQ(good(*rack_template("stage")).axes.size(), 2U);
    EXPECT_EQ(good(*rack_template("single")).axes.size(), 1U);
}

TEST(RackTemplate, ListsTheTemplatesForAnUnknownName) {
    const Result<std::string> text = rack_template("routr");
    ASSERT_FALSE(text.has_value());
    EXPECT_THAT(text.error().message, HasSubstr("router, stage, single, carriage, marking; did you mean 'router'?"));
}

TEST(RackTemplate, StatesRangeAndDefaultOfEveryKey) {
    const std::string router = *rack_template("router"), carriage = *rack_template("carriage");
    for (const FieldCase& c : all_fields()) {
        const bool servo = c.header.find(".servo") != std::string::npos;
        const std::string card = fmt::format("\ntype = \"{}\" ", c.type);
        const bool has_card = router.find(card) != std::string::npos || carriage.find(card) != std::string::npos;
        // These templates have no rotary servo, no lamp, and two cards.
        if ((servo && c.axis != 'X') || c.header == "lamp.red" || !has_card) continue;
        const std::string& text = servo || c.type == "databoard4002" ? carriage : router;
        const std::string key = with_unit(c.field->key, c.unit);
        std::size_t at = text.find('\n' + key + " = ");
        if (at == std::string::npos) at = text.find("\n# " + key + " =");
        ASSERT_NE(at, std::string::npos) << key;
        const std::string line = text.substr(at + 1, text.find('\n', at + 1) - at - 1);
        EXPECT_THAT(
            line, HasSubstr("; " + range_text(*c.field, c.unit) + "; " + (c.field->required ? "required" : "default ")))
            << key;
    }
}

TEST(RackTemplate, ItsCommentedDefaultsAreThoseOfAnEmptySection) {
    const RackConfig config = good(rack_with(""));
    for (const FieldCase& c : all_fields()) {
        if (c.header != "axis.X" || !c.field->default_doc.empty()) continue;
        const RackAxis defaults = default_axis('X');
        EXPECT_EQ(c.field->get(&config.axes[0], *c.field), c.field->get(&defaults, *c.field)) << c.field->key;
    }
}

TEST(RackTemplate, TheExamplesAreItsOutput) {
    for (const TemplateVariant& variant : template_variants()) {
        const std::filesystem::path path = source_root / "examples/racks" / (std::string(variant.name) + ".toml");
        std::ifstream in(path, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        EXPECT_EQ(text, *rack_template(variant.name)) << path << " is not what 'motionrack new' writes; write it anew";
        EXPECT_TRUE(read_rack(path.string()).config.has_value());
    }
}

TEST(RackReference, HasEveryKeyPinAndEnd) {
    const std::string page = rack_file_reference();
    for (const FieldCase& c : all_fields()) {
        EXPECT_THAT(page, HasSubstr('`' + with_unit(c.field->key, c.unit) + '`'));
        EXPECT_THAT(page, HasSubstr(std::string(c.field->doc)));
    }
    for (const std::string_view name : card_type_names()) {
        const CardType& type = *find_card_type(name);
        for (const PinType& pin : type.channel_pins)
            EXPECT_THAT(page, HasSubstr(fmt::format("`{}{}`", type.channel_name(0), pin.name)));
        // If the settings determine the number of pins, the first and the last of both kinds represent all.
        const bool numbered = type.chip_pin_count != nullptr;
        for (std::size_t i = 0; i < type.chip_pins.size(); ++i)
            if (!numbered || i < 2 || i + 2 >= type.chip_pins.size()) {
                EXPECT_THAT(page, HasSubstr(fmt::format("`{}`", type.chip_pins[i].name)));
            }
    }
    std::vector<std::string> ends;
    for (const PartKind* kind : part_kinds())
        if (kind->signals != nullptr)
            for (const DeclaredSignal& one : kind->signals->declared()) ends.push_back(one.name);
    for (const std::string& end : ends) EXPECT_THAT(page, HasSubstr(fmt::format("| `{}` |", end)));
    EXPECT_THAT(ends,
                testing::IsSupersetOf({"X.step", "X.cam", "NAME.enc_a", "NAME.sensor_n", "NAME.in", "probe", "estop"}));
}

TEST(CardTypes, HaveUniquePinsAndChoicesThatTheReaderKnows) {
    std::set<std::string> ends;
    for (const DeclaredSignal& one : axis_part_kind.signals->declared()) ends.insert(one.name);
    for (const CardPlugin* plugin : card_plugins()) {
        const CardType& type = plugin->type;
        std::set<std::string> names;
        for (const CardPin& pin : pins_of(type)) EXPECT_TRUE(names.insert(pin.name).second) << pin.name;
        EXPECT_EQ(find_card_type(type.name), &type);
        for (const DefaultWire& wire : type.default_wires) {
            EXPECT_EQ(ends.count(fmt::format("X.{}", wire.end)), 1U) << wire.end;
            EXPECT_EQ(names.count(std::string(type.channel_name(0)).append(wire.pin)), 1U);
        }
        const auto& choices = card_fields()[0].choices;
        EXPECT_NE(std::find(choices.begin(), choices.end(), type.name), choices.end());
    }
    EXPECT_EQ(pins_of(mcx314_plugin.type).size(), 4U * 23 + 3);
}

TEST(DidYouMean, FindsTheNearestNameOnly) {
    const std::vector<std::string_view> names = {"max_mm", "min_mm", "lead_mm"};
    EXPECT_EQ(did_you_mean("mxa_mm", names), "; did you mean 'max_mm'?");
    EXPECT_EQ(did_you_mean("LEAD_MM", names), "; did you mean 'lead_mm'?");
    EXPECT_EQ(did_you_mean("colour", names), "");
    EXPECT_EQ(did_you_mean(std::string(1000, 'm'), names), "");
}

TEST(NumberText, IsShortAndReadsBackToTheSameNumber) {
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(number_text(1e-6), "0.000001");
    EXPECT_EQ(number_text(16e6), "16000000");
    EXPECT_EQ(number_text(-0.0), "0");
    EXPECT_TRUE(rc::check("what is written reads back", [](double value) {
        RC_PRE(std::isfinite(value));
        RC_ASSERT(std::strtod(number_text(value).c_str(), nullptr) == value);
    }));
}

}  // namespace
}  // namespace motionrack::rack
