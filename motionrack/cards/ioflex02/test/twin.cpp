// The slow loop.
#include <motionrack/cards/ioflex02/test/twin.hpp>

namespace motionrack::ioflex02::twin {

namespace {

constexpr int halves_of_tick = 24;  // 1.2 us

unsigned slow_crc(const std::vector<int>& bytes, std::size_t skip_from, std::size_t skip_to) {
    unsigned crc = 0xFFFFFFFFu;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (i >= skip_from && i < skip_to) continue;
        crc ^= static_cast<unsigned>(bytes[i]);
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) ? (crc >> 1) ^ 0xEDB88320u : crc >> 1;
    }
    return ~crc;
}

unsigned number(const std::vector<int>& bytes, std::size_t at) {
    unsigned out = 0;
    for (std::size_t i = 0; i < 4; ++i) out += static_cast<unsigned>(bytes[at + i]) << (8 * i);
    return out;
}

}  // namespace

Twin::Twin(bool preloaded, int ident, int serial, std::int64_t configuration_halves)
    : serial_(serial), configuration_(configuration_halves) {
    if (!preloaded) return;
    phase_ = running;
    known_ = true;
    ident_ = ident;
    begin();
}

void Twin::begin() {
    began_ = now_;
    time_ = 0;
    first_ = true;
    chosen_ = 0;
    latched_time_ = 0;
    for (int i = 0; i < 4; ++i) {
        Axis fresh;
        for (int line = 0; line < 4; ++line) fresh.wire[line] = axes_[i].wire[line];
        fresh.mode = fresh.image_mode = axes_[i].image_mode;
        axes_[i] = fresh;
        latched_[i] = Axis{};
        latched_[i].counted = true;  // the captured registers are 0, AGE too
    }
}

void Twin::see() {
    if (sampled_ || now_ % 2 != 0) return;
    sampled_ = true;
    if (!project()) return;
    for (int i = 0; i < 4; ++i) sample(axes_[i], i);
    first_ = false;
}

void Twin::run_to(std::int64_t half) {
    while (now_ < half) {
        see();
        ++now_;
        sampled_ = false;
        if (phase_ == running && (now_ - began_) % halves_of_tick == 0) {
            ++time_;
            for (Axis& axis : axes_) ++axis.age;
        }
        if (phase_ == starting && now_ >= start_at_) {
            phase_ = running;
            reported_no_project_ = false;
            begin();
        }
    }
}

void Twin::sample(Axis& axis, int axis_number) {
    const int filter = axis.mode >> 4;
    int before[4];
    for (int line = 0; line < 4; ++line) {
        axis.history[line].push_front(axis.wire[line]);
        if (axis.history[line].size() > 40) axis.history[line].pop_back();
        if (first_) {
            axis.taken[line] = axis.wire[line];
            while (axis.history[line].size() < 40) axis.history[line].push_back(axis.wire[line]);
        }
        before[line] = axis.taken[line];
        bool steady = true;
        for (int i = 0; i <= filter; ++i)
            steady = steady && axis.history[line][static_cast<std::size_t>(i)] == axis.wire[line];
        if (steady) axis.taken[line] = axis.wire[line];
    }
    const bool a = before[0] != axis.taken[0], b = before[1] != axis.taken[1];
    if (a) axis.edges_a = (axis.edges_a + 1) % 65536;
    if (b) axis.edges_b = (axis.edges_b + 1) % 65536;
    if (a && b) {
        if (axis.illegal < 65535) ++axis.illegal;
        axis.illegal_at = axis.raw;
        if (!axis.reported) note(1, axis_number, now_ * 50);
        axis.reported = true;
    } else if (a || b) {
        // Previous and present phase of the line pair.
        constexpr int place[2][2] = {{0, 1}, {3, 2}};  // [B][A]
        const int from = place[before[1]][before[0]], to = place[axis.taken[1]][axis.taken[0]];
        const bool up = (from + 1) % 4 == to;
        const int edge = up ? from : to;  // edge n is between n and n + 1
        const int edges = axis.mode >> 1 & 3;
        const bool counts = edges == 0 || (edges == 1 && edge % 2 == 0) || (edges >= 2 && edge == 0);
        if (counts) {
            const int step = up != ((axis.mode & 1) != 0) ? 1 : -1;
            axis.position += step;
            axis.raw += step;
            axis.down = step < 0;
            axis.counted = true;
            axis.age = 0;
        }
    }
    const int active = (axis.mode & 8) ? 0 : 1;
    if (before[2] != axis.taken[2] && axis.taken[2] == active) {
        axis.indexes = (axis.indexes + 1) % 65536;
        axis.index_at = axis.raw;
        if (axis.state == 1) {
            axis.state = 0;
            axis.position = 0;
        }
    }
    if (before[3] == 0 && axis.taken[3] == 1 && axis.state == 2) axis.state = 1;
}

// ---- registers

void Twin::refuse(int code) {
    phase_ = failed;
    error_ = code;
    note(2, code, static_cast<std::int64_t>(image_.size()));
}

