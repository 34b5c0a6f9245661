// The virtual IOFLEX02: an array that is loaded with an image and then runs the project "position", exact to the sample
// (RULES.md).
//
//   CONTROL, DATA ──► [ array: image ─► project ]            STATUS, CFG_ERROR, SIGNATURE, SERIAL
//                                │
//   a b z cal (4 axes) ──► [ sample ─► filter ─► count ─► calibrate ] ──┐
//   1.2 us ──────────────► [ time ] ────────────────────────────────────┴─► STROBE ──► TIME, POS, RAW, AGE, ..
//   in0 .. in15: the same 16 lines by number ──► IN
//   OUTL, OUTH ──► out0 .. out15   (out16 .. out31, X7: not driven by this project)
//
// The model neither polls nor schedules: it records a wire's change with its sample, and processes it on demand.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/ioflex02/model/conditions.hpp>
#include <motionrack/cards/ioflex02/model/settings.hpp>
#include <motionrack/cards/ioflex02/model/state.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/register_device.hpp>
#include <string>

namespace motionrack::ioflex02 {

class Card final : public sim::DeferringDevice, public sim::RegisterDevice {
  public:
    /// Adds the card and its wires "<name>.<pin>" to the kernel. `settings` must pass check().
    Card(sim::Kernel& kernel, const std::string& name, const Settings& settings = {});

    // ---- the bus: offsets from the base address
    std::uint16_t read(std::uint32_t offset) override;
    void write(std::uint32_t offset, std::uint16_t value) override;
    std::uint16_t peek(std::uint32_t offset) const override;

    /// Sets all outputs low, without an access of the bus. Each that was high stays low until the host writes it low,
    /// then high.
    void clear_outputs();

    // ---- inspection at the present instant
    bool running() const { return seen().configuration.array == ArrayState::running; }
    ArrayState array() const { return seen().configuration.array; }
    /// Returns the position of an axis, counts: -8,388,608 .. 8,388,607.
    std::int32_t position(int axis) const { return signed24(axis_of(axis).position); }
    /// Counts since the start of the project, unbounded.
    std::int64_t raw_count(int axis) const { return axis_of(axis).raw; }
    tIOFlexSts status(int axis) const { return status_of(axis_of(axis).cal); }
    CalState calibration(int axis) const { return axis_of(axis).cal; }
    std::uint16_t illegal(int axis) const { return axis_of(axis).illegal; }
    /// Returns the card's time in ticks of 1.2 us, 0 .. 16,777,215.
    std::uint32_t time() const;
    const Settings& settings() const { return settings_; }
    sim::DeviceId id() const { return id_; }

    void on_scheduled(Instant now) override;
    void on_wire(int pin, int level, Instant now) override;
    void sync(Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    static constexpr std::size_t line_pins = line_count * axis_count, input_pins = 16, output_pins = 32;

    void begin();
    State seen() const;
    EncoderAxisState axis_of(int axis) const { return seen().axes[static_cast<std::size_t>(axis)]; }
    void catch_up(Instant now, bool access);
    void report_illegal();
    void await_illegal();
    void report(CardCondition code, std::int64_t a = 0, std::int64_t b = 0);
    void put_out(std::uint16_t levels, std::uint16_t mask = 0xFFFF);
    bool has_project() const;

    // configuration.cpp
    void control(std::uint16_t word);
    void take_word(std::uint16_t word);
    void take_byte(std::uint8_t byte);
    void refuse(CfgError error);
    void accept();
    void preload(std::span<const std::uint8_t> image);

    // registers.cpp
    std::uint16_t word(const State& state, std::uint32_t offset) const;
    std::uint16_t project_word(const State& state, std::uint32_t offset) const;
    void write_project(std::uint32_t offset, std::uint16_t value);
    void strobe(std::uint16_t word);

    sim::Kernel& kernel_;
    Settings settings_;
    sim::DeviceId id_{};
    std::array<sim::WireId, line_pins + input_pins + output_pins> wires_{};
    State state_{};
};

/// Events of the array's states: CONFIGURE; a refused image (END too early, or a flaw); the last byte of a valid image;
/// a check whether the configuration time has passed.
enum class ArrayEvent : std::uint8_t { configure, refused, complete, time };
struct ArrayChange {
    Instant now{};
    Duration configuration_time{};    ///< with complete
    CfgError error = CfgError::none;  ///< with refused
};
/// Executes the array's state table; returns false if the event has no effect.
bool step_array(State& state, ArrayEvent event, const ArrayChange& change);
/// Starts the project at `at` with all counts and the time at 0.
void begin_project(State& state, Instant at, std::int64_t done);
/// The first sample at or after `t` (t >= 0).
inline std::int64_t sample_from(Instant t) {
    return (t.count() + sample_time.count() - 1) / sample_time.count();
}
/// Processes the changes up to `now`; `access`: including the sample at this very instant.
void catch_up(State& state, Instant now, bool access);
/// Ticks of 1.2 us since the start of the project.
inline std::int64_t ticks_at(const State& state, Instant t) {
    return (t - state.origin) / time_tick;
}

}  // namespace motionrack::ioflex02
