// The two outputs of one axis to listeners, rotor and encoder, with their watched ranges.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/sim/listeners.hpp>
#include <motionrack/sim/parts/encoder.hpp>
#include <motionrack/sim/parts/pulse_input.hpp>

namespace motionrack::parts {

class MechanicsFaces {
  public:
    enum MechanicsAdapter : int { rotor_face, encoder_face, face_count };
    struct Watch {
        Range counts;  ///< requested by the listener
        Range rotor;   ///< the same, in microsteps
    };
    using Watches = std::array<std::array<Watch, sim::PositionFunction::max_listeners>, face_count>;

    /// `watches`: part of the axis' state, which must outlive this.
    MechanicsFaces(const PulseInput& input, const Encoder& encoder, Watches& watches)
        : input_(input), encoder_(encoder), watches_(watches) {}

    std::int64_t count_at(MechanicsAdapter face, Instant t) const;
    double rate_at(MechanicsAdapter face, Instant t) const;
    int add_listener(MechanicsAdapter face, sim::PositionListener& listener) { return listeners_[face].add(listener); }
    void watch(MechanicsAdapter face, int slot, Range counts, Instant now);

    /// Notifies all listeners that the rotor's rate was `before` and is `rate` from now on, microsteps/s.
    void notify_rate(double before, double rate, Instant now) const;
    /// Notifies the listeners whose range the rotor has left.
    void check(std::int64_t rotor, Instant now);
    /// Calls `add` with the rotor range of each watch.
    template <class Add>
    void add_ranges(Add add) const {
        for (int face = 0; face < face_count; ++face)
            for (int i = 0; i < listeners_[face].size(); ++i) add(watches_[face][i].rotor);
    }
    /// Computes the rotor ranges of the encoder's watches after a change of the count.
    void renew_encoder_ranges(std::int64_t rotor);

  private:
    const PulseInput& input_;
    const Encoder& encoder_;
    Watches& watches_;
    std::array<sim::Listeners, face_count> listeners_;
};

}  // namespace motionrack::parts
