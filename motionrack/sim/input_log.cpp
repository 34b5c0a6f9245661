// Replaying a log of inputs.
#include <motionrack/sim/input_log.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::sim {

void replay(Kernel& kernel, const std::vector<LoggedInput>& inputs, Instant end,
            const std::function<void(const LoggedInput&)>& apply) {
    auto run = [&kernel](Instant until) {
        while (kernel.run_until(until) == RunEnd::broken) {
        }
    };
    for (const LoggedInput& input : inputs) {
        run(input.at);
        apply(input);
        kernel.settle();
    }
    run(end);
}

}  // namespace motionrack::sim
