// A position sender in virtual time: its words on wires, each complete some time after the reading.
//
//   reading n at n * period ──► under way for the delay ──► NAME.mcbsp (32 bits)
//   NAME.mcbsp_frame changes where the word is the same again
//
// The fault: sender.silent (no word comes while not 0; what is under way is lost).
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
    /// Words that can be under way: the delay is less than so many periods.
    static constexpr std::int64_t max_under_way = 256;

    /// Adds the device `name` and its wires `wires`.mcbsp and `wires`.mcbsp_frame to the kernel, before it starts.
    SerialWordSource(sim::Kernel& kernel, const std::string& name, const std::string& wires,
                     const SerialPositionSource& sender);

    sim::DeviceId id() const { return id_; }
    /// The last complete word.
    std::int32_t word() const { return static_cast<std::int32_t>(state_.word); }
    static std::span<const std::string_view> fault_names();

    void on_scheduled(Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    bool fault(std::string_view name, double value, Instant now) override;

  private:
    struct State {
        std::int64_t read = 0, sent = 0;  ///< readings made, and those whose words are complete
        std::int64_t word = 0, frame = 0, silent = 0;
        std::array<std::int64_t, max_under_way> words{};  ///< of reading n at n % max_under_way
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
