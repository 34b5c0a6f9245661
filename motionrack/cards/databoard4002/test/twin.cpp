// Hardware of the twin, the slow reference model of the card: ports, counter, divider, events, outputs.
#include <cmath>
#include <motionrack/cards/databoard4002/test/twin.hpp>

namespace motionrack::databoard4002::twin {

namespace {

// The maker's table from the scan; a unit of hundredths of a millivolt would be finer than it is.
struct Row {
    double volts;
    int rate;
};
constexpr Row rows[] = {{0.01, 13799}, {0.025, 14051}, {0.05, 14339}, {0.075, 14565}, {0.1, 14745}, {0.15, 15014},
                        {0.2, 15207},  {0.25, 15351},  {0.3, 15463},  {0.35, 15547},  {0.4, 15628}, {0.5, 15750},
                        {0.75, 15921}, {1.0, 16021},   {1.5, 16130},  {2.0, 16189},   {2.5, 16225}, {3.0, 16250},
                        {3.5, 16269},  {4.0, 16282},   {4.5, 16293},  {5.0, 16302},   {5.5, 16310}, {6.0, 16316},
                        {6.5, 16321},  {7.0, 16325},   {7.5, 16330},  {8.0, 16333},   {8.5, 16335}, {9.0, 16338},
                        {9.5, 16341},  {10.0, 16345}};

// Interpolated in the frequency, as a ratio of whole numbers, halves up.
int microvolts(int rate) {
    const auto f = [](int r) { return 400'000.0L / (16'384 - r); };
    auto rounded = [](long double v) { return static_cast<int>(std::floor(v * 1e6L + 0.5L + 1e-9L)); };
    const Row* before = nullptr;
    for (const Row& row : rows) {
        if (rate <= row.rate) {
            if (!before) return rounded(static_cast<long double>(row.volts) * f(rate) / f(row.rate));
            const long double part = (f(rate) - f(before->rate)) / (f(row.rate) - f(before->rate));
            const long double low = std::round(before->volts * 1e6) / 1e6L, high = std::round(row.volts * 1e6) / 1e6L;
            return rounded(low + (high - low) * part);
        }
        before = &row;
    }
    return 10'000'000;
}

}  // namespace

Twin::Twin(const Strapping& strapping) : s_(strapping) {}

// ---- ports

int Twin::status() const {
    int out = 0;
    if (ready_) out |= 0x80;
    if (active(In::esl)) out |= 0x40;
    if (active(In::esr)) out |= 0x20;
    if (active(In::ems)) out |= 0x10;
    if (active(In::ref)) out |= 0x08;
    if (active(In::zero)) out |= 0x04;
    if (pending_) out |= 0x02;
    if (outputs()[static_cast<int>(Out::interrupt)]) out |= 0x01;
    return out;
}

void Twin::access(int kind, int port, int value) {
    if (!ready_) return note(1, port, value);
    ready_ = false;
    access_ = kind;
    access_value_ = value;
    access_at_ = now_ + s_.byte_slices;
}

int Twin::read(int port) {
    if (port == 1) return status();
    if (port == 7) reset();
    if (port != 0) return 0xFF;
    const int value = latch_;
    access('r', 0, -1);
    return value;
}

void Twin::write(int port, int value) {
    if (port == 0) access('w', port, value);
    if (port == 3) access('c', port, value);
    if (port == 5) access('e', port, value);
    if (port == 4) {
        reset_pulse_until_ = now_ + 20;
        reset();
    }
}

// ---- time

void Twin::slice() {
    ++now_;
    if (running_ && --left_ == 0) {
        pulses_ += running_direction_;
        left_ = reload_;
        if (s_.source == Strapping::Source::own_output) encoder_edge(running_direction_);
    }
    while (law_direction_ != 0 && law_next_ <= now_ * 5'000) {
        law_next_ += law_period_;
        encoder_edge(law_direction_);
    }
    look_at_lines();
    if (hung_ && now_ == watchdog_at_) {
        note(14);
        reset();
    }
    if (now_ % (slices_of_tick * s_.firmware_pass_ticks) == 0 && !hung_) firmware();
    drive();
}

void Twin::hang(bool on) {
    if (on && !hung_) {
        const std::int64_t period = slices_of_tick * s_.firmware_pass_ticks;
        watchdog_at_ = now_ / period * period + 2'000'000;
    }
    hung_ = on;
}

void Twin::reset() {
    ready_ = true;
    access_ = 0;
    latch_ = 0;
    answer_.clear();
    bytes_.clear();
    open_ = 0;
    may_read_ = may_write_ = false;
    target_ = number_ = window_ = requested_ = 0;
    rate_ = 0;
    relative_ = sloped_ = lock_ = went_ = moving_ = false;
    table_.fill(0);
    direction_ = 1;
    event_ = 0x80;
    enables_ = interrupts_ = armed_ = 0;
    pending_ = armed_was_ = false;
    rate_out_ = 0;
    turn_ = 0;
    counter_ = 0;
    hung_ = false;
    stops_ = stops();
    drive();
}

// ---- counter

std::int64_t Twin::position() const {
    std::int64_t p = counter_ % 16'777'216;
    if (p >= 8'388'608) p -= 16'777'216;
    if (p < -8'388'608) p += 16'777'216;
    return p;
}

