// Begins frames, stores their words and ends them.
#include <motionrack/cards/grating_bus/model/frame_assembler.hpp>

namespace motionrack::grating_bus {

namespace {

void put_word(Frame& frame, int k, std::uint32_t address, std::uint32_t count) {
    frame.counts[static_cast<std::size_t>(k)] = count;
    frame.addresses[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(address);
}

}  // namespace

FrameAssembler::FrameAssembler(CardState& state, const CardSettings& settings, ErrorCounters& errors)
    : settings_(settings),
      errors_(errors),
      buffers_(state.buffers),
      bad_(state.bad),
      was_bad_(state.was_bad),
      word_(state.word),
      time_(state.frame_time),
      sequence_(state.frame_sequence),
      bad_word_(state.bad_word),
      other_(state.other),
      was_other_(state.was_other),
      taken_(state.taken),
      published_(state.frames) {}

void FrameAssembler::begin(Instant time, std::uint32_t sequence) {
    time_ = time;
    sequence_ = sequence;
    word_ = 0;
    bad_ = 0;
    bad_word_ = 0;
    other_ = 0;
    taken_ = {};
    buffers_.begin();
}

void FrameAssembler::put(std::uint32_t address, std::uint32_t count) {
    put_word(buffers_.current(), word_, address, count);
}

void FrameAssembler::put_words(const Latched& latched, int words) {
    for (int k = 0; k < words; ++k) {
        const auto address = static_cast<std::uint32_t>(settings_.address(k));
        put_word(buffers_.current(), k, address, latched[address]);
        taken_.add(address);
    }
}

void FrameAssembler::spoil(ErrorCounter why, std::uint8_t bad) {
    if (bad_word_ == 0) errors_.count(why);
    bad_word_ = 1;
    bad_ |= bad;
}

void FrameAssembler::note_other() {
    errors_.count(ErrorCounter::alien);
    if (other_ == 0) other_ = static_cast<std::uint16_t>(1 + word_);
}

bool FrameAssembler::finish(const Frame* like) {
    if (bad_ != 0) {
        give_up(sequence_, bad_);
        return false;
    }
    Frame& frame = buffers_.current();
    frame.time = time_.count();
    frame.sequence = sequence_;
    frame.words = static_cast<std::uint32_t>(settings_.scales);
    const bool known =
        like && like->sequence == frame.sequence && like->time == frame.time && like->words == frame.words;
    frame.crc = known ? like->crc : crc_of(frame);
    if (other_ != 0 && was_other_ == 0) {
        const int word = other_ - 1;
        const std::int64_t address = frame.addresses[static_cast<std::size_t>(word)];
        errors_.report(BusCondition::other_scale, word, address << 8 | settings_.address(word));
    }
    was_other_ = other_;
    return true;
}

void FrameAssembler::give_up(std::uint32_t sequence, std::uint8_t why) {
    buffers_.abandon();
    errors_.count(ErrorCounter::broken);
    if (was_bad_ == 0) errors_.report(BusCondition::bad_frame, sequence, why);
    was_bad_ = 1;
}

const Frame& FrameAssembler::publish() {
    const Frame& frame = buffers_.current();
    was_bad_ = 0;
    buffers_.publish();
    ++published_;
    return frame;
}

}  // namespace motionrack::grating_bus
