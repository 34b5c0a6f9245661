// Fuzzer of the validator: a stream of numbers becomes valid, nearly valid and invalid samples at any time. It checks
// these invariants after each sample. libFuzzer and the module's own test run it.
//
//   used is sound         a used frame has the right CRCs, the expected N and the source that owns the bus;
//                         the held frame is the one used last
//   all is counted        every sample is in one count
//   one bus, one source   the source changes only when it was silent, and that is counted
//   time                  stale if and only if no frame was used for two paces
//   words                 every event has a printable message
#pragma once

#include <motionrack/dds/test/samples.hpp>
#include <motionrack/sim/test/fuzz_feed.hpp>
#include <string>

namespace motionrack::dds::fuzz {

using motionrack::fuzz::Feed;

class Run {
  public:
    explicit Run(Feed& feed) : feed_(feed), judge_({static_cast<int>(feed.below(3) * 3), milliseconds(200)}) {}

    /// Validates up to `samples` samples, fewer if the feed ends; returns "" or the violated invariant.
    std::string go(int samples) {
        for (int i = 0; i < samples && problem_.empty() && !feed_.empty(); ++i) step();
        return problem_;
    }
    const FrameValidator& judge() const { return judge_; }

  private:
    void must(bool holds, const char* what) {
        if (!holds && problem_.empty()) problem_ = what;
    }

    std::uint64_t wide() {
        std::uint64_t out = 0;
        for (int i = 0; i < 4; ++i) out = out << 16 | feed_.word();
        return out;
    }

    Sample next_sample() {
        const std::uint32_t what = feed_.word();
        PublisherIdentity source =
            source_named(static_cast<std::uint8_t>(1 + what % 3), what % 2 ? "wafer1" : "wafer2");
        number_ += (what >> 2 & 3) == 3 ? feed_.word() - 40 : (what >> 2 & 3);
        Sample out = sample_of(source, number_, 3 + 3 * (what >> 4 & 1));
        if ((what >> 5 & 7) == 0) damage(out);
        if ((what >> 8 & 7) == 0) seal(out);
        return out;
    }

    void damage(Sample& s) {
        switch (feed_.below(9)) {
            case 0:
                s.format = feed_.word();
                break;
            case 1:
                s.frame.words = feed_.word();
                break;
            case 2:
                s.frame.counts[feed_.below(grating_bus::max_scales)] ^= feed_.word();
                break;
            case 3:
                s.frame.time = static_cast<std::int64_t>(wide());
                break;
            case 4:
                s.frame.sequence = static_cast<std::uint32_t>(wide());
                break;
            case 5:
                s.period = static_cast<std::int64_t>(wide());
                break;
            case 6:
                s.pace = static_cast<std::int64_t>(wide());
                break;
            case 7:
                s.source.host[feed_.below(64)] = static_cast<char>(feed_.word());
                break;
            default:
                s.source.id[feed_.below(16)] = static_cast<std::uint8_t>(feed_.word());
                break;
        }
    }

    void step() {
        now_ += Duration{feed_.word() * (feed_.below(8) == 0 ? 40'000 : 40)};
        if (feed_.below(4) == 0)
            judge_.poll(now_);
        else
            take(next_sample());
        if (judge_.joined())
            must(!judge_.stale() == (now_ - used_at_ <= 2 * judge_.pace()),
                 "it is stale two paces after the last frame");
        for (BusEvent event; judge_.next_event(event);)
            for (const char c : sentence(event)) must(c >= ' ' && c <= '~', "a sentence can be printed");
        const Counts& c = judge_.counts();
        must(c.received == c.used + c.duplicates + c.late + c.jumps + c.wrong_crc + c.foreign + c.malformed +
                               c.wrong_words + c.other_source,
             "every sample is counted once");
        must(judge_.others().size() <= FrameValidator::max_others, "a few others are kept");
    }

    void take(const Sample& sample) {
        const bool had = judge_.joined();
        const PublisherIdentity before = judge_.source();
        const Frame held = judge_.frame();
        const Counts then = judge_.counts();
        const Validation verdict = judge_.take(sample, now_);
        const Counts& c = judge_.counts();
        if (verdict != Validation::used) {
            must(same(judge_.frame(), held), "what is not used is not held");
            must(!had || judge_.source() == before, "who is not used does not get the bus");
            return;
        }
        used_at_ = now_;
        must(sample.format == wire_format && sound(sample.frame) && sample.check == check_of(sample),
             "only what is sound is used");
        must(same(judge_.frame(), sample.frame) && judge_.source() == sample.source, "what is used is held");
        const bool handed = had && !(sample.source == before);
        must(c.restarts + c.takeovers == then.restarts + then.takeovers + (handed ? 1 : 0),
             "a change of source is counted");
        if (handed) must(c.lost == then.lost, "nothing is lost between two sources");
    }

    Feed& feed_;
    FrameValidator judge_;
    Instant now_{}, used_at_{};
    std::uint32_t number_ = 0;
    std::string problem_;
};

}  // namespace motionrack::dds::fuzz
