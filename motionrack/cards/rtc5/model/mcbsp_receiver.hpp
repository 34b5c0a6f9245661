// The words received over McBSP: in a tick, in blocks, over intervals; where they go and what they mean.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/cards/rtc5/model/block_buffers.hpp>
#include <motionrack/cards/rtc5/model/connections.hpp>
#include <motionrack/cards/rtc5/model/state.hpp>

namespace motionrack::rtc5 {

class McBspReceiver {
  public:
    /// `state`, `fly` (the present correction, which says how a word is read) and `tick`: parts of the card's state,
    /// which must outlive this.
    McBspReceiver(McBsp& state, const Fly& fly, const std::int64_t& tick, const Connections& connections,
                  BlockBuffers& buffers)
        : state_(state), fly_(fly), tick_(tick), connections_(connections), buffers_(buffers) {}

    // ---- running
    /// A word that counts from the next tick on.
    void receive(std::uint32_t word);
    /// Samples the present tick.
    void sample();
    /// Samples from this tick to the last of n.
    void advance(std::int64_t n);
    /// Words of n ticks from now on, to the buffer of words. Returns false if no source of inputs has them.
    bool load_words(std::size_t n);
    /// Values of x and y in n ticks from now on, to the buffer of effective values.
    void load_values(std::size_t n);

    // ---- the present word
    /// x and y
    Point now() const;
    std::int32_t axis_value(std::uint32_t word, bool y) const;
    std::uint32_t word() const { return static_cast<std::uint32_t>(state_.word); }
    std::uint32_t previous() const { return static_cast<std::uint32_t>(state_.previous); }
    /// The last value of a type 0 .. 7.
    std::int32_t typed(int type) const { return state_.typed[static_cast<std::size_t>(type & 7)]; }
    Result<std::int32_t> read(int location) const { return state_.read(location); }
    /// The present word, also copied to location 0. Errors: refused if none has been received.
    Result<std::int32_t> store_now();
    /// Value that set_multi_mcbsp_in puts on the port: that of type 3 (mode 0), or factor * value / 16384 (mode 1).
    std::int64_t power() const;

    // ---- use of the words
    /// Applies set_fly_x_pos, set_fly_y_pos or set_fly_rot_pos to the words that follow.
    void begin_correction();
    /// Applies set_mcbsp_in to the words that follow.
    void begin_axis_correction(int mode);
    /// Applies set_multi_mcbsp_in to the words that follow: each carries its type.
    void begin_typed_words(std::int64_t port, std::int64_t factor, std::int64_t mode);
    bool words_have_types() const { return state_.multi != 0; }
    /// Online positioning by these scales; returns whether it is on then.
    bool begin_positioning(double scale_x, double scale_y, double resolution);
    /// Scales of x, y and the resolution of the present positioning; 0: off.
    std::array<double, 3> positioning_scales() const;
    /// Positioning by matrix coefficients.
    void position_by_matrix() { state_.online_matrix = 1; }
    /// Sets what the words for positioning say of a transform.
    void apply_positioning(Transform& t) const;

  private:
    void take_words();
    void take_word(std::uint32_t word);
    void store_word();
    void end_positioning();

    McBsp& state_;
    const Fly& fly_;
    const std::int64_t& tick_;
    const Connections& connections_;
    BlockBuffers& buffers_;
};

}  // namespace motionrack::rtc5
