// Recordings: all data is read back, also from a truncated file; damage is reported and never crashes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <motionrack/trace/former_version.hpp>
#include <motionrack/trace/report_json.hpp>
#include <random>

#include "recorded.hpp"
#include "scratch.hpp"

namespace motionrack::trace {
namespace {

using testing::HasSubstr;

RC_GTEST_PROP(Recording, GivesBackEveryEventWithItsTick, ()) {
    const Scratch scratch;
    PlainRecording plain;
    const auto gaps = *rc::gen::container<std::vector<std::uint32_t>>(rc::gen::arbitrary<std::uint32_t>());
    std::int64_t at = 0;
    for (const std::uint32_t gap : gaps) {
        const std::size_t signal = *rc::gen::inRange<std::size_t>(0, plain.head.signals.size());
        const bool steps = plain.head.signals[signal].kind == SignalKind::steps;
        at += gap;
        plain.events.push_back({signal, at, steps ? (gap % 2 == 0 ? 1 : -1) : *rc::gen::arbitrary<std::int64_t>()});
    }
    plain.end.at = Instant{at + 1};
    RC_ASSERT(plain.write(scratch.path("a.h5")).has_value());
    const auto reader = RecordingReader::open(scratch.path("a.h5"));
    RC_ASSERT(reader.has_value());
    RC_ASSERT(reader->whole());
    RC_ASSERT(reader->known_to() == plain.end.at);
    for (std::size_t i = 0; i < plain.head.signals.size(); ++i)
        RC_ASSERT(events_of(*reader, plain.head.signals[i].name) == plain.expected(i));
}

TEST(Recording, ReadsBackMoreThanItsBuffersHold) {
    const Scratch scratch;
    const PlainRecording plain = busy(300'000);
    ASSERT_TRUE(plain.write(scratch.path("a.h5")));
    const auto reader = RecordingReader::open(scratch.path("a.h5"));
    ASSERT_TRUE(reader) << reader.error().text();
    for (std::size_t i = 0; i < plain.head.signals.size(); ++i)
        EXPECT_EQ(events_of(*reader, plain.head.signals[i].name), plain.expected(i)) << i;
}

TEST(Recording, KeepsTheProgramAndItsResult) {
    const Scratch scratch;
    PlainRecording plain;
    plain.head.program = "G1 X1\r\n(\xC3\xA9)\n" + std::string(200'000, 'G');
    plain.head.block_delete = plain.head.live = true;
    plain.head.inputs = {{milliseconds(5), "fault X.limit_plus=0"}, {whole_seconds(2), "hold"}};
    auto writer = RecordingWriter::create(scratch.path("a.h5"), plain.head, Instant{7});
    ASSERT_TRUE(writer);
    writer->input({whole_seconds(3), "stop"});
    ASSERT_TRUE(writer->close(plain.end));
    const auto reader = RecordingReader::open(scratch.path("a.h5"));
    ASSERT_TRUE(reader) << reader.error().text();
    EXPECT_EQ(reader->head().program, plain.head.program);
    EXPECT_EQ(reader->head().rack, plain.head.rack);
    EXPECT_EQ(reader->head().axes, plain.head.axes);
    EXPECT_EQ(reader->head().signals, plain.head.signals);
    EXPECT_TRUE(reader->head().block_delete && reader->head().live && !reader->head().stream);
    EXPECT_EQ(reader->began(), Instant{7});
    EXPECT_EQ(reader->outcome(), plain.end.outcome);
    const std::vector<RecordedInput> inputs = {
        {milliseconds(5), "fault X.limit_plus=0"}, {whole_seconds(2), "hold"}, {whole_seconds(3), "stop"}};
    EXPECT_EQ(reader->inputs(), inputs);
}

TEST(Recording, MakesTheReportOfItsRunAgain) {
    const Scratch scratch;
    PlainRecording plain = busy(5000);
    plain.samples[3].axes[0].accel = std::nanf("");
    plain.end.report.moves.push_back({3, "G1 X1", "line", 1.5, "mm", 0.1, 0.2, 1, 2, 3, 0.004});
    plain.end.report.planned.push_back({{{0, 0, 0}, {1.0 / 3, 2, 3}}, true, 4});
    plain.end.report.max_deviation = ReportMaxDeviation{0.01, 0.5, 3, {1, 2, 3}};
    plain.end.report.notes = {"a <b> & \"c\""};
    ASSERT_TRUE(plain.write(scratch.path("a.h5")));
    const auto reader = RecordingReader::open(scratch.path("a.h5"));
    ASSERT_TRUE(reader);
    const auto data = reader->report();
    ASSERT_TRUE(data) << data.error().text();
    EXPECT_EQ(report_json(*data), report_json(plain.end.report));
    ASSERT_EQ(data->seconds.size(), plain.samples.size());
    for (std::size_t i = 0; i < plain.samples.size(); ++i) {
        const PlainSample& sample = plain.samples[i];
        EXPECT_EQ(data->seconds[i], to_seconds(Duration{sample.at - plain.samples[0].at}));
        EXPECT_EQ(data->axes[0].position[i], static_cast<float>(sample.axes[0].position));
        EXPECT_EQ(data->axes[1].volts[i], sample.axes[1].volts);
        EXPECT_EQ(data->deviation_mm[i], static_cast<float>(sample.deviation));
    }
    EXPECT_TRUE(std::isnan(data->axes[0].accel[3]));
    EXPECT_TRUE(data->axes[0].volts.empty());
}

RC_GTEST_PROP(ReportJson, KeepsEveryBitOfANumber, (double value, std::int64_t whole, std::string text)) {
    ReportData data;
    data.tolerance_mm = value;
    data.axes.resize(1);
    data.axes[0].pulses_sent = whole;
    for (char& c : text) c = static_cast<char>(c & 0x7F);
    data.notes = {text};
    const auto back = report_from_json(report_json(data));
    RC_ASSERT(back.has_value());
    RC_ASSERT(std::memcmp(&back->tolerance_mm, &value, sizeof value) == 0 || !std::isfinite(value));
    RC_ASSERT(back->axes[0].pulses_sent == whole);
    RC_ASSERT(back->notes[0] == text);
}

TEST(ReportJson, ReadsTheMaximumDeviationUnderItsFormerName) {
    const auto data = report_from_json(R"({"worst": {"mm": 0.5, "line": 3}})");
    ASSERT_TRUE(data && data->max_deviation);
    EXPECT_EQ(data->max_deviation->mm, 0.5);
    EXPECT_EQ(data->max_deviation->line, 3);
}

TEST(Recording, IgnoresWhatComesAfterItsEnd) {
    const Scratch scratch;
    const PlainRecording plain = busy(1000);
    auto writer = RecordingWriter::create(scratch.path("a.h5"), plain.head, Instant{0});
    ASSERT_TRUE(writer);
    EXPECT_TRUE(writer->is_open());
    plain.write(*writer);
    ASSERT_TRUE(writer->close(plain.end));
    EXPECT_FALSE(writer->is_open());
    const std::string whole = file_text(scratch.path("a.h5"));
    plain.write(*writer);
    writer->input({whole_seconds(3), "stop"});
    writer->flush(whole_seconds(4));
    EXPECT_TRUE(writer->close(plain.end));
    EXPECT_EQ(file_text(scratch.path("a.h5")), whole);
}

TEST(Recording, ReportsTheErrorOfItsEndAtEachFurtherEnd) {
    const Scratch scratch;
    const PlainRecording plain = busy(1000);
    auto writer = RecordingWriter::create(scratch.path("a.h5"), plain.head, Instant{0});
    ASSERT_TRUE(writer);
    std::filesystem::remove(scratch.path("a.h5.incomplete"));
    const Result<void> first = writer->close(plain.end);
    ASSERT_FALSE(first);
    EXPECT_FALSE(writer->is_open());
    plain.write(*writer);
    const Result<void> again = writer->close(plain.end);
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().message, first.error().message);
}

// ---- truncated

/// Writes in a child process that kills itself, with a flush after every `flush` events and more events after the last
/// flush.
void write_and_die(const PlainRecording& plain, const std::string& path, std::size_t flush) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        auto writer = RecordingWriter::create(path, plain.head, Instant{0});
        if (!writer) ::_exit(1);
        for (std::size_t i = 0; i < plain.events.size(); ++i) {
            writer->event(plain.events[i].signal, Instant{plain.events[i].at}, plain.events[i].value);
            if (i % flush == flush - 1) writer->flush(Instant{plain.events[i].at + 1});
        }
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
}

TEST(Recording, OfAKilledProgramHasAllFlushedData) {
    const Scratch scratch;
    for (const std::size_t flush : {300u, 7'000u, 60'000u}) {
        const PlainRecording plain = busy(100'000);
        write_and_die(plain, scratch.path("a.h5"), flush);
        EXPECT_THAT(RecordingReader::open(scratch.path("a.h5")).error().message, HasSubstr("a.h5.incomplete"));
        const auto reader = RecordingReader::open(scratch.path("a.h5.incomplete"));
        ASSERT_TRUE(reader) << reader.error().text();
        EXPECT_FALSE(reader->whole());
        EXPECT_THAT(reader->cut_sentence(), HasSubstr("was cut off"));
        const std::int64_t known = plain.events[100'000 / flush * flush - 1].at + 1;
        EXPECT_EQ(reader->known_to(), Instant{known});
        for (std::size_t i = 0; i < plain.head.signals.size(); ++i) {
            auto expected = plain.expected(i);
            std::erase_if(expected, [&](const auto& event) { return event.first >= known; });
            EXPECT_EQ(events_of(*reader, plain.head.signals[i].name), expected) << flush << " " << i;
        }
        const auto data = reader->report();
        ASSERT_TRUE(data) << data.error().text();
        EXPECT_FALSE(data->verdict.ok);
    }
}

// ---- damage

/// Reads a whole recording; returns false if it is damaged. Expects a message from a file that cannot be opened.
bool read_all(const std::string& path) {
    const auto reader = RecordingReader::open(path);
    if (!reader) {
        EXPECT_FALSE(reader.error().message.empty());
        return false;
    }
    bool good = reader->whole();
    for (const RecordedSeries& series : reader->series()) {
        const auto columns = reader->columns(series);
        if (!columns) return false;
        std::vector<double> values(1 << 12);
        for (std::uint64_t from = 0; from < columns->size; from += values.size()) {
            const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(values.size(), columns->size - from));
            good = good && columns->time.read(from, count, values.data()) &&
                   columns->value.read(from, count, values.data());
        }
    }
    return good && reader->report().has_value();
}

void put_bytes(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

TEST(Recording, DamageIsReported) {
    const Scratch scratch;
    const PlainRecording plain = busy(3000);
    ASSERT_TRUE(plain.write(scratch.path("good.h5")));
    ASSERT_TRUE(read_all(scratch.path("good.h5")));
    const std::string good = file_text(scratch.path("good.h5"));
    std::mt19937_64 random(1);
    int unharmed = 0;
    for (int round = 0; round < 400; ++round) {
        std::string bytes = good;
        const std::size_t from = random() % bytes.size(), length = round % 3 == 0 ? 1 : 1 + random() % 64;
        for (std::size_t i = from; i < std::min(bytes.size(), from + length); ++i)
            bytes[i] = static_cast<char>(bytes[i] ^ static_cast<char>(1 + random() % 255));
        put_bytes(scratch.path("bad.h5"), bytes);
        unharmed += read_all(scratch.path("bad.h5"));
    }
    // Unused space may contain any data.
    EXPECT_LT(unharmed, 200);
}

TEST(Recording, TruncationAnywhereIsReported) {
    const Scratch scratch;
    ASSERT_TRUE(busy(3000).write(scratch.path("good.h5")));
    const std::string good = file_text(scratch.path("good.h5"));
    for (std::size_t part = 0; part < 100; ++part) {
        put_bytes(scratch.path("bad.h5"), good.substr(0, good.size() * part / 100));
        EXPECT_FALSE(read_all(scratch.path("bad.h5"))) << part;
    }
}

TEST(Recording, RejectsOtherFiles) {
    const Scratch scratch;
    put_bytes(scratch.path("text"), "G1 X1\n");
    put_bytes(scratch.path("empty"), "");
    put_bytes(scratch.path("head"), std::string("\x89HDF\r\n\x1a\n", 8) + std::string(5000, '\x55'));
    EXPECT_THAT(RecordingReader::open(scratch.path("text")).error().message,
                HasSubstr("does not begin as an HDF5 file"));
    EXPECT_THAT(RecordingReader::open(scratch.path("empty")).error().message, HasSubstr("empty"));
    EXPECT_THAT(RecordingReader::open(scratch.path("head")).error().message, HasSubstr("damaged"));
    EXPECT_EQ(RecordingReader::open(scratch.path("nowhere")).error().kind, ErrorKind::io);
    EXPECT_EQ(RecordingReader::open(scratch.path("")).error().kind, ErrorKind::io) << "a folder";
    auto other = hdf5::Hdf5File::create(scratch.path("other.h5"));
    ASSERT_TRUE(other && other->close());
    EXPECT_THAT(RecordingReader::open(scratch.path("other.h5")).error().message,
                HasSubstr("not a recording of motionrack"));
    const auto of_format = [&](std::int64_t version) {
        auto file = hdf5::Hdf5File::create(scratch.path("version.h5"));
        file->set("/", "format", "motionrack recording");
        file->set("/", "format_version", version);
        EXPECT_TRUE(file->close());
        return RecordingReader::open(scratch.path("version.h5")).error().message;
    };
    EXPECT_EQ(
        of_format(1),
        fmt::format("The recording has format 1, this program reads format 2. It was not read. Take motionrack {}, "
                    "or the version that wrote it.",
                    format_1_version));
    EXPECT_THAT(of_format(recording_format + 1), HasSubstr("or a later one"));
}

TEST(Recording, ReportsWhereItCannotBeCreated) {
    const PlainRecording plain;
    const auto writer = RecordingWriter::create("/nowhere/at/all.h5", plain.head, Instant{0});
    ASSERT_FALSE(writer);
    EXPECT_EQ(writer.error().kind, ErrorKind::io);
    EXPECT_THAT(writer.error().text(), HasSubstr("/nowhere/at/all.h5"));
}

TEST(Recording, ReportsThatTheDiskIsFull) {
    if (::access("/dev/full", W_OK) != 0) GTEST_SKIP();
    const PlainRecording plain = busy(10);
    auto writer = RecordingWriter::create("/dev/full", plain.head, Instant{0});
    if (writer) plain.write(*writer);
    const Result<void> closed = writer ? writer->close(plain.end) : tl::unexpected<Error>(writer.error());
    ASSERT_FALSE(closed);
    EXPECT_EQ(closed.error().kind, ErrorKind::io);
    EXPECT_THAT(closed.error().message, HasSubstr("No space left on device"));
    EXPECT_THAT(closed.error().message, ::testing::Not(HasSubstr("errno")));
}

}  // namespace
}  // namespace motionrack::trace
