// Publishes on the network by a DDS writer, and detects other publishers by a reader that ignores its own participant.
#include <fmt/format.h>

#include <motionrack/dds/clock.hpp>
#include <motionrack/dds/publisher.hpp>
#include <motionrack/dds/subscriber.hpp>
#include <motionrack/dds/wire.hpp>

namespace motionrack::dds {

namespace {

Result<void> check_time(const char* what, Duration time) {
    if (time >= shortest_period && time <= max_period) return {};
    return fail(ErrorKind::invalid_input,
                fmt::format("The {} of the frames is {:g} us, but must be {:g} us to {:g} s. Nothing was published.",
                            what, to_seconds(time) * 1e6, to_seconds(shortest_period) * 1e6, to_seconds(max_period)));
}

class NetworkPublisher final : public Publisher {
  public:
    Result<void> start(const PublisherSettings& settings) {
        source_ = new_source();
        sample_.source = source_;
        sample_.period = settings.period.count();
        sample_.pace = settings.pace.count();
        MOTIONRACK_TRY(participant_, join(settings.bus, settings.domain));
        topic_ =
            Entity(dds_create_topic(participant_.get(), &motionrack_dds_WireSample_desc, topic_name, nullptr, nullptr));
        if (topic_.get() < 0) return engine_error("The frames' topic could not be created", topic_.get());
        const Qos qos = qos_of(settings.bus, false);
        writer_ = Entity(dds_create_writer(participant_.get(), topic_.get(), qos.get(), nullptr));
        if (writer_.get() < 0) return engine_error("Frames cannot be published", writer_.get());
        SubscriberSettings others;
        others.bus = settings.bus;
        others.domain = settings.domain;
        others.other_participants_only = true;
        others.participant = participant_.get();
        others.queue = 64;
        MOTIONRACK_TRY(others_, Subscriber::open(others));
        return {};
    }

    bool publish(const Frame& frame) override {
        if (!sound(frame)) {
            ++unsound_;
            return false;
        }
        sample_.frame = frame;
        sample_.check = check_of(sample_);
        buffer_.put(sample_);
        const bool good = dds_write(writer_.get(), &buffer_.wire()) == DDS_RETCODE_OK;
        ++(good ? sent_ : refused_);
        return good;
    }

    void poll() override {
        const Instant now = others_->poll([this](const Sample& other, Validation verdict, Instant received) {
            if (verdict == Validation::wrong_crc || verdict == Validation::foreign || verdict == Validation::malformed)
                return;
            ++foreign_frames_;
            heard_ = received;
            if (in_conflict_ && other.source == other_) return;
            in_conflict_ = true;
            other_ = other.source;
            events_.put({EventKind::conflict, received, source_, other_, foreign_frames_, 0, ++conflicts_});
        });
        if (in_conflict_ && now - heard_ > std::max(ValidatorSettings{}.release, Duration{2 * sample_.pace})) {
            in_conflict_ = false;
            events_.put({EventKind::conflict_over, now, source_, other_, foreign_frames_, 0, conflicts_});
        }
    }

    bool next_event(BusEvent& event) override { return events_.take(event); }

  private:
    Sample sample_;
    WireBuffer buffer_;
    EventQueue events_;
    bool in_conflict_ = false;
    PublisherIdentity other_;
    Instant heard_{};
    std::uint64_t conflicts_ = 0;
    Entity participant_, topic_, writer_;
    std::unique_ptr<Subscriber> others_;
};

}  // namespace

Result<std::unique_ptr<Publisher>> Publisher::open(const PublisherSettings& settings) {
    MOTIONRACK_CHECK(check_bus_name(settings.bus));
    MOTIONRACK_CHECK(check_time("period", settings.period));
    MOTIONRACK_CHECK(check_time("pace", settings.pace));
    auto made = std::make_unique<NetworkPublisher>();
    MOTIONRACK_CHECK(made->start(settings));
    return made;
}

}  // namespace motionrack::dds
