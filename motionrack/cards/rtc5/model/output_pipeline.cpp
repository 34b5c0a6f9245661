// Computes the outputs of blocks, and of the last tick.
#include <motionrack/cards/rtc5/model/output_pipeline.hpp>

namespace motionrack::rtc5 {

void OutputPipeline::run(std::size_t n, Sink* sink) {
    BlockBuffers& b = buffers_;
    heads_.transform_block(n);
    if (fly_.on()) {
        fly_.apply(n);
        extent_.take(fly_.check(n));
    }
    const bool recorded = recorder_.samples_now();
    if (sink == nullptr && !recorded) {
        evaluated_ = false;
        return;
    }
    heads_.run_head(0, n);
    const bool second = heads_.second_head();
    if (second) heads_.run_head(1, n);
    keep_output(n);
    if (recorded) recorder_.record();
    if (sink == nullptr) return;
    const auto ints = [&](std::size_t i) { return std::span<const std::int32_t>(b.out[i].data(), n); };
    sink->samples({tick_, ints(0), ints(1), second ? ints(2) : std::span<const std::int32_t>{},
                   second ? ints(3) : std::span<const std::int32_t>{}, std::span<const std::uint8_t>(b.laser.data(), n),
                   fly_.on() ? std::span<const double>(b.x.data(), n) : std::span<const double>{},
                   fly_.on() ? std::span<const double>(b.y.data(), n) : std::span<const double>{}});
}

/// Stores the output of the last of `n` ticks.
void OutputPipeline::keep_output(std::size_t n) {
    const BlockBuffers& b = buffers_;
    HeadOutput& o = output_;
    o.a = {b.out[0][n - 1], b.out[1][n - 1]};
    o.b = heads_.second_head() ? std::array<std::int32_t, 2>{b.out[2][n - 1], b.out[3][n - 1]}
                               : std::array<std::int32_t, 2>{};
    o.corrected = {b.x[n - 1], b.y[n - 1]};
    o.z = fly_.output_z(n);
    evaluated_ = true;
}

void OutputPipeline::evaluate() {
    if (evaluated_) return;
    BlockBuffers& b = buffers_;
    const Point p = p_ + wobbel_.offset();
    b.x[0] = p.x, b.y[0] = p.y;
    heads_.transform_block(1);
    if (fly_.on()) fly_.apply(1);
    heads_.run_head(0, 1);
    if (heads_.second_head()) heads_.run_head(1, 1);
    keep_output(1);
}

}  // namespace motionrack::rtc5
