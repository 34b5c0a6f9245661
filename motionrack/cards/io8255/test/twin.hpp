// The card as a board of parts: a cell per line, a flip-flop per signal, all of them looked at after every event. It is
// written from RULES.md alone, and is the oracle of the model.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

namespace motionrack::io8255::twin {

struct Note {
    int code = 0;
    std::int64_t a = 0, b = 0;
    friend auto operator<=>(const Note&, const Note&) = default;
};

class Twin {
  public:
    Twin();

    /// A receiver gets another level; `line`: 0 to 23, from line 0 of port A on.
    void wire(int line, bool high);
    void write(int at, int value);
    int read(int at);
    void stop();

    /// Levels of the drivers, line 0 of port A in bit 0, and of the interrupt in bit 24.
    int outputs() const;
    const std::vector<Note>& notes() const { return notes_; }

  private:
    enum class Use { input, output, strobe, flag, request };
    struct Cell {
        Use use = Use::input;
        int owner = 0;  ///< the group whose handshake uses it
        bool received = true, latch = false, stopped = false;
    };
    struct Group {
        bool strobed = false, input = true, enabled = false, complained = false;
        bool ibf = false, obf = true;  ///< levels
        std::array<bool, 8> byte{};
        int first = 0;  ///< its first line
    };

    void lay_out();
    bool strobe_level(int group) const;
    bool request_level(int group) const;
    bool driven(int line) const;
    bool seen(int line) const;
    void latch(int line, bool high, int port, int& kept_low);
    void complain(int port, int kept_low);
    bool sends(int group) const;
    void send(int at, int value);
    void control(int word);
    void bit(int number, bool high);

    std::array<Cell, 24> cells_;
    std::array<Group, 2> groups_;
    bool upper_input_ = true, lower_input_ = true;
    bool complained_ = false;  ///< about outputs that a stop keeps low
    std::vector<Note> notes_;
};

}  // namespace motionrack::io8255::twin
