// A thread of Cyclone DDS writes samples with their reception time to a ring buffer; the polling thread validates them.
#include <algorithm>
#include <condition_variable>
#include <motionrack/dds/clock.hpp>
#include <motionrack/dds/subscriber.hpp>
#include <motionrack/dds/wire.hpp>
#include <mutex>
#include <vector>

namespace motionrack::dds {

namespace {

class NetworkSubscriber final : public Subscriber {
  public:
    explicit NetworkSubscriber(const SubscriberSettings& settings)
        : Subscriber(settings.judge), ring_(std::max<std::size_t>(settings.queue, 1)) {}

    Result<void> start(const SubscriberSettings& settings) {
        dds_entity_t participant = settings.participant;
        if (participant == 0) {
            MOTIONRACK_TRY(own_, join(settings.bus, settings.domain));
            participant = own_.get();
        }
        topic_ = Entity(dds_create_topic(participant, &motionrack_dds_WireSample_desc, topic_name, nullptr, nullptr));
        if (topic_.get() < 0) return engine_error("The frames' topic could not be created", topic_.get());
        const Qos qos = qos_of(settings.bus, settings.other_participants_only);
        const std::unique_ptr<dds_listener_t, void (*)(dds_listener_t*)> listener(dds_create_listener(this),
                                                                                  dds_delete_listener);
        dds_lset_data_available(listener.get(), [](dds_entity_t reader, void* self) {
            static_cast<NetworkSubscriber*>(self)->receive(reader);
        });
        reader_ = Entity(dds_create_reader(participant, topic_.get(), qos.get(), listener.get()));
        if (reader_.get() < 0) return engine_error("Frames cannot be received", reader_.get());
        return {};
    }

    Instant poll(const Use& use) override {
        const Instant now = monotonic_now();
        for (Slot slot; next(slot);) {
            // Cyclone DDS receives with several threads, so a time stamp may be slightly before the previous one.
            last_ = std::max(last_, slot.received);
            const Validation verdict = judge_.take(slot.sample, last_);
            if (use) use(slot.sample, verdict, last_);
        }
        last_ = std::max(last_, now);
        judge_.poll(last_);
        return last_;
    }

    bool wait(Duration timeout) override {
        std::unique_lock lock(mutex_);
        arrived_.wait_for(lock, std::chrono::duration_cast<std::chrono::nanoseconds>(timeout),
                          [this] { return count_ > 0; });
        return count_ > 0;
    }

    std::uint64_t overruns() const override {
        const std::lock_guard lock(mutex_);
        return overruns_;
    }

  private:
    struct Slot {
        Sample sample;
        Instant received{};
    };

    void receive(dds_entity_t reader) {
        const Instant now = monotonic_now();
        const std::lock_guard lock(mutex_);
        for (;;) {
            void* data = &buffer_.wire();
            dds_sample_info_t info;
            if (dds_take(reader, &data, &info, 1, 1) <= 0) break;
            if (!info.valid_data) continue;
            if (count_ == ring_.size()) {
                first_ = (first_ + 1) % ring_.size();
                --count_;
                ++overruns_;
            }
            Slot& slot = ring_[(first_ + count_++) % ring_.size()];
            buffer_.get(slot.sample);
            slot.received = now;
        }
        arrived_.notify_one();
    }

    bool next(Slot& slot) {
        const std::lock_guard lock(mutex_);
        if (count_ == 0) return false;
        slot = ring_[first_];
        first_ = (first_ + 1) % ring_.size();
        --count_;
        return true;
    }

    mutable std::mutex mutex_;
    std::condition_variable arrived_;
    WireBuffer buffer_;
    std::vector<Slot> ring_;
    std::size_t first_ = 0, count_ = 0;
    std::uint64_t overruns_ = 0;
    Instant last_{};
    // These members are destroyed first: the threads of Cyclone DDS end before the data that they use.
    Entity own_, topic_, reader_;
};

}  // namespace

Result<std::unique_ptr<Subscriber>> Subscriber::open(const SubscriberSettings& settings) {
    MOTIONRACK_CHECK(check_bus_name(settings.bus));
    auto made = std::make_unique<NetworkSubscriber>(settings);
    MOTIONRACK_CHECK(made->start(settings));
    return made;
}

}  // namespace motionrack::dds
