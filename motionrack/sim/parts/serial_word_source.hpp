// A serial position source in virtual time: its words on wires, each complete some time after the sample.
//
//   sample n at n * period ──► in transit for the delay ──► NAME.mcbsp (32 bits)
//   NAME.mcbsp_frame changes if the word repeats
//
// Fault: sender.silent (no words while not 0; words in transit are lost).
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/parts/serial_position_source.hpp>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::parts {

class SerialWordSource final : public sim::Device {
  public:
    /// Maximum words in transit: the delay is less than this number of periods.
    static constexpr std::int64_t max_under_way = 256;

    /// Adds the device `name` and its wires `wires`.mcbsp and `wires`.mcbsp_frame to the kernel before it starts.
    SerialWordSource(sim::Kernel& kernel, const std::string& name, const std::string& wires,
                     const SerialPositionSource& sender);

    sim::DeviceId id() const { return id_; }
    /// The last complete word.
    std::int32_t word() const { return static_cast<std::int32_t>(state_.word); }

    void on_scheduled(Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    bool fault(std::string_view name, double value, Instant now) override;

  private:
    struct State {
        std::int64_t read = 0, sent = 0;  ///< samples taken, and samples with complete words
        std::int64_t word = 0, frame = 0, silent = 0;
        std::array<std::int64_t, max_under_way> words{};  ///< word of sample n at n % max_under_way
    };
    Instant reading(std::int64_t n) const;
    void schedule();

    sim::Kernel& kernel_;
    SerialPositionSource sender_;
    double period_ticks_;
    Duration delay_;
    sim::DeviceId id_{};
    sim::WireId word_wire_{}, frame_wire_{};
    State state_{};
};

}  // namespace motionrack::parts
