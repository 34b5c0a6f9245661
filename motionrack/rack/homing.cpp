// Homes several axes in one loop that checks them all every millisecond.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/card_types.hpp>
#include <motionrack/rack/homing.hpp>
#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

namespace {

constexpr Duration sample_period = milliseconds(1);
constexpr std::size_t max_samples = 200'000;

/// Returns the number of the input, among `pins` of the axis' channel, to which `end` of the axis is wired; -1 if none.
int input_of(const RackConfig& config, const RackAxis& axis, std::string_view end,
             std::span<const std::string_view> pins) {
    for (const RackWire& wire : config.wires) {
        if (wire.from.owner != EndOwner::axis ||
            config.axes[static_cast<std::size_t>(wire.from.index)].letter != axis.letter)
            continue;
        if (wire.from.pin != end || wire.to.owner != EndOwner::card) continue;
        if (config.cards[static_cast<std::size_t>(wire.to.index)].name != axis.card) continue;
        for (std::size_t i = 0; i < pins.size(); ++i)
            if (wire.to.pin == axis.channel + std::string(pins[i])) return static_cast<int>(i);
    }
    return -1;
}

/// Returns "xin0, xin1" of card motion.
std::string inputs_text(const RackAxis& axis, std::span<const std::string_view> pins) {
    std::string out;
    for (const std::string_view pin : pins) out += (out.empty() ? "" : ", ") + axis.channel + std::string(pin);
    return fmt::format("{} of card {}", out, axis.card);
}

class Homing {
  public:
    Homing(Rack& rack, const HomingSettings& settings) : rack_(rack), settings_(settings) {}

    HomingOutcome run() {
        out_.ended = choose();
        if (!out_.ended) return std::move(out_);  // nothing was changed
        StopLatch& latch = rack_.stop_latch();
        const bool armed = latch.armed();
        if (!armed) latch.arm();
        home_all();
        report_stop();
        if (!armed) latch.disarm();
        gather();
        return std::move(out_);
    }

  private:
    void home_all() {
        out_.ended = take_axes();
        if (out_.ended) {
            began_ = rack_.kernel().now();
            rack_.set_stop_flag(settings_.stop);
            std::vector<std::int64_t> orders;
            for (const Work& work : works_) orders.push_back(work.running->config.homing.sequence);
            std::sort(orders.begin(), orders.end());
            orders.erase(std::unique(orders.begin(), orders.end()), orders.end());
            for (const std::int64_t order : orders) {
                home_group(order);
                if (!out_.ended) break;
            }
        }
    }

    /// Adds the reason for a stop from the latch, since the axes know only of the stop request.
    void report_stop() {
        StopLatch& latch = rack_.stop_latch();
        latch.settle();
        if (!latch.latched() || latch.is_ordered()) return;
        if (out_.ended || out_.ended.error().kind != ErrorKind::stopped) return;
        out_.ended = fail(ErrorKind::machine, fmt::format("{} Homing was stopped. {} {}", latch.sentence(),
                                                          positions_text(), latch.advice()));
    }

    /// Names the axes that were not homed, then those that lost their position by the stop.
    std::string positions_text() const {
        const StopLatch& latch = rack_.stop_latch();
        std::string unhomed;
        for (const Work& work : works_)
            if (work.begun && !work.axis->home_outcome().homed)
                unhomed += fmt::format("{}{}", unhomed.empty() ? "" : ", ", work.running->config.letter);
        if (unhomed.empty()) return latch.position_sentence();
        const bool kept = std::all_of(rack_.axes().begin(), rack_.axes().end(), [&](const RunningAxis& axis) {
            return latch.keeps_position(axis.config.index());
        });
        return fmt::format("The position of {} is not valid; home again.{}", unhomed,
                           kept ? "" : " " + latch.position_sentence());
    }

    struct Work {
        RunningAxis* running = nullptr;
        control::Axis* axis = nullptr;
        control::HomingRequest order;
        bool begun = false;
        bool ended = false;
        Instant at{};
        HomingSamples samples;
        std::size_t every = 1;
        std::size_t skipped = 0;
    };

    RunningAxis* find(char letter) {
        for (RunningAxis& axis : rack_.axes())
            if (axis.config.letter == letter) return &axis;
        return nullptr;
    }

    std::string all() const {
        std::string out;
        for (const RunningAxis& axis : rack_.axes())
            out += (out.empty() ? "" : ", ") + std::string(1, axis.config.letter);
        return out;
    }

