// Keys of earlier rack files: every old name is rejected with its present name.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/config_parts.hpp>
#include <motionrack/rack/optics_fields.hpp>
#include <motionrack/rack/part_sections.hpp>
#include <motionrack/rack/test/config_helpers.hpp>

namespace motionrack::rack {
namespace {

/// A section of a rack file: the smallest text that ends in its heading, its keys, and the unit for "{u}".
struct SectionText {
    std::string text;
    std::span<const Field> fields;
    std::string unit = {};
};

std::vector<SectionText> axis_sections() {
    std::vector<SectionText> out;
    for (const bool rotary : {false, true}) {
        const char letter = rotary ? 'A' : 'X';
        const std::string unit = rotary ? "deg" : "mm";
        const auto sub = [&](std::string_view name) {
            return rack_with(fmt::format("[axis.{}.{}]\n", letter, name), letter);
        };
        out.push_back({rack_with("", letter), part_fields("axis.NAME"), unit});
        out.push_back({sub("motor"), part_fields("axis.NAME.motor"), unit});
        out.push_back({sub("servo"), part_fields("axis.NAME.servo"), unit});
        out.push_back({sub("switches"), part_fields("axis.NAME.switches"), unit});
        out.push_back({sub("homing"), part_fields("axis.NAME.homing"), unit});
    }
    return out;
}

std::vector<SectionText> conveyor_sections() {
    std::vector<SectionText> out;
    for (const bool rotary : {false, true}) {
        const std::string name = rotary ? "table.t1" : "belt.b1";
        const std::string unit = rotary ? "deg" : "mm";
        out.push_back({rack_with("[" + name + "]\n"), part_fields("belt.NAME"), unit});
        out.push_back({rack_with("[" + name + ".sender]\n"), part_fields("belt.NAME.sender"), unit});
        out.push_back({rack_with("[" + name + ".parts]\n"), part_fields("belt.NAME.parts"), unit});
    }
    return out;
}

std::vector<SectionText> all_sections() {
    std::vector<SectionText> out = {
        {rack_with("[rack]\n"), rack_fields()},
        {rack_with("[controller]\n"), controller_fields()},
        {rack_with("[safety]\n"), safety_fields()},
        {rack_with("[probe]\n"), part_fields("probe")},
        {rack_with("[stage.s1]\n"), part_fields("stage.NAME")},
        {rack_with("[stage.s1.scale]\n"), part_fields("stage.NAME.scale")},
        {rack_with("[stage.s1.servo]\n"), part_fields("stage.NAME.servo")},
        {rack_with("[scanner.s1]\n"), part_fields("scanner.NAME")},
        {rack_with("[scanner.s1.lens]\n"), lens_keys},
        {rack_with("[scanner.s1.galvo]\n"), galvo_keys},
        {rack_with("[scanner.s1.laser]\n"), laser_keys},
    };
    for (const std::string_view type : card_type_names())
        out.push_back({fmt::format("[card.c]\ntype = \"{}\"\n", type), find_card_type(type)->settings});
    for (SectionText& section : axis_sections()) out.push_back(std::move(section));
    for (SectionText& section : conveyor_sections()) out.push_back(std::move(section));
    return out;
}

TEST(RackFile, RejectsEveryFormerKeyWithItsPresentName) {
    std::size_t rows = 0;
    for (const SectionText& section : all_sections()) {
        for (const Field& field : section.fields) {
            if (field.old_key.empty()) continue;
            ++rows;
            const std::string old_key = with_unit(field.old_key, section.unit);
            const std::string text = fmt::format("{}{} = 1\n", section.text, old_key);
            const RackReading reading = read_rack_text(text);
            EXPECT_FALSE(reading.config.has_value()) << text;
            EXPECT_THAT(
                all_texts(reading.errors),
                ::testing::HasSubstr(fmt::format("'{}' is now '{}'.", old_key, with_unit(field.key, section.unit))))
                << text;
        }
    }
    EXPECT_GE(rows, 60u);
}

TEST(RackFile, RejectsAFormerCardKeyAtItsPosition) {
    const RackReading reading = read_rack_text("[card.c]\ntype = \"databoard4002\"\nselect = 3\n");
    ASSERT_EQ(reading.errors.size(), 1u) << all_texts(reading.errors);
    EXPECT_EQ(reading.errors[0].location, (TextPosition{3, 1}));
    EXPECT_EQ(reading.errors[0].message, "'select' is now 'card_number'.");
}

}  // namespace
}  // namespace motionrack::rack
