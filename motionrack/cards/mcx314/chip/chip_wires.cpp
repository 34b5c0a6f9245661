// Names of the wires; defines which the chip subscribes to and which it drives on demand.
#include <motionrack/cards/mcx314/chip/chip_wires.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr const char* axis_letters = "xyzu";
constexpr std::array<const char*, 10> input_names = {"in0",  "in1",   "in2",   "in3",  "expp",
                                                     "expm", "inpos", "alarm", "lmtp", "lmtm"};

}  // namespace

ChipWires::ChipWires(sim::Kernel& kernel, sim::DeviceId id, const std::string& name) {
    for (int a = 0; a < axes_of_chip; ++a) {
        const std::string prefix = name + "." + axis_letters[a];
        for (std::size_t i = 0; i < input_names.size(); ++i) {
            inputs[a][i] = kernel.add_wire(prefix + input_names[i], 1);
            kernel.listen(inputs[a][i], id, 16 * a + static_cast<int>(i));
        }
        for (int i = 0; i < 2; ++i) {
            pulses[a][i] = kernel.add_wire(prefix + (i == 0 ? "pp" : "pm"), 0);
            kernel.drive_lazily(pulses[a][i], id, output_pin + 16 * a + i);
            encoders[a][i] = kernel.add_wire(prefix + (i == 0 ? "eca" : "ecb"), 1);
            kernel.listen(encoders[a][i], id, encoder_pin + 2 * a + i);
        }
        drives[a] = kernel.add_wire(prefix + "drive", 0);
        kernel.drive_lazily(drives[a], id, output_pin + 16 * a + 2);
        for (int i = 0; i < 8; ++i) {
            general_outputs[a][i] = kernel.add_wire(prefix + "out" + std::to_string(i), 0);
            if (i >= 4) kernel.drive_lazily(general_outputs[a][i], id, output_pin + 16 * a + 8 + i);
        }
    }
    emergency = kernel.add_wire(name + ".emgn", 1);
    kernel.listen(emergency, id, emergency_pin);
    step = kernel.add_wire(name + ".expls_n", 1);
    kernel.listen(step, id, step_pin);
    interrupt = kernel.add_wire(name + ".int_n", 1);
}

}  // namespace motionrack::mcx314