    Result<void> choose() {
        std::string letters = settings_.axes;
        if (letters.empty())
            for (const RunningAxis& axis : rack_.axes())
                if (rack_.config().can_home(axis.config)) letters += axis.config.letter;
        if (letters.empty())
            return fail(ErrorKind::refused,
                        "No axis of the rack has a home switch. Nothing was moved; give an axis one (home_mm in its "
                        "switches).");
        for (const char letter : letters) {
            RunningAxis* running = find(letter);
            if (running == nullptr)
                return fail(ErrorKind::refused,
                            fmt::format("The rack has no axis {}; its axes are {}. Nothing was moved.",
                                        in_quotes(std::string(1, letter)), all()));
            if (std::any_of(works_.begin(), works_.end(), [&](const Work& work) { return work.running == running; }))
                continue;
            Work work;
            work.running = running;
            RackAxis config = running->config;
            if (settings_.method) config.homing.method = *settings_.method;
            MOTIONRACK_TRY(work.order, home_order(rack_.config(), config));
            if (settings_.seen_indexes != nullptr && config.homing.method >= 3 && !work.order.index_after)
                work.order.index_after = (*settings_.seen_indexes)[static_cast<std::size_t>(config.index())];
            works_.push_back(std::move(work));
        }
        return {};
    }

    /// Fetches the axes of the request from their cards, which initialises them.
    Result<void> take_axes() {
        for (Work& work : works_) {
            MOTIONRACK_TRY(work.axis, work.running->card->axis(rack_.config(), work.running->config.letter));
        }
        return {};
    }

    void home_group(std::int64_t order) {
        std::vector<Work*> group;
        for (Work& work : works_)
            if (work.running->config.homing.sequence == order) group.push_back(&work);
        if (group.front()->running->card->host().stop_requested()) {
            out_.ended = fail(ErrorKind::stopped, "Homing was stopped before it began.");
            return;
        }
        const Instant now = rack_.kernel().now();
        for (Work* work : group) {
            set_searching(*work, true);
            if (Result<void> begun = work->axis->home(work->order, now); !begun) {
                set_searching(*work, false);
                out_.ended = std::move(begun);
                break;
            }
            work->begun = true;
            work->at = now;
        }
        if (!out_.ended) stop(group);
        follow(group);
    }

    void set_searching(const Work& work, bool on) {
        rack_.stop_latch().search(static_cast<std::size_t>(work.running - rack_.axes().data()), on);
    }

    static void stop(const std::vector<Work*>& group) {
        for (Work* work : group)
            if (work->begun && !work->ended) work->axis->stop();
    }

    /// Runs until every axis of the group has ended. A failed axis stops the others, as do the time-out and the user.
    void follow(const std::vector<Work*>& group) {
        sim::VirtualHost& port = group.front()->running->card->host();
        const Instant end = port.now() + settings_.timeout;
        Instant next_progress{};
        bool stopped = !out_.ended;
        while (true) {
            bool running = false;
            for (Work* work : group) {
                if (!work->begun || work->ended) continue;
                work->axis->step(port.now());
                sample(*work);
                // A stopped search ends when the axis is at standstill.
                const control::AxisState state = work->axis->state();
                if (state == control::AxisState::homing || state == control::AxisState::stopping) {
                    running = true;
                } else {
                    work->ended = true;
                    note_end(*work);
                }
            }
            if (!running) break;
            if (!stopped && (!out_.ended || port.stop_requested() || port.now() >= end)) {
                stopped = true;
                stop(group);
            }
            if (settings_.progress && port.now() >= next_progress) {
                next_progress = port.now() + milliseconds(50);
                report_progress(group);
            }
            port.pass(sample_period);
        }
    }

    void note_end(Work& work) {
        set_searching(work, false);
        const control::HomingResult found = work.axis->home_outcome();
        if (found.homed && settings_.on_homed)
            settings_.on_homed(
                work.running->config.letter,
                found.edges.empty() ? found.from : later(found.from, from_seconds(found.edges.back().seconds)));
        if (!found.homed && out_.ended)
            out_.ended = fail(rack_.cards().front()->host().stop_requested() ? ErrorKind::stopped : ErrorKind::machine,
                              found.sentence);
    }

    void sample(Work& work) {
        if (work.skipped++ % work.every != 0) return;
        const Instant now = rack_.kernel().now();
        HomingSamples& s = work.samples;
        if (s.seconds.size() >= max_samples) {
            for (std::size_t i = 0; i < s.seconds.size() / 2; ++i)
                s.seconds[i] = s.seconds[2 * i], s.position[i] = s.position[2 * i], s.velocity[i] = s.velocity[2 * i];
            s.seconds.resize(max_samples / 2), s.position.resize(max_samples / 2), s.velocity.resize(max_samples / 2);
            work.every *= 2;
        }
        s.seconds.push_back(to_seconds(now - work.at));
        s.position.push_back(static_cast<float>(work.running->machine->position(now)));
        s.velocity.push_back(static_cast<float>(work.running->velocity(now)));
    }

    void report_progress(const std::vector<Work*>& group) {
        HomingProgress p;
        p.seconds = to_seconds(rack_.kernel().now() - began_);
        p.axes = static_cast<int>(works_.size());
        p.homed = static_cast<int>(
            std::count_if(works_.begin(), works_.end(), [](const Work& work) { return work.axis->position_valid(); }));
        for (const Work* work : group)
            p.states.push_back({work->running->config.letter, std::string(work->axis->home_state())});
        settings_.progress(p);
    }

