// Firmware of the twin, the slow reference model of the card: a loop that evaluates everything in every pass.
#include <cstdlib>
#include <motionrack/cards/databoard4002/test/twin.hpp>

namespace motionrack::databoard4002::twin {

namespace {

/// Returns the lowest 24 bits of a number in two's complement.
std::int64_t s24(std::int64_t x) {
    x %= 16'777'216;
    if (x >= 8'388'608) x -= 16'777'216;
    if (x < -8'388'608) x += 16'777'216;
    return x;
}

std::int64_t twin_number_of(const std::vector<int>& bytes) {
    std::int64_t out = 0;
    for (std::size_t i = bytes.size(); i-- > 0;) out = out * 256 + bytes[i];
    return out;
}

}  // namespace

void Twin::firmware() {
    if (!ready_ && access_at_ <= now_) {
        ready_ = true;
        work();
    }
    const int active_stops = stops();
    if (active_stops & ~stops_) raise(0x20);
    stops_ = active_stops;
    if (stops_ & 4) {
        if (moving_) note(8, s24(counter_), move_target_);
        moving_ = lock_ = false;
    }
    if (moving_) {
        if (s24(move_target_ - counter_) * direction_ <= 0) {
            moving_ = false;
            raise(1);
        }
    } else if (lock_ && went_) {
        if (std::llabs(s24(counter_ - requested_)) > window_) begin_move(requested_);
    }
    const std::int64_t turned = counter_ + 8'388'608;
    const std::int64_t turn = turned >= 0 ? turned / 16'777'216 : -((-turned + 16'777'215) / 16'777'216);
    if (turn != turn_) note(10, counter_);
    turn_ = turn;
    rate_out_ = 0;
    if (moving_) {
        rate_out_ = rate_;
        if (move_sloped_) {
            std::int64_t travelled = s24(counter_ - move_start_) * direction_;
            if (travelled < 0) travelled = 0;
            const int limit = table_rate(move_table_, travelled, s24(move_target_ - counter_) * direction_);
            if (limit < rate_out_) rate_out_ = limit;
        }
    }
}

int Twin::table_rate(const Table& table, std::int64_t travelled, std::int64_t to_go) const {
    const auto rate = [&](int i) { return (table[i * 5] + 256 * table[i * 5 + 1]) % 16'384; };
    const auto place = [&](int i) { return table[i * 5 + 2] + 256 * table[i * 5 + 3] + 65'536 * table[i * 5 + 4]; };
    int decelerating = rate(47), accelerating = rate(47);
    for (int i = 23; i >= 0; --i)
        if (to_go <= place(i)) decelerating = rate(i);
    for (int i = 47; i >= 24; --i)
        if (travelled < place(i)) accelerating = rate(i);
    return decelerating < accelerating ? decelerating : accelerating;
}

void Twin::work() {
    switch (access_) {
        case 'r':
            if (may_read_) {
                may_write_ = false;
                if (answer_.empty()) {
                    may_read_ = false;
                } else {
                    latch_ = answer_.front();
                    answer_.erase(answer_.begin());
                }
            }
            break;
        case 'w':
            argument(access_value_);
            break;
        case 'c':
            command(access_value_);
            break;
        case 'e': {
            const int shown = pending_ ? latched_ : event_;
            latch_ = shown;
            event_ &= ~(shown & 0x7F);
            pending_ = false;
            enables_ = access_value_ & 0x27;
            interrupts_ = access_value_ & 0xC0;
            armed_ = access_value_ & 0x06;
            armed_was_ = zero_wanted();
            may_read_ = false;
            answer_.clear();
            check_events();
            break;
        }
        default:
            break;
    }
}

void Twin::command(int code) {
    if (may_write_ && !bytes_.empty()) note(3, open_, static_cast<std::int64_t>(bytes_.size()));
    may_write_ = may_read_ = false;
    bytes_.clear();
    answer_.clear();
    open_ = code;
    const auto tell = [&](std::int64_t value, int size) {
        for (int i = 0; i < size; ++i) answer_.push_back(static_cast<int>((value >> (8 * i)) & 0xFF));
        latch_ = answer_.front();
        answer_.erase(answer_.begin());
        may_read_ = true;
    };
    if (moving_ && (code == 'A' || code == 'N' || code == 'S')) note(5, code);
    switch (code) {
        case 'A':
            zero_counter();
            if (!moving_) requested_ = 0;
            break;
        case 'D':
            tell(s24(counter_ - requested_), 3);
            may_write_ = true;
            break;
        case 'G':
            go();
            break;
        case 'I':
            break;
        case 'L':
            lock_ = true;
            break;
        case 'M':
            lock_ = sloped_ = false;
            break;
        case 'N':
        case 'S':
            may_write_ = true;
            break;
        case 'O':
            sloped_ = true, rate_ = 16'383;
            break;
        case 'P':
            tell(s24(counter_), 3);
            may_write_ = true;
            break;
        case 'Q':
            moving_ = lock_ = false;
            if (s_.quit_zeroes) target_ = number_ = 0;
            break;
        case 'R':
            tell(rate_out_ * direction_, 2);
            may_write_ = true;
            break;
        case 'V':
            tell(s_.version, 1);
            break;
        case 'W':
            event_ &= 0x7F;
            break;
        default:
            note(2, code);
    }
}

void Twin::argument(int value) {
    if (!may_write_) return note(4, value);
    may_read_ = false;
    answer_.clear();
    bytes_.push_back(value);
    if (open_ == 'S') table_[bytes_.size() - 1] = value;
    const std::size_t size = open_ == 'S' ? 240 : open_ == 'R' ? 2 : 3;
    if (bytes_.size() < size) return;
    const std::int64_t x = twin_number_of(open_ == 'S' ? std::vector<int>{} : bytes_);
    may_write_ = false;
    bytes_.clear();
    if (open_ == 'D') window_ = std::llabs(s24(x));
    if (open_ == 'R') rate_ = static_cast<int>(x % 16'384);
    if (open_ == 'N') number_ = s24(x), relative_ = true;
    if (open_ == 'P') {
        if (moving_) note(5, 'P');
        target_ = s24(x), relative_ = false;
    }
}

void Twin::go() {
    const std::int64_t here = s24(counter_), there = relative_ ? here + number_ : target_;
    if (there < -8'388'608 || there > 8'388'607 || std::llabs(there - here) > 8'388'607) return note(6, there, here);
    if (active(In::ems)) return note(7, here);
    if (moving_) note(5, 'G');
    if (sloped_) flaws();
    event_ &= ~1;
    lock_ = false;
    went_ = true;
    requested_ = there;
    begin_move(there);
}

void Twin::flaws() {
    for (int i = 0; i < 48; ++i) {
        const auto place = [&](int k) {
            return table_[k * 5 + 2] + 256 * table_[k * 5 + 3] + 65'536 * table_[k * 5 + 4];
        };
        if ((table_[i * 5] + 256 * table_[i * 5 + 1]) % 16'384 == 0) return note(9, 1, i);
        if (place(i) > 8'388'607) return note(9, 3, i);
        if (i != 0 && i != 24 && place(i) < place(i - 1)) return note(9, 2, i);
    }
}

void Twin::begin_move(std::int64_t target) {
    moving_ = true;
    move_target_ = target;
    move_start_ = counter_;
    direction_ = target < s24(counter_) ? -1 : 1;
    move_sloped_ = sloped_;
    if (sloped_) move_table_ = table_;
}

}  // namespace motionrack::databoard4002::twin
