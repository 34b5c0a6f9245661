// Report page: its content, escaping of all run data, and its maximum size.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <motionrack/trace/report.hpp>
#include <nlohmann/json.hpp>
#include <random>

#include "scratch.hpp"

namespace motionrack::trace {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Returns a run of `samples` samples along a circle of 20 mm by two axes, with a velocity spike at two thirds.
ReportData circle(std::size_t samples) {
    ReportData data;
    data.title = "Circle";
    data.program_name = "circle.ngc";
    data.rack_name = "bench.toml";
    data.verdict = {true, "Driven as programmed."};
    data.numbers = {{"Duration", "12.48", "s"}};
    data.axes.resize(2);
    ReportSegment segment;
    segment.line = 7;
    for (std::size_t i = 0; i < samples; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(samples - 1), angle = part * 6.2831853;
        const Xyz at = {20 * std::cos(angle), 20 * std::sin(angle), 0};
        data.seconds.push_back(part * 12.48);
        data.driven.push_back(at);
        if (i % 10 == 0) segment.points.push_back(at);
        data.deviation_mm.push_back(static_cast<float>(0.004 * part));
        for (std::size_t a = 0; a < 2; ++a) {
            data.axes[a].position.push_back(static_cast<float>(at[a]));
            data.axes[a].velocity.push_back(i == samples * 2 / 3 ? 77.0F : static_cast<float>(10 * std::sin(angle)));
        }
    }
    data.planned = {segment};
    data.axes[0].name = std::string("X");
    data.axes[1].name = std::string("Y");
    data.axes[0].max_velocity = 100;
    data.axes[0].peak_velocity = 77;
    data.axes[0].pulses_sent = 1234567;
    data.axes[0].lost_steps = 3;
    data.tolerance_mm = 0.01;
    data.max_deviation = ReportMaxDeviation{0.004, 12.48, 7, {20, 0, 0}};
    data.moves = {{7, "G3 X20 I-20", "arc", 125.664, "mm", 0, 12.48, 0, 10.5, 0, 0.004}};
    data.warnings = {{3.25, 7, "Close to the limit."}};
    data.notes = {"Cutting forces."};
    return data;
}

nlohmann::json drawing_of(const std::string& page) {
    const std::string open = "id=\"drawing\">";
    const std::size_t from = page.find(open) + open.size();
    return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

std::vector<double> unpacked(const nlohmann::json& packed) {
    std::vector<double> values;
    long long sum = 0;
    for (const auto& step : packed["d"]) {
        sum += step.get<long long>();
        values.push_back(packed["from"].get<double>() + packed["step"].get<double>() * static_cast<double>(sum));
    }
    return values;
}

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t number = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++number;
    return number;
}

TEST(Report, ShowsVerdictNumbersAxesMovesWarningsAndNotes) {
    const std::string page = report_html(circle(1000));
    for (const char* part :
         {"Driven as programmed.", "12.48", "circle.ngc", "bench.toml",
          "1\xC2\xA0"
          "234\xC2\xA0"
          "567",
          "3 lost", "77&nbsp;% of 100", "G3 X20 I-20", "125.664", "Close to the limit.", "Cutting forces."}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
    EXPECT_EQ(page.find("{{"), std::string::npos);
}

TEST(Report, ShowsThePositionOfTheMachineAtAWarning) {
    ReportData data = circle(1001);
    data.warnings = {{3.12, 7, "Quarter"}, {50, 0, "After the end"}, {-1, 0, "No instant"}};
    const std::string page = report_html(data);
    EXPECT_NE(page.find("X&nbsp;0 Y&nbsp;20 Z&nbsp;0</td><td class=\"t\">Quarter"), std::string::npos);
    EXPECT_NE(page.find("<td class=\"n\"></td><td class=\"t\">After the end"), std::string::npos);
    EXPECT_NE(page.find("<td class=\"n\"></td><td class=\"t\">No instant"), std::string::npos);
}

TEST(Report, NamesTheLimitsOutsideTheChart) {
    ReportData data = circle(1000);
    EXPECT_NE(report_html(data).find("limit-words drawn\">limit \xC2\xB1"
                                     "100<"),
              std::string::npos);
    data.axes[0].max_velocity = 4000;
    EXPECT_NE(report_html(data).find("limit-words\">limit \xC2\xB1"
                                     "4000, off the chart<"),
              std::string::npos);
}

TEST(Report, ComparesTheCounterOfTheCardWithTheNetPulses) {
    ReportData data = circle(100);
    data.axes[0].pulses_sent = 900;
    data.axes[0].pulses_net = data.axes[0].pulse_counter = 100;
    data.axes[1].pulses_net = data.axes[1].pulse_counter = 5;
    EXPECT_EQ(count(report_html(data), "card counts the same"), 2U);
    data.axes[0].pulse_counter = 99;
    const std::string page = report_html(data);
    EXPECT_EQ(count(page, "card counts the same"), 1U);
    EXPECT_NE(page.find("net 100, the card counts 99"), std::string::npos);
}

TEST(Report, OfTheSameRunHasTheSameBytes) {
    EXPECT_EQ(report_html(circle(5000)), report_html(circle(5000)));
}

TEST(Report, LoadsNothingFromTheNetwork) {
    const std::string page = report_html(circle(1000));
    for (const char* link : {"http://", "https://", "src=", "@import", "url(", "<link"}) {
        EXPECT_EQ(page.find(link), std::string::npos) << link;
    }
    EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
}

TEST(Report, EscapesTextsOfARun) {
    const std::string evil = "</script></style></title><script>alert(1)</script><!-- \" onload='x' {{notes}} ]]>";
    ReportData data = circle(100);
    const std::size_t scripts = count(report_html(data), "<script");
    data.title = data.program_name = data.rack_name = data.verdict.text = evil;
    data.numbers = {{evil, evil, evil}};
    for (ReportAxis& axis : data.axes) axis.name = axis.unit = evil;
    data.moves[0].text = data.moves[0].kind = data.moves[0].unit = evil;
    data.warnings[0].text = evil;
    data.notes = {evil};
    data.stop = ReportStop{1, 7, {1, 2, 3}, evil};
    const std::string page = report_html(data);
    EXPECT_EQ(count(page, "<script"), scripts);
    EXPECT_EQ(count(page, "</script>"), scripts);
    EXPECT_EQ(count(page, "</style>"), 1U);
    EXPECT_EQ(count(page, "alert(1)"),
              count(page, "&lt;script&gt;alert(1)") + count(page, "\\u003cscript\\u003ealert(1)"));
    EXPECT_EQ(count(page, "onload='x'"), 0U + count(page, "\\u003c!-- \\\" onload='x'"));
    EXPECT_EQ(drawing_of(page)["charts"][0]["name"], evil);
}

TEST(Report, ReplacesInvalidUtf8ByReplacementCharacters) {
    ReportData data = circle(100);
    data.title =
        "a\xFF"
        "b\xC3\xA4\xE2\x82";
    data.axes[0].name = "\xC0\x80";
    const std::string page = report_html(data);
    EXPECT_NE(page.find("<title>a\xEF\xBF\xBD"
                        "b\xC3\xA4\xEF\xBF\xBD"),
              std::string::npos);
    EXPECT_EQ(page.find('\xFF'), std::string::npos);
    EXPECT_EQ(page.find('\xC0'), std::string::npos);
}

TEST(Report, ThinningKeepsExtremesAndStaysNearThePath) {
    const std::size_t samples = 300'000;
    const std::string page = report_html(circle(samples));
    const auto drawing = drawing_of(page);
    const auto velocity = unpacked(drawing["charts"][1]["v"]);
    EXPECT_LT(velocity.size(), 6001U);
    EXPECT_NEAR(*std::max_element(velocity.begin(), velocity.end()), 77, 1e-3);
    EXPECT_NEAR(*std::min_element(velocity.begin(), velocity.end()), -10, 1e-3);
    const auto x = unpacked(drawing["driven"]["x"]), y = unpacked(drawing["driven"]["y"]);
    ASSERT_GT(x.size(), 50U);
    EXPECT_LT(x.size(), samples / 10);
    for (std::size_t i = 1; i < x.size(); ++i) {  // the middle of each chord, where the arc deviates most
        EXPECT_NEAR(std::hypot((x[i] + x[i - 1]) / 2, (y[i] + y[i - 1]) / 2), 20, 0.0015);
    }
}

TEST(Report, NumbersThatAreNotFiniteAreNeverWritten) {
    ReportData data = circle(1000);
    const double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 1000; i += 7) {
        data.axes[0].velocity[i] = static_cast<float>(not_a_number);
        data.axes[1].position[i] = static_cast<float>(-infinity);
        data.driven[i] = {not_a_number, infinity, 0};
        data.seconds[i] = i % 2 == 0 ? not_a_number : data.seconds[i];
    }
    data.axes[0].max_velocity = not_a_number;
    data.axes[1].max_position = infinity;
    data.axes[0].peak_accel = data.axes[0].actual_end = data.tolerance_mm = infinity;
    data.max_deviation = ReportMaxDeviation{not_a_number, not_a_number, 0, {not_a_number, 0, 0}};
    data.moves[0].duration = data.moves[0].length = not_a_number;
    data.warnings[0].seconds = not_a_number;
    const std::string page = report_html(data);
    for (const char* word :
         {">nan", ">inf", ":nan", ":inf", ",nan", ",inf", "[nan", "[inf", "\"nan", "\"inf", "-nan", "-inf", "null"}) {
        const std::string before_script = page.substr(0, page.find("\"use strict\""));
        EXPECT_EQ(before_script.find(word), std::string::npos) << word;
    }
    EXPECT_FALSE(drawing_of(page).empty());
}

TEST(Report, ShowsAndEscapesPicturesTablesSeriesAndAFile) {
    ReportData data;
    data.program_kind = "Job";
    data.program_name = "<job>";
    data.pictures.push_back({"<b>A</b>", {"first & last", "second"}, "<svg class=\"mine\"></svg>", true});
    data.tables.push_back({"T<", "C&", {"H\""}, {}});
    for (int i = 0; i < 2001; ++i) data.tables[0].rows.push_back({"<i>cell</i>"});
    data.seconds = {0, 1, 2};
    data.series.push_back({"Level, mm", "x", {0, 5, 2}, "field", {-6, 6}});
    data.source = ReportSource{"The <file>", "a = '</pre>'\n\tb\n"};
    const std::string page = report_html(data);
    for (const char* seen :
         {"Job <b>&lt;job&gt;</b>", "&lt;b&gt;A&lt;/b&gt;", "<span>first &amp; last</span><span>second</span>",
          "<svg class=\"mine\"></svg>", "figure class=\"card wide\"", "<h2>T&lt;</h2>", "&lt;i&gt;cell&lt;/i&gt;",
          "and 1 more", "Level, mm", "field -6 ", "a = &#39;&lt;/pre&gt;&#39;\n"})
        EXPECT_NE(page.find(seen), std::string::npos) << seen;
    EXPECT_EQ(count(page, "<td class=\"t\">&lt;i&gt;"), 2000U);
    EXPECT_EQ(drawing_of(page)["charts"].size(), 1U);
    EXPECT_EQ(page.find("<i>cell"), std::string::npos);
}

TEST(Report, OfAnEmptyRunIsAPage) {
    const std::string page = report_html({});
    EXPECT_NE(page.find("<title>Motionrack run</title>"), std::string::npos);
    EXPECT_TRUE(drawing_of(page)["charts"].empty());
}

TEST(Report, StaysBelowFourMegabytesWhateverComesIn) {
    std::mt19937 random(20);
    std::uniform_real_distribution<double> jitter(-100, 100);
    ReportData data;
    data.axes.resize(6);
    for (std::size_t i = 0; i < 200'000; ++i) {
        data.seconds.push_back(static_cast<double>(i) * 1e-3);
        data.driven.push_back({jitter(random), jitter(random), jitter(random)});
        data.deviation_mm.push_back(static_cast<float>(jitter(random)));
        for (ReportAxis& axis : data.axes) {
            for (auto* series : {&axis.position, &axis.velocity, &axis.accel})
                series->push_back(static_cast<float>(jitter(random)));
        }
        const Xyz a = {jitter(random), jitter(random), jitter(random)},
                  b = {jitter(random), jitter(random), jitter(random)};
        data.planned.push_back({{a, b}, i % 2 == 0, static_cast<int>(i)});
        data.moves.push_back({static_cast<int>(i), std::string(300, '"'), "line", 1, "mm",
                              0.001 * static_cast<double>(i), 1, 1, 1, 1, 1});
        data.warnings.push_back({1, 1, std::string(3000, '<')});
        data.notes.push_back("note");
    }
    const std::string page = report_html(data);
    EXPECT_LT(page.size(), 4'000'000U);
    EXPECT_NE(page.find("The first 2\xC2\xA0"
                        "000 of 200\xC2\xA0"
                        "000 moves"),
              std::string::npos);
    EXPECT_EQ(count(page, "data-move="), 2000U);
}

TEST(Report, ReportsThatItCouldNotBeWritten) {
    const auto written = write_report(circle(10), "/nowhere/at/all.html");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().kind, ErrorKind::io);
    const Scratch scratch;
    ASSERT_TRUE(write_report(circle(10), scratch.path("r.html")));
    EXPECT_EQ(file_text(scratch.path("r.html")), report_html(circle(10)));
}

}  // namespace
}  // namespace motionrack::trace
