// Edits a rack file's tree; the written text reads back as the same rack.
#include <gtest/gtest.h>

#include <motionrack/rack/config.hpp>
#include <motionrack/rack/template.hpp>
#include <motionrack/rack/toml_edit.hpp>

namespace motionrack::rack {
namespace {

std::string text_of_toml(const TomlNode& root) {
    return toml_of(toml_lines(root));
}

TomlNode number(double value) {
    TomlNode out;
    out.type = TomlType::number;
    out.number = value;
    return out;
}

TEST(TomlEdit, WritesEveryTemplateSoThatItReadsTheSame) {
    for (const TemplateVariant& variant : template_variants()) {
        const std::string text = *rack_template(variant.name);
        const std::string lines = text_of_toml(*parse_toml(text, ""));
        EXPECT_EQ(text_of_toml(*parse_toml(lines, "")), lines) << variant.name;
        const RackReading reading = read_rack_text(lines);
        ASSERT_TRUE(reading.config) << variant.name << ": " << reading.errors.front().text();
        EXPECT_EQ(reading.config->wires.size(), read_rack_text(text).config->wires.size());
        EXPECT_EQ(reading.config->cards.size(), read_rack_text(text).config->cards.size());
    }
}

TEST(TomlEdit, KeepsTextsOfAllKinds) {
    const TomlNode root = *parse_toml(
        "a.\"b.c\" = \"x\\\"\\\\\\n\\u0001\xC3\xA4\"\nd = {}\ne = [1, 2.5, [true], {f = 'g'}]\nh = 1e300\ni = -0.1\n",
        "");
    EXPECT_EQ(text_of_toml(root),
              "a.\"b.c\" = \"x\\\"\\\\\\u000A\\u0001\xC3\xA4\"\nd = {}\ne = [1, 2.5, [true], {f = \"g\"}]\nh = "
              "1e+300\ni = -0.1\n");
    EXPECT_EQ(text_of_toml(*parse_toml(text_of_toml(root), "")), text_of_toml(root));
}

TEST(TomlEdit, OverwritesValuesAndCreatesTables) {
    TomlNode root = *parse_toml("[axis.X]\nmax_limit_mm = 3\ncard = \"m\"\n", "");
    EXPECT_TRUE(put_value(root, toml_path("axis.X.max_limit_mm"), number(5)));
    EXPECT_TRUE(put_value(root, toml_path("axis.Y.servo.time_constant_ms"), number(2.5)));
    EXPECT_TRUE(put_value(root, toml_path("wires.\"m.xin1\""), number(0)));
    const std::string before =
        "axis.X.max_limit_mm = 5\naxis.X.card = \"m\"\naxis.Y.servo.time_constant_ms = 2.5\nwires.\"m.xin1\" = 0\n";
    EXPECT_EQ(text_of_toml(root), before);
    EXPECT_FALSE(put_value(root, toml_path("axis.X"), number(5)));
    EXPECT_FALSE(put_value(root, toml_path("axis.X.card.name"), number(5)));
    EXPECT_EQ(text_of_toml(root), before);
}

TEST(TomlEdit, SplitsDottedNames) {
    using Path = std::vector<std::string>;
    EXPECT_EQ(toml_path("axis.X.max_limit_mm"), (Path{"axis", "X", "max_limit_mm"}));
    EXPECT_EQ(toml_path("wires.\"m.xin1\""), (Path{"wires", "m.xin1"}));
    EXPECT_EQ(toml_name(toml_path("wires.\"m.xin1\"")), "wires.\"m.xin1\"");
    for (const char* bad : {"", ".", "a.", ".a", "a..b", "\"a", "a b", "\"a\"b", "\"\""})
        EXPECT_TRUE(toml_path(bad).empty()) << bad;
}

}  // namespace
}  // namespace motionrack::rack
