// Sets positions of axes at standstill.
#include <fmt/format.h>

#include <motionrack/operate/position_setter.hpp>

namespace motionrack::operate {

Result<void> PositionSetter::step() {
    for (std::size_t left = pending_.size(); left > 0; --left) {  // more may arrive meanwhile
        const Declared declared = pending_.front();
        const Result<control::Axis*> axis = handover_.take_axis(declared.letter);
        const Result<void> done = axis ? validity_.take(**axis, declared) : tl::unexpected<Error>(axis.error());
        pending_.erase(pending_.begin());
        if (done) continue;
        publisher_.status().reason = done.error().message;
        if (!validity_.of(declared.letter)) continue;
        validity_.invalidate(declared.letter);
        alarms_.raise("position",
                      fmt::format("The position of axis {} was not set, and is not valid any more: {}", declared.letter,
                                  done.error().message),
                      declared.letter);
    }
    return handover_.take_group();
}

}  // namespace motionrack::operate
