// Receiver of McBSP words (serial position data): stores them in the memory locations and decodes their values.
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
    /// Keeps `state`, `fly` (the present correction, which determines how a word is read) and `tick`: parts of the
    /// card's state, which must outlive this.
    McBspReceiver(McBsp& state, const Fly& fly, const std::int64_t& tick, const Connections& connections,
                  BlockBuffers& buffers)
        : state_(state), fly_(fly), tick_(tick), connections_(connections), buffers_(buffers) {}

    // ---- running
    /// Receives a word, which is valid from the next tick on.
    void receive(std::uint32_t word);
    /// Reads the words of the present tick.
    void sample();
    /// Reads the words from the present tick to the last of the `n` ticks that begin with it.
    void advance(std::int64_t n);
    /// Writes the words of the next `n` ticks, the present one first, to the buffer of words. Returns false if no
    /// source of inputs has them.
    bool load_words(std::size_t n);
    /// Writes x and y of the next `n` ticks, the present one first, to the buffer of effective values.
    void load_values(std::size_t n);

    // ---- the present word
    /// Returns x and y of the present word, or of the last words of type 0 and 1 while words carry their type.
    Point now() const;
    std::int32_t axis_value(std::uint32_t word, bool y) const;
    std::uint32_t word() const { return static_cast<std::uint32_t>(state_.word); }
    std::uint32_t previous() const { return static_cast<std::uint32_t>(state_.previous); }
    /// Returns the value of the last word of a type 0 .. 7: 29 bits, signed.
    std::int32_t typed(int type) const { return state_.typed[static_cast<std::size_t>(type & 7)]; }
    Result<std::int32_t> read(int location) const { return state_.read(location); }
    /// Returns the present word and copies it to location 0. Errors: refused if none has been received.
    Result<std::int32_t> store_now();
    /// Returns the value that set_multi_mcbsp_in outputs at the port: that of type 3 (mode 0), or
    /// factor * value / 16384 (other modes).
    std::int64_t power() const;

    // ---- use of the words
    /// Applies set_fly_x_pos, set_fly_y_pos or set_fly_rot_pos to the words that follow.
    void begin_correction();
    /// Applies set_mcbsp_in to the words that follow.
    void begin_axis_correction(int mode);
    /// Applies set_multi_mcbsp_in to the words that follow: each carries its type.
    void begin_typed_words(std::int64_t port, std::int64_t factor, std::int64_t mode);
    bool words_have_types() const { return state_.multi != 0; }
    /// Starts online positioning with these scales; returns false if all are off (scale 0, resolution below 100).
    bool begin_positioning(double scale_x, double scale_y, double resolution);
    /// Returns the scales of x and y and the resolution of online positioning; 0: off.
    std::array<double, 3> positioning_scales() const;
    /// Reads the words of online positioning as matrix coefficients.
    void position_by_matrix() { state_.online_matrix = 1; }
    /// Sets the offset, angle or matrix coefficient of a transform from the words for online positioning.
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
