// Computes the outputs of both heads from the positions of a block: transform, correction, flags, heads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/cards/rtc5/model/connections.hpp>
#include <motionrack/cards/rtc5/model/fly_correction.hpp>
#include <motionrack/cards/rtc5/model/head_transforms.hpp>
#include <motionrack/cards/rtc5/model/signal_recorder.hpp>
#include <motionrack/cards/rtc5/model/wobbel_motion.hpp>

namespace motionrack::rtc5 {

class OutputPipeline {
  public:
    /// `output` (of the last tick), `p` (before the correction) and `tick`: parts of the card's state, which must
    /// outlive this.
    OutputPipeline(HeadOutput& output, const Point& p, const std::int64_t& tick, const WobbelMotion& wobbel,
                   FlyCorrection& fly, HeadTransforms& heads, SignalRecorder& recorder, BlockBuffers& buffers)
        : output_(output),
          p_(p),
          tick_(tick),
          wobbel_(wobbel),
          fly_(fly),
          heads_(heads),
          recorder_(recorder),
          buffers_(buffers) {}

    /// Computes the outputs of n ticks and passes them to `sink`; without a sink it computes only flags and recordings.
    void run(std::size_t n, Sink* sink);
    /// Skips ticks that set no flag; `extent`: extent of their corrected positions, bits.
    void skip(const PlanExtent& extent) {
        extent_.take(extent);
        evaluated_ = false;
    }
    /// Computes the output of the last tick if it was skipped.
    void evaluate();
    const HeadOutput& output() const { return output_; }
    /// Returns the extent of the corrected positions (bits, before clipping) while a correction was on, since
    /// clear_extent(). It gives a job's margin in the field and is not part of the state.
    const PlanExtent& extent() const { return extent_; }
    void clear_extent() { extent_ = {}; }

  private:
    void keep_output(std::size_t n);

    HeadOutput& output_;
    const Point& p_;
    const std::int64_t& tick_;
    const WobbelMotion& wobbel_;
    FlyCorrection& fly_;
    HeadTransforms& heads_;
    SignalRecorder& recorder_;
    BlockBuffers& buffers_;
    PlanExtent extent_;
    bool evaluated_ = true;  // the output of the last tick has been computed
};

}  // namespace motionrack::rtc5
