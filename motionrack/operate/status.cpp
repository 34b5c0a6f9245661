// Names of the machine states.
#include <motionrack/operate/status.hpp>

namespace motionrack::operate {

namespace {

constexpr std::array<std::string_view, 9> state_names = {"disabled", "standstill", "homing",     "moving", "jogging",
                                                         "hold",     "stopping",   "error stop", "service"};
static_assert(state_names[static_cast<std::size_t>(MachineState::service)] == "service");

}  // namespace

std::string_view name_of(MachineState state) {
    return state_names[static_cast<std::size_t>(state)];
}

}  // namespace motionrack::operate
