// Names of the states.
#include <motionrack/operate/status.hpp>

namespace motionrack::operate {

std::string_view name_of(MachineState state) {
    switch (state) {
        case MachineState::disabled:
            return "disabled";
        case MachineState::standstill:
            return "standstill";
        case MachineState::homing:
            return "homing";
        case MachineState::moving:
            return "moving";
        case MachineState::jogging:
            return "jogging";
        case MachineState::hold:
            return "hold";
        case MachineState::stopping:
            return "stopping";
        case MachineState::error_stop:
            return "error stop";
        case MachineState::service:
            return "service";
    }
    return "";
}

}  // namespace motionrack::operate