    void gather() {
        const Instant now = rack_.kernel().now();
        for (Work& work : works_) {
            if (work.axis == nullptr) continue;  // refused
            HomedAxis one;
            one.letter = work.running->config.letter;
            one.unit = work.running->config.unit();
            one.order = work.order;
            one.begun = work.begun;
            if (work.begun) one.outcome = work.axis->home_outcome();
            if (settings_.seen_indexes != nullptr && one.outcome.homed && one.outcome.switch_to_index)
                (*settings_.seen_indexes)[static_cast<std::size_t>(work.running->config.index())] =
                    work.order.index_after.value_or(*one.outcome.switch_to_index);
            one.began_s = work.begun ? to_seconds(work.at - began_) : 0;
            one.counter_position = work.axis->position();
            one.measured_position = work.axis->measured_position();
            one.machine_position = work.running->machine->position(rack_.kernel().now());
            one.lost_pulses = work.running->machine->lost_steps(rack_.kernel().now());
            one.samples = std::move(work.samples);
            out_.axes.push_back(std::move(one));
        }
        out_.seconds = to_seconds(now - began_);
    }

    Rack& rack_;
    const HomingSettings& settings_;
    std::vector<Work> works_;
    Instant began_{};
    HomingOutcome out_;
};

}  // namespace

Result<control::HomingRequest> home_order(const RackConfig& config, const RackAxis& axis) {
    const RackHoming& h = axis.homing;
    const auto refuse = [&](const std::string& why) {
        return fail(ErrorKind::refused,
                    fmt::format("Axis {} cannot be homed: {}. Nothing was moved.", axis.letter, why));
    };
    const CardType& type = *find_card_type(config.card(axis.card)->type);
    // A card that positions by itself searches the near edge of a mark; other cards also detect the release of a
    // switch.
    const bool cam = type.position_loop && axis.switches.has_cam();
    if (!cam && !axis.switches.home)
        return refuse(
            fmt::format("it has no home switch; give it one (home_{0} in its switches{1})", axis.unit(),
                        type.position_loop ? fmt::format(", or a cam: cam_from_{0} and cam_to_{0}", axis.unit()) : ""));
    if (h.method < 1 || h.method > 4)
        return refuse(fmt::format("its homing method is {}; it must be 1 to 4", h.method));
    const bool plus = h.search_direction == HomingDirection::plus;
    if (type.position_loop && plus && !cam)
        return refuse(
            "its home switch is active at and below its position, so its edge must be searched in - direction; give it "
            "a cam, or the other direction");
    control::HomingRequest order;
    order.method = static_cast<control::HomingMethod>(h.method);
    order.towards_plus = plus;
    order.search_velocity = h.search_velocity.value_or(
        std::max(axis.max_velocity / 4, std::min(axis.max_velocity_step, axis.max_velocity)));
    const double slow = std::min(axis.max_velocity_step, order.search_velocity);
    order.latch_velocity = h.latch_velocity.value_or(axis.servo ? slow : slow / 4);
    // The switch is active at and below its position, so a search upwards ends at its release.
    const double edge = cam ? (plus ? *axis.switches.cam_from : *axis.switches.cam_to)
                            : *axis.switches.home + (plus ? axis.switches.hysteresis : 0);
    if (h.method >= 3 && !h.home_offset && !h.index_after)
        return refuse(
            fmt::format("method {0} ends at the encoder's index, whose position is unknown; give it home_offset_{1} "
                        "(position of the index) or index_after_{1} (distance behind the switch)",
                        h.method, axis.unit()));
    const double to_home = h.method < 3 ? 0 : h.index_after.value_or(0);
    order.home_offset = h.home_offset.value_or(plus ? edge + to_home : edge - to_home);
    order.hysteresis = cam ? 0 : axis.switches.hysteresis;
    order.backoff = h.backoff;
    order.switch_active_high = plus;
    order.switch_input = input_of(config, axis, cam ? "cam" : "home", type.home_pins);
    if (order.switch_input < 0)
        return refuse(fmt::format("its home {} is not wired to a stop input of its channel ({})",
                                  cam ? "cam" : "switch", inputs_text(axis, type.home_pins)));
    if (h.method < 3) return order;
    order.index_after = h.index_after;
    order.index_input = input_of(config, axis, "enc_z", type.index_pins);
    if (order.index_input < 0)
        return refuse(
            fmt::format("method {} needs the encoder's index, which does not exist or is not wired to a stop input of "
                        "its channel ({}); home it with method 1 or 2",
                        h.method, inputs_text(axis, type.index_pins)));
    return order;
}

bool HomingOutcome::all_homed() const {
    return ended.has_value() &&
           std::all_of(axes.begin(), axes.end(), [](const HomedAxis& axis) { return axis.outcome.homed; });
}

HomingOutcome home_axes(Rack& rack, const HomingSettings& settings) {
    return Homing(rack, settings).run();
}

}  // namespace motionrack::rack