void Twin::byte(int value) {
    if (phase_ != loading) return;
    image_.push_back(value);
    const std::string magic = "IOFLEX02";
    if (image_.size() == 8)
        for (std::size_t i = 0; i < 8; ++i)
            if (image_[i] != magic[i]) return refuse(1);
    if (image_.size() < 36) return;
    const unsigned length = number(image_, 28);
    if (length < 8 || length > 131072) return refuse(2);
    if (image_.size() < 36 + length) return;
    if (slow_crc(image_, 32, 36) != number(image_, 32)) return refuse(4);
    std::string name;
    for (std::size_t i = 8; i < 24; ++i) name += static_cast<char>(image_[i]);
    known_ = name == std::string("position\0\0\0\0\0\0\0\0", 16);
    ident_ = image_[24];
    if (!known_) {
        error_ = 5;
        note(3, ident_, 0);
    }
    for (std::size_t i = 0; i < 4; ++i) axes_[i].image_mode = image_[36 + 2 * i];
    phase_ = starting;
    start_at_ = now_ + configuration_;
    if (configuration_ > 0) return;
    phase_ = running;
    reported_no_project_ = false;
    begin();
    sampled_ = false;  // a sample at this very instant is the first
}

void Twin::write(int at, int value) {
    see();
    switch (at) {
        case 0x00:
            if (value & 1) {
                phase_ = loading;
                image_.clear();
                error_ = 0;
                known_ = false;
                outputs_ = 0;
                for (Axis& axis : axes_) axis.illegal = 0, axis.image_mode = 0;
            }
            if ((value & 2) && phase_ == loading) refuse(3);
            if (!project()) return;
            if (value & 4) {
                begin();
                outputs_ = 0;
            }
            if (value & 8)
                for (Axis& axis : axes_) axis.illegal = 0, axis.reported = false;
            return;
        case 0x02:
            byte(value & 255);
            byte(value >> 8);
            return;
        case 0x10:
        case 0x12:
        case 0x14:
        case 0x16:
        case 0x18:
        case 0x62:
            break;
        default:
            return note(5, at, value);
    }
    if (!project()) {
        if (!reported_no_project_) note(4, at, 0);
        reported_no_project_ = true;
        return;
    }
    if (at == 0x10) {
        if (value & 1) {
            latched_time_ = time_;
            for (int i = 0; i < 4; ++i) latched_[i] = axes_[i];
        }
        if (value & 2) time_ = 0;
    }
    if (at == 0x12)
        for (int i = 0; i < 4; ++i) {
            if (value & 0x100 << i) continue;
            const int command = value >> (2 * i) & 3;
            if (command == 1) axes_[i].position = 0;
            axes_[i].state = command == 2 ? 1 : command == 3 ? 2 : 0;
        }
    if (at == 0x14) outputs_ = (outputs_ & 0xFF00) + (value & 255);
    if (at == 0x16) outputs_ = (outputs_ & 0x00FF) + (value & 255) * 256;
    if (at == 0x18) chosen_ = value & 3;
    if (at == 0x62) axes_[chosen_].mode = value & 255;
}

int Twin::status() const {
    int out = phase_ == empty ? 0 : 1 << (phase_ - 1);
    for (int i = 0; i < 4; ++i)
        if (axes_[i].illegal > 0) out += 16 << i;
    return out;
}

int Twin::captured(int at) const {
    const int half = at / 2 % 2;  // register of a pair; pairs begin at multiples of 4
    const auto part = [](std::int64_t value, int which) {
        return static_cast<int>(which ? value >> 16 & 255 : value & 65535);
    };
    if (at < 0x14) return part(latched_time_, half);
    if (at < 0x24) return part(latched_[(at - 0x14) / 4].position, (at - 0x14) / 2 % 2);
    if (at < 0x34) return part(latched_[(at - 0x24) / 4].raw, (at - 0x24) / 2 % 2);
    if (at < 0x44) {
        const Axis& axis = latched_[(at - 0x34) / 4];
        return part(axis.counted && axis.age < 0xFFFFFF ? axis.age : 0xFFFFFF, (at - 0x34) / 2 % 2);
    }
    if (at == 0x44) return latched_[0].down + 2 * latched_[1].down + 4 * latched_[2].down + 8 * latched_[3].down;
    const Axis& axis = latched_[chosen_];
    switch (at) {
        case 0x50:
            return axis.taken[0] + 2 * axis.taken[1] + 4 * axis.taken[2] + 8 * axis.taken[3];
        case 0x52:
            return axis.edges_a;
        case 0x54:
            return axis.edges_b;
        case 0x56:
            return axis.indexes;
        case 0x58:
        case 0x5A:
            return part(axis.index_at, at == 0x5A);
        case 0x5C:
            return axis.illegal;
        case 0x5E:
        case 0x60:
            return part(axis.illegal_at, at == 0x60);
        case 0x62:
            return axes_[chosen_].mode;
        default:
            return 0xFFFF;
    }
}

int Twin::read(int at) {
    see();
    if (at == 0x00) return 0x4F49;
    if (at == 0x02) return serial_;
    if (at == 0x04) return 65535 - serial_;
    if (at == 0x06) return status();
    if (at == 0x08) return error_;
    const bool there = at % 2 == 0 && ((at >= 0x0A && at <= 0x44) || (at >= 0x50 && at <= 0x62));
    if (!there) {
        note(5, at, -1);
        return 0xFFFF;
    }
    if (at == 0x0A) return phase_ == running ? ident_ : 0xFFFF;
    if (!project()) {
        if (!reported_no_project_) note(4, at, 0);
        reported_no_project_ = true;
        return 0xFFFF;
    }
    int bits = 0;
    if (at == 0x0C) {
        for (int i = 0; i < 4; ++i) bits += (axes_[i].state == 0) << i;
        return bits;
    }
    if (at == 0x0E) {
        for (int i = 0; i < 16; ++i) bits += axes_[i / 4].wire[i % 4] << i;
        return bits;
    }
    return captured(at);
}

}  // namespace motionrack::ioflex02::twin
