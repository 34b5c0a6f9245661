// Edges of rotor and encoder.
#include <algorithm>
#include <limits>
#include <motionrack/sim/parts/edge_generator.hpp>

namespace motionrack::parts {

void EdgeGenerator::pass(const Encoder& encoder, const Listeners& listeners, const sim::EdgeBatch& batch,
                         std::int64_t first, std::uint32_t size) {
    const sim::EdgeBatch* rotor = &batch;
    if (first != batch.first_count || size != batch.size) {
        copy_.origin = batch.origin;
        copy_.tick = batch.tick;
        copy_.first_count = first;
        copy_.step = batch.step;
        copy_.size = size;
        std::copy_n(batch.at.begin(), size, copy_.at.begin());
        rotor = &copy_;
    }
    if (listeners[MechanicsFaces::rotor_face]) listeners[MechanicsFaces::rotor_face]->edges(*rotor);
    if (!listeners[MechanicsFaces::encoder_face]) return;
    if (encoder.transparent())
        listeners[MechanicsFaces::encoder_face]->edges(*rotor);
    else
        turn(*listeners[MechanicsFaces::encoder_face], encoder, *rotor, first, size);
}

void EdgeGenerator::turn(sim::EdgeListener& listener, const Encoder& encoder, const sim::EdgeBatch& batch,
                         std::int64_t first, std::uint32_t size) {
    out_.size = 0;
    out_.tick = batch.tick;
    origin_ = batch.origin;
    const std::int64_t num = encoder.ratio_num();
    const std::int64_t den = encoder.ratio_den();
    std::int64_t disc = encoder.disc(first - batch.step);
    // The rotor within its count: remainder of rotor * num / den, 0 .. den-1.
    std::int64_t rest = static_cast<std::int64_t>(Wide{first - batch.step} * num - Wide{disc} * den);
    count_ = encoder.seen(disc);
    std::int64_t last = ceil_div((last_ - origin_).count(), batch.tick.count());
    for (std::uint32_t i = 0; i < size; ++i) {
        const std::int64_t at = batch.at[i];
        rest += batch.step * num;
        std::int64_t counts = 0;  // counts of the disc for this microstep
        for (; rest >= den; rest -= den) ++counts;
        for (; rest < 0; rest += den) ++counts;
        if (counts == 0) continue;
        const std::int64_t apart = counts == 1 ? 0 : std::clamp<std::int64_t>((at - last) / counts, 0, spacing);
        for (std::int64_t j = counts - 1; j >= 0; --j) {
            disc += batch.step;
            add(listener, at - j * apart, encoder.seen(disc));
        }
        last = at;
    }
    last_ = batch.origin + batch.tick * batch.at[size - 1];
    flush(listener);
}

void EdgeGenerator::add(sim::EdgeListener& listener, std::int64_t at, std::int64_t count) {
    const std::int64_t step = count - count_;
    if (step == 0) return;
    if (out_.size == out_.capacity ||
        (out_.size > 0 && (step != out_.step || at - base_ > std::numeric_limits<std::uint32_t>::max())))
        flush(listener);
    if (out_.size == 0) {
        base_ = at;
        out_.origin = origin_ + out_.tick * at;
        out_.first_count = count;
        out_.step = static_cast<int>(step);
    }
    out_.at[out_.size++] = static_cast<std::uint32_t>(at - base_);
    count_ = count;
}

void EdgeGenerator::flush(sim::EdgeListener& listener) {
    if (out_.size > 0) listener.edges(out_);
    out_.size = 0;
}

void EdgeGenerator::jump(const Encoder& encoder, const Listeners& listeners, Instant now, std::int64_t from,
                         std::int64_t to) {
    while (from != to) {
        const int step = to > from ? 1 : -1;
        copy_.origin = now;
        copy_.tick = Duration{1};
        copy_.first_count = from + step;
        copy_.step = step;
        copy_.size = static_cast<std::uint32_t>(std::min<std::int64_t>((to - from) * step, sim::EdgeBatch::capacity));
        std::fill_n(copy_.at.begin(), copy_.size, 0u);
        pass(encoder, listeners, copy_, copy_.first_count, copy_.size);
        from += step * static_cast<std::int64_t>(copy_.size);
    }
}

void EdgeGenerator::count_jump(sim::EdgeListener& listener, Instant now, std::int64_t from, std::int64_t to) {
    out_.size = 0;
    out_.tick = Duration{1};
    origin_ = now;
    count_ = from;
    const int step = to > from ? 1 : -1;
    while (count_ != to) add(listener, 0, count_ + step);
    flush(listener);
}

}  // namespace motionrack::parts
