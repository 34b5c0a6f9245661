// The board of parts.
#include <motionrack/cards/io8255/test/twin.hpp>

namespace motionrack::io8255::twin {

namespace {

constexpr int first_of_c = 16;
constexpr int code_no_register = 1, code_mode_2 = 2, code_lost = 3, code_overwritten = 4, code_flag = 5, code_held = 6,
              code_discarded = 7, code_refused = 8;

bool bit_of(int value, int number) {
    return (value >> number) % 2 != 0;
}

}  // namespace

Twin::Twin() {
    groups_[1].first = 8;
    lay_out();
}

/// Gives each line its use.
void Twin::lay_out() {
    for (int line = 0; line < 24; ++line) {
        bool input = line < 8 ? groups_[0].input : groups_[1].input;
        if (line >= first_of_c) input = line < first_of_c + 4 ? lower_input_ : upper_input_;
        cells_[static_cast<std::size_t>(line)].use = input ? Use::input : Use::output;
    }
    const auto use = [this](int line_of_c, Use as, int owner) {
        Cell& cell = cells_[static_cast<std::size_t>(first_of_c + line_of_c)];
        cell.use = as;
        cell.owner = owner;
    };
    if (groups_[0].strobed) {
        use(groups_[0].input ? 4 : 6, Use::strobe, 0);
        use(groups_[0].input ? 5 : 7, Use::flag, 0);
        use(3, Use::request, 0);
    }
    if (groups_[1].strobed) {
        use(2, Use::strobe, 1);
        use(1, Use::flag, 1);
        use(0, Use::request, 1);
    }
}

bool Twin::strobe_level(int group) const {
    for (const Cell& cell : cells_)
        if (cell.use == Use::strobe && cell.owner == group) return cell.received;
    return true;
}

bool Twin::request_level(int group) const {
    const Group& g = groups_[static_cast<std::size_t>(group)];
    if (!g.strobed || !g.enabled) return false;
    return strobe_level(group) && (g.input ? g.ibf : g.obf);
}

/// Level of a driver.
bool Twin::driven(int line) const {
    const Cell& cell = cells_[static_cast<std::size_t>(line)];
    const Group& owner = groups_[static_cast<std::size_t>(cell.owner)];
    switch (cell.use) {
        case Use::output:
            return cell.latch;
        case Use::flag:
            return owner.input ? owner.ibf : owner.obf;
        case Use::request:
            return request_level(cell.owner);
        default:
            return false;
    }
}

int Twin::outputs() const {
    int out = 0;
    for (int line = 0; line < 24; ++line) out += driven(line) ? 1 << line : 0;
    return out + (request_level(0) || request_level(1) ? 1 << 24 : 0);
}

/// The bit of a line in what the host reads.
bool Twin::seen(int line) const {
    const Cell& cell = cells_[static_cast<std::size_t>(line)];
    if (line < first_of_c) {
        const int group = line / 8;
        const Group& g = groups_[static_cast<std::size_t>(group)];
        if (!g.input) return cell.latch;
        return g.strobed && strobe_level(group) ? g.byte[static_cast<std::size_t>(line % 8)] : cell.received;
    }
    if (cell.use == Use::input) return cell.received;
    if (cell.use == Use::strobe) return groups_[static_cast<std::size_t>(cell.owner)].enabled;
    return driven(line);
}

void Twin::wire(int line, bool high) {
    Cell& cell = cells_[static_cast<std::size_t>(line)];
    const bool before = cell.received;
    cell.received = high;
    if (cell.use != Use::strobe || before == high) return;
    Group& g = groups_[static_cast<std::size_t>(cell.owner)];
    if (g.input && !high) {
        if (g.ibf && !g.complained) {
            notes_.push_back({code_lost, cell.owner, 0});
            g.complained = true;
        }
        g.ibf = true;
    }
    if (g.input && high)
        for (int i = 0; i < 8; ++i)
            g.byte[static_cast<std::size_t>(i)] = cells_[static_cast<std::size_t>(g.first + i)].received;
    if (!g.input && !high) {
        g.obf = true;
        g.complained = false;
    }
}

int Twin::read(int at) {
    if (at > 2) {
        notes_.push_back({code_no_register, at, -1});
        return 255;
    }
    int out = 0;
    for (int i = 0; i < 8; ++i) out += seen(8 * at + i) ? 1 << i : 0;
    if (at < 2) {
        Group& g = groups_[static_cast<std::size_t>(at)];
        if (g.strobed && g.input && strobe_level(at)) {
            g.ibf = false;
            g.complained = false;
        }
    }
    return out;
}

/// The host writes an output.
void Twin::latch(int line, bool high, int port, int& kept_low) {
    Cell& cell = cells_[static_cast<std::size_t>(line)];
    if (!high) cell.stopped = false;
    cell.latch = high && !cell.stopped;
    if (high && cell.stopped) kept_low += 1 << (line - 8 * port);
}

void Twin::complain(int port, int kept_low) {
    if (kept_low == 0 || complained_) return;
    complained_ = true;
    notes_.push_back({code_held, port, kept_low});
}

void Twin::write(int at, int value) {
    if (at > 3) return notes_.push_back({code_no_register, at, value});
    if (at == 3 && value >= 128) return control(value);
    if (at == 3) return bit(value / 2 % 8, value % 2 != 0);
    if (at < 2 && sends(at)) return send(at, value);
    int kept_low = 0;
    for (int i = 0; i < 8; ++i) {
        const int line = 8 * at + i;
        if (cells_[static_cast<std::size_t>(line)].use != Use::output) continue;
        if (at == 2 && groups_[i < 4 ? 1 : 0].strobed) continue;
        latch(line, bit_of(value, i), at, kept_low);
    }
    complain(at, kept_low);
}

bool Twin::sends(int group) const {
    const Group& g = groups_[static_cast<std::size_t>(group)];
    return g.strobed && !g.input;
}

/// The host writes a byte for a peripheral.
void Twin::send(int at, int value) {
    Group& g = groups_[static_cast<std::size_t>(at)];
    int stopped = 0;
    for (int i = 0; i < 8; ++i) {
        Cell& cell = cells_[static_cast<std::size_t>(g.first + i)];
        cell.stopped = cell.stopped && bit_of(value, i);
        if (cell.stopped) stopped += 1 << i;
    }
    if (stopped != 0) return notes_.push_back({code_refused, at, stopped});
    for (int i = 0; i < 8; ++i) cells_[static_cast<std::size_t>(g.first + i)].latch = bit_of(value, i);
    if (!g.obf && !g.complained) {
        notes_.push_back({code_overwritten, at, 0});
        g.complained = true;
    }
    g.obf = false;
}

void Twin::control(int word) {
    if (bit_of(word, 6)) return notes_.push_back({code_mode_2, word, 0});
    for (Group& g : groups_) {
        const int first = g.first;
        g = Group{};
        g.first = first;
    }
    groups_[0].strobed = bit_of(word, 5);
    groups_[0].input = bit_of(word, 4);
    upper_input_ = bit_of(word, 3);
    groups_[1].strobed = bit_of(word, 2);
    groups_[1].input = bit_of(word, 1);
    lower_input_ = bit_of(word, 0);
    for (Cell& cell : cells_) cell.latch = false;
    lay_out();
}

void Twin::bit(int number, bool high) {
    const int line = first_of_c + number;
    const Cell& cell = cells_[static_cast<std::size_t>(line)];
    int kept_low = 0;
    if (cell.use == Use::strobe)
        groups_[static_cast<std::size_t>(cell.owner)].enabled = high;
    else if (cell.use == Use::flag || cell.use == Use::request)
        notes_.push_back({code_flag, number, 0});
    else if (cell.use == Use::output)
        latch(line, high, 2, kept_low);
    complain(2, kept_low);
}

void Twin::stop() {
    for (int at = 0; at < 2; ++at) {
        if (!sends(at)) continue;
        Group& g = groups_[static_cast<std::size_t>(at)];
        if (!g.obf) notes_.push_back({code_discarded, at, 0});
        g.obf = true;
        g.complained = false;
        for (int i = 0; i < 8; ++i) cells_[static_cast<std::size_t>(g.first + i)].latch = false;
    }
    for (Cell& cell : cells_) {
        cell.stopped = cell.stopped || cell.latch;
        cell.latch = false;
    }
    complained_ = false;
}

}  // namespace motionrack::io8255::twin
