// A publisher for tests, whose positions contain the number of their frame:
//
//   dds_test_publisher good BUS PERIOD_US SCALES OFFSET   frames, each at its time: count k of frame n is
//                                                         OFFSET + 1000 n + k
//   dds_test_publisher bad BUS                            invalid samples, one of each kind in turn
//
// Prints its events and the number of sent frames as lines of JSON; runs until it is killed.
#include <cstdio>
#include <cstdlib>
#include <motionrack/dds/clock.hpp>
#include <motionrack/dds/frame_publisher.hpp>
#include <motionrack/dds/wire.hpp>
#include <nlohmann/json.hpp>
#include <string>

using namespace motionrack;

namespace {

class Counting final : public dds::FrameSource {
  public:
    Counting(Duration period, std::uint32_t scales, std::uint32_t offset)
        : period_(period), scales_(scales), offset_(offset) {}
    Result<bool> next(dds::Frame& frame) override {
        frame.sequence = number_;
        frame.time = (milliseconds(1) + std::int64_t{number_} * period_).count();
        frame.words = scales_;
        for (std::uint32_t k = 0; k < scales_; ++k) {
            frame.counts[k] = offset_ + number_ * 1000 + k;
            frame.addresses[k] = static_cast<std::uint8_t>(k);
        }
        frame.crc = crc_of(frame);
        ++number_;
        return true;
    }

  private:
    Duration period_;
    std::uint32_t scales_, offset_, number_ = 0;
};

void print(const nlohmann::json& line) {
    std::printf("%s\n", line.dump().c_str());
    std::fflush(stdout);
}

int wrong(const std::string& what) {
    std::fprintf(stderr, "dds_test_publisher: %s\n", what.c_str());
    return 1;
}

int publish_good(const std::string& bus, Duration period, std::uint32_t scales, std::uint32_t offset) {
    const auto publisher = dds::Publisher::open({bus, 0, period, period});
    if (!publisher) return wrong(publisher.error().text());
    Counting source(period, scales, offset);
    dds::PublishingSettings settings;
    settings.pace = period;
    settings.report = [](const dds::BusEvent& event) {
        print({{"event", name_of(event.kind)},
               {"source", event.source.id_text()},
               {"other", event.other.id_text()},
               {"text", sentence(event)}});
    };
    settings.progress = [&publisher](std::uint64_t sent, Duration) {
        if (sent == 1 || sent % 100 == 0) print({{"sent", sent}, {"id", (*publisher)->source().id_text()}});
    };
    const auto done = publish_frames(**publisher, source, settings);
    return done ? 0 : wrong(done.error().text());
}

/// Returns a sample with one error, selected by the number.
dds::Sample bad_sample(const dds::PublisherIdentity& source, std::uint32_t number) {
    dds::Sample sample;
    sample.source = source;
    sample.period = sample.pace = milliseconds(2).count();
    sample.frame.sequence = number;
    sample.frame.words = 4;
    sample.frame.crc = crc_of(sample.frame);
    sample.check = check_of(sample);
    switch (number % 5) {
        case 0:
            sample.frame.crc ^= 1;
            break;
        case 1:
            sample.frame.counts[2] ^= 0x100;
            break;
        case 2:
            sample.format = 7;
            break;
        case 3:
            sample.frame.words = 0;
            break;
        default:
            sample.pace = -1;
            sample.check = check_of(sample);
    }
    return sample;
}

int publish_bad(const std::string& bus) {
    const auto participant = dds::join(bus, 0);
    if (!participant) return wrong(participant.error().text());
    const dds::Entity topic(
        dds_create_topic(participant->get(), &motionrack_dds_WireSample_desc, dds::topic_name, nullptr, nullptr));
    const dds::Qos qos = dds::qos_of(bus, false);
    const dds::Entity writer(dds_create_writer(participant->get(), topic.get(), qos.get(), nullptr));
    if (writer.get() < 0) return wrong("no writer");
    const dds::PublisherIdentity source = dds::new_source();
    dds::WireBuffer buffer;
    for (std::uint32_t number = 0;; ++number) {
        buffer.put(bad_sample(source, number));
        dds_write(writer.get(), &buffer.wire());
        dds::sleep_until(dds::monotonic_now() + milliseconds(5));
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "";
    if (what == "bad" && argc == 3) return publish_bad(argv[2]);
    if (what != "good" || argc != 6) return wrong("good BUS PERIOD_US SCALES OFFSET, or bad BUS");
    return publish_good(argv[2], microseconds(std::atoll(argv[3])), static_cast<std::uint32_t>(std::atoi(argv[4])),
                        static_cast<std::uint32_t>(std::atoi(argv[5])));
}
