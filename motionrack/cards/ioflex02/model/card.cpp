// Time and wires: the start of the project, and the sample of each change.
#include <algorithm>
#include <motionrack/cards/ioflex02/model/card.hpp>
#include <motionrack/sim/held_outputs.hpp>

namespace motionrack::ioflex02 {

void begin_project(State& state, Instant at, std::int64_t done) {
    state.origin = at;
    state.cleared = 0;
    state.captured = {};
    state.axis = 0;
    for (std::size_t i = 0; i < axis_count; ++i) begin_axis(state.axes[i], state.configuration.modes[i], done);
}

void catch_up(State& state, Instant now, bool access) {
    const Configuration& c = state.configuration;
    if (c.array == ArrayState::starting) step_array(state, ArrayEvent::time, {.now = now});
    if (c.array != ArrayState::running || !c.known) return;
    const std::int64_t last = access ? now / sample_time : sample_from(now) - 1;
    for (EncoderAxisState& axis : state.axes) advance(axis, last);
}

Card::Card(sim::Kernel& kernel, const std::string& name, const Settings& settings)
    : kernel_(kernel), settings_(settings) {
    MOTIONRACK_ASSERT(check(settings).has_value());
    static_assert(std::size(map::pins) == line_pins + input_pins + output_pins);
    id_ = kernel.add(*this, sim::Phase::cards, name);
    for (std::size_t i = 0; i < wires_.size(); ++i) {
        const PinInfo& pin = map::pins[i];
        const auto same =
            pin.same_as.empty() ? sim::WireId::none : kernel.find_wire(name + "." + std::string(pin.same_as));
        wires_[i] = kernel.add_wire(name + "." + std::string(pin.name), 0, 1, same);
        if (i < line_pins) kernel.listen(wires_[i], id_, static_cast<int>(i));
    }
    kernel.schedule(id_, Instant{0});
    if (settings.preloaded) preload(settings.image.empty() ? *raw_image({}) : settings.image);
}

/// State of the wires at power-up.
void Card::begin() {
    if (state_.begun) return;
    state_.begun = 1;
    const Configuration& c = state_.configuration;
    if (c.error == CfgError::unknown_project) report(CardCondition::unknown_project, c.header.ident());
    for (std::size_t i = 0; i < line_pins; ++i) {
        kernel_.subscribe(wires_[i], id_, true);
        state_.axes[i % axis_count].lines[i / axis_count].raw = kernel_.level(wires_[i]) != 0;
    }
    catch_up(kernel_.now(), false);
}

State Card::seen() const {
    State out = state_;
    ioflex02::catch_up(out, kernel_.now(), true);
    return out;
}

void Card::catch_up(Instant now, bool access) {
    ioflex02::catch_up(state_, now, access);
    report_illegal();
}

void Card::report_illegal() {
    for (std::size_t i = 0; i < axis_count; ++i) {
        EncoderAxisState& axis = state_.axes[i];
        if (axis.illegal == 0 || axis.reported) continue;
        axis.reported = 1;
        report(CardCondition::illegal_transition, static_cast<std::int64_t>(i), axis.illegal_sample * 100);
    }
}

void Card::report(CardCondition code, std::int64_t a, std::int64_t b) {
    kernel_.report(id_, static_cast<std::uint16_t>(code), a, b);
}

void Card::on_scheduled(Instant now) {
    begin();
    catch_up(now, false);
    await_illegal();
}

/// The sample of the present instant ends just after it: until then, a wire may still change for it. Nothing is
/// reported at a sync, so the result does not depend on the division of time.
void Card::await_illegal() {
    if (!has_project()) return;
    std::int64_t next = never.count();
    for (const EncoderAxisState& axis : state_.axes) next = std::min(next, illegal_from(axis, next));
    if (next != never.count()) kernel_.schedule(id_, Instant{next * sample_time.count() + 1});
}

void Card::sync(Instant now) {
    begin();
    catch_up(now, false);
}

void Card::on_wire(int pin, int level, Instant now) {
    begin();
    catch_up(now, false);
    const auto number = static_cast<std::size_t>(pin);
    EncoderAxisState& axis = state_.axes[number % axis_count];
    if (!has_project()) {
        axis.lines[number / axis_count].raw = level != 0;
        return;
    }
    wire_changed(axis, static_cast<int>(number / axis_count), level != 0, sample_from(now));
    await_illegal();
}

bool Card::has_project() const {
    return state_.configuration.array == ArrayState::running && state_.configuration.known != 0;
}

std::uint32_t Card::time() const {
    const State now = seen();
    return now.configuration.array == ArrayState::running
               ? static_cast<std::uint32_t>(ticks_at(now, kernel_.now()) - now.cleared) & mask_24
               : 0;
}

/// The host writes the outputs in `mask`.
void Card::put_out(std::uint16_t levels, std::uint16_t mask) {
    const std::uint32_t low = sim::put_unless_held({levels, mask}, state_.outputs, state_.held);
    if (low != 0 && std::exchange(state_.reported_held, 1) == 0) report(CardCondition::outputs_held, low);
    for (std::size_t i = 0; i < 16; ++i) kernel_.set_wire(wires_[line_pins + input_pins + i], state_.outputs >> i & 1);
}

void Card::clear_outputs() {
    const std::uint32_t held = state_.held | state_.outputs;
    put_out(0);
    state_.held = held;
    state_.reported_held = 0;
}

}  // namespace motionrack::ioflex02