void Twin::encoder_edge(int step) {
    const std::int64_t lower = step > 0 ? disc_ : disc_ - 1;  // the edge between lower and lower + 1
    disc_ += step;
    if (!s_.up_down) {
        const int number = static_cast<int>(((lower % 4) + 4) % 4);
        if (s_.folding == 2 && number % 2 != s_.first_pair) return;
        if (s_.folding == 1 && number != s_.first_pair) return;
    }
    (too_quick_ ? missed_ : counter_) += step;
}

void Twin::new_rate(double counts_a_second) {
    const double line = std::fabs(counts_a_second) / (s_.up_down ? 1 : 4);
    const bool quick = line > (s_.single_ended ? 50'000 : 100'000);
    if (quick == too_quick_) return;
    too_quick_ = quick;
    if (quick)
        note(11, static_cast<std::int64_t>(std::fabs(counts_a_second) + 0.5));
    else
        note(12, missed_);
    missed_ = 0;
}

void Twin::law(std::int64_t period, int direction) {
    law_period_ = period;
    law_direction_ = direction;
    law_next_ = now_ * 5'000 + period;
    new_rate(direction * 1e10 / static_cast<double>(period));
}

void Twin::set(In pin, int level) {
    if (level_[static_cast<int>(pin)] == level) return;
    level_[static_cast<int>(pin)] = level;
    if (pin == In::o1 || pin == In::o2) {
        if (s_.source != Strapping::Source::wires) return;
        Line& line = line_[static_cast<int>(pin)];
        line.raw = level;
        if (now_ < line.free_at)
            ++line.changes;
        else
            take(static_cast<int>(pin));
    }
    if (pin == In::zero || pin == In::ref) look_at_zero();
    drive();
}

void Twin::take(int i) {
    const auto phase = [this] { return line_[1].taken * 2 + (line_[0].taken ^ line_[1].taken); };
    const int before = phase();
    line_[i].taken = line_[i].raw;
    line_[i].free_at = now_ + half_period();
    if (s_.up_down) {
        if (line_[i].taken) counter_ += i == 1 ? 1 : -1;
        return;
    }
    const int turn = (phase() - before) & 3;  // one line changes at a time
    const int step = turn == 1 ? 1 : -1, lower = step > 0 ? before : phase();
    if (s_.folding == 2 && lower % 2 != s_.first_pair) return;
    if (s_.folding == 1 && lower != s_.first_pair) return;
    counter_ += step;
}

void Twin::look_at_lines() {
    for (int i = 0; i < 2; ++i) {
        if (now_ != line_[i].free_at || line_[i].changes == 0) continue;
        if (line_[i].changes > 1) note(13, i + 1);
        line_[i].changes = 0;
        if (line_[i].raw != line_[i].taken) take(i);
    }
}

void Twin::break_wire(In pin, bool broken) {
    broken_[static_cast<int>(pin)] = broken;
    look_at_zero();
    drive();
}

// ---- events

void Twin::raise(int bits) {
    event_ |= bits & enables_;
    check_events();
}

void Twin::check_events() {
    if (pending_ || (event_ & enables_) == 0) return;
    pending_ = true;
    latched_ = event_;
}

bool Twin::zero_wanted() const {
    if (armed_ == 0) return false;
    if ((armed_ & 2) && !active(In::zero)) return false;
    if ((armed_ & 4) && !active(In::ref)) return false;
    return true;
}

void Twin::look_at_zero() {
    const bool is = zero_wanted();
    if (is && !armed_was_) {
        if (s_.zeroing) zero_counter();
        const int bits = armed_;
        armed_ = 0;
        raise(bits);
    }
    armed_was_ = is;
}

void Twin::zero_counter() {
    move_start_ -= counter_;
    counter_ = 0;
    turn_ = 0;
}

// ---- outputs

int Twin::stops() const {
    return (active(In::esl) ? 1 : 0) | (active(In::esr) ? 2 : 0) | (active(In::ems) ? 4 : 0);
}

bool Twin::gate() const {
    return direction_ > 0 ? !active(In::esr) : !active(In::esl);
}

/// Updates the divider from the firmware and the gate.
void Twin::drive() {
    const std::int64_t divisor = (16'384 - rate_out_) * slices_of_tick;
    if (!driven()) {
        if (running_ && s_.source == Strapping::Source::own_output) {
            running_ = false;
            new_rate(0);
        }
        running_ = false;
        return;
    }
    const bool fresh = !running_ || running_direction_ != direction_;
    if (!fresh && reload_ == divisor) return;
    if (fresh) left_ = divisor;
    running_ = true;
    running_direction_ = direction_;
    reload_ = divisor;
    if (s_.source == Strapping::Source::own_output) new_rate(400'000.0 / (16'384 - rate_out_));
}

std::array<int, out_count> Twin::outputs() const {
    const bool relay = rate_ != 0 && !active(In::ems);
    const bool asked = ((interrupts_ & 0x40) && ready_) || ((interrupts_ & 0x80) && pending_);
    return {relay && driven() ? direction_ * microvolts(rate_out_) : 0, direction_ > 0, relay,
            now_ < reset_pulse_until_, asked};
}

}  // namespace motionrack::databoard4002::twin
